// mpm-seismic: shakes a slope from its static state, and follows the slide.
//
//   mpm-seismic cases/slope/case.yaml --from run/static/final.h5 --out run/a
//   mpm-seismic cases/slope/case.yaml --from run/static/final.h5 --motion record.AT2 --out run/b
//   (the same again)                                          goes on after an interruption

#include "io/case/units.hpp"
#include "io/results/domain_state.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/stages/boundary_reports.hpp"
#include "solver/stages/departures.hpp"
#include "solver/stages/energy_watch.hpp"
#include "solver/stages/fidelity.hpp"
#include "solver/stages/filling_report.hpp"
#include "solver/stages/flip_blend.hpp"
#include "solver/stages/motion.hpp"
#include "solver/stages/observer.hpp"
#include "solver/stages/predict.hpp"
#include "solver/stages/self_driven.hpp"
#include "solver/stages/slide_report.hpp"

#include <cmath>
#include <utility>

namespace mpm
{
namespace
{
constexpr double most_steps = 1e12; // years of computing for a single particle
constexpr int check_every = 100;    // steps between looks at particles and wave speeds

/// A step within the case's Courant number that divides the gauges' interval, so that they are sampled
/// evenly.
double choose_step(const Case& case_file, const Domain& main)
{
  const double most = case_file.courant_number * case_file.grid.spacing / greatest_wave_speed(main);
  const double every = case_file.output.gauges.every;
  return every / std::ceil(every / most);
}

/// Loads the static state and checks that it is one, and of this ground; returns the file's digest.
std::string load_static_state(const Session& session, Model& model)
{
  std::string digest;
  const h5::File file = open_complete(session.options.from, &digest);
  const auto refuse = [&](const std::string& why)
  { throw Error(exit_code::bad_input, session.options.from.string() + ": " + why); };
  if (file.attribute_string("schema") != checkpoint_schema || !file.exists("relaxation") ||
      file.attribute_string("stage", "clock") != "static")
    refuse("is no static state of this version; give the final.h5 of mpm-static");
  if (file.attribute_int("last", "clock") != 1)
    refuse("the ground had not settled yet; give the final.h5 of mpm-static");
  const std::string other = difference(file.read_strings("ground"), ground_settings(session.case_file));
  if (!other.empty()) refuse(other + "; run mpm-static for this case");
  model.for_each_domain(
      [&](Domain& domain, const std::string& column)
      {
        if (column.empty())
          load_particles(file, domain);
        else
          load_particles(file.open_group("free_field/" + column), domain);
      });
  return digest;
}

class Shaking
{
public:
  /// `from`: digest of the static state, empty for none.
  Shaking(Session& session, Model& model, const Motion& motion, std::string from)
      : session_(session), model_(model), motion_(motion), from_(std::move(from)),
        observer_(session, model, *motion.wave), energy_(session, model), departures_(session, model),
        self_driven_(session.case_file.output.slide),
        flip_(session.case_file.seismic.flip_blend, session.case_file.seismic.flip_ends)
  {
  }

  void start(Clock& clock)
  {
    observer_.place_gauges();
    warn_of_unlike_columns(session_, model_);
    add_seismic_boundaries(model_, session_.case_file, motion_.wave, false);
    energy_.open();
    observer_.look(clock, true);
  }

  void resume(const h5::File& file, Clock& clock)
  {
    const double first_step = clock.dt;
    add_seismic_boundaries(model_, session_.case_file, motion_.wave, true);
    load_model(file, model_, clock, session_.case_file.seismic.duration);
    observer_.load(file, clock, first_step);
    self_driven_.load(file.open_group("motion"), clock.time());
    flip_.load(file.open_group("motion"), clock.time());
    fade_when_self_driven();
  }

  int run(Clock& clock)
  {
    try
    {
      return go(clock);
    }
    catch (const Diverged&)
    {
      observer_.write(applied_until(clock));
      session_.finish("seismic", exit_code::diverged, model_, clock, summary(clock));
      throw;
    }
  }

private:
  int go(Clock& clock)
  {
    const double duration = session_.case_file.seismic.duration;
    Progress progress(session_.log, {"seismic", model_.main->particles.size(), parallel::threads(),
                                     clock.step, clock.time() / duration});
    const auto moment = [&]
    {
      return Moment{clock.time(), clock.time() / duration, clock.step, kinetic_energy(*model_.main),
                    greatest_speed(model_.main->particles)};
    };
    report_wave_fidelity(session_, clock.dt, motion_.wave.get());
    if (model_.base)
    {
      const double time = spring_time(session_.case_file);
      session_.log.info("base spring: {}",
                        time > 0 ? fmt::format("{:.2f} s", time) : "none; the base may drift");
    }
    session_.log.info("seismic stage: {} particles, dt = {:.3e} s, {:g} s", model_.main->particles.size(),
                      clock.dt, duration);
    session_.loop_begins(clock.step, model_);
    while (!session_.at_end() && clock.time() < duration * (1 - 1e-9))
    {
      model_.for_each_domain([&](Domain& domain, const std::string&)
                             { domain.settings.flip_blend = flip_.at(clock.time()); });
      advance(model_, clock.time(), clock.dt);
      ++clock.step;
      const bool ended = take_out_departed(clock);
      observer_.look(clock, false);
      flip_.note(observer_.slide().now().area > 0, clock.time());
      end_motion();
      if (clock.step % check_every == 0)
      {
        limit_openings(*model_.main);
        check_particles(*model_.main, model_.reference_volume);
        energy_.check(clock.time());
        check_step(session_, model_, session_.case_file.courant_number, clock);
        let_rest(clock.time());
      }
      if (progress.due()) progress.update(moment());
      if (ended) break;
      if (session_.must_stop() || session_.checkpoint_due())
      {
        save(checkpoint_name(clock.step), clock);
        if (!session_.must_stop()) continue;
        session_.log.info("stopped at t = {:.3f} s; the same command goes on", clock.time());
        session_.finish("seismic", exit_code::interrupted, model_, clock, summary(clock));
        return exit_code::interrupted;
      }
    }
    progress.finish(moment());
    report_boundaries(session_, model_);
    departures_.report();
    if (!session_.at_end()) observer_.look_last(clock);
    report_end(clock);
    report_rest(clock);
    if (session_.at_end())
      observer_.write(applied_until(clock));
    else
      save("final.h5", clock);
    energy_.report();
    session_.log.info("{}", slide_text(observer_.slide().summary(), session_.case_file.output.slide.moved));
    session_.finish("seismic", exit_code::done, model_, clock, summary(clock), observer_.files());
    return exit_code::done;
  }

  /// Takes out ground that has left the model; whether that ends the run.
  bool take_out_departed(const Clock& clock)
  {
    if (clock.step % Departures::every != 0 || !departures_.take_out(clock.time())) return false;
    const bool nothing_left = model_.main->particles.size() == 0;
    if (session_.case_file.seismic.leaving == GroundLeaving::remove && !nothing_left) return false;
    session_.log.warn("the run ends at t = {:.2f} s of {} s: {}", clock.time(),
                      session_.case_file.seismic.duration,
                      nothing_left ? "all ground has left the model"
                                   : "ground has left the model, and seismic.leaving is stop");
    return true;
  }

  /// Once the motion is over and the free field stands still, ground at rest may be skipped.
  void let_rest(double time)
  {
    const double below = session_.case_file.seismic.rest_below;
    const auto [vx, vy] = motion_.wave->velocity(time);
    bool still = time >= motion_.wave->end() && vx == 0 && vy == 0;
    for (const FreeFieldColumn* column : {model_.left.get(), model_.right.get()})
      still &= !column || greatest_speed(column->domain->particles) < below;
    allow_rest(*model_.main, still ? below : 0);
  }

  bool ends_self_driven() const { return session_.case_file.seismic.motion.end == MotionEnd::self_driven; }

  /// Lets the motion fade from the sample on that shows a self-driven slide.
  void end_motion()
  {
    const MovedGround& moved = observer_.slide().now();
    const double time = observer_.slide().time();
    if (!ends_self_driven() || !self_driven_.decide(moved, time)) return;
    fade_when_self_driven();
    session_.log.info(
        "t = {:.2f} s: the slide is self-driven: {:.1f} m2 have moved more than {} m and advanced at "
        "{} m/s or more for {} s (now {:.2f} m/s); the motion fades until t = {:.2f} s",
        time, moved.area, session_.case_file.output.slide.moved, self_driven_.least_speed(), SelfDriven::hold,
        moved.advance(), motion_.wave->fade.end());
  }

  void fade_when_self_driven()
  {
    if (!std::isnan(self_driven_.decided())) motion_.wave->fade.start = self_driven_.decided();
  }

  void report_end(const Clock& clock) const
  {
    if (!ends_self_driven()) return;
    if (std::isnan(self_driven_.decided()))
      session_.log.info("the slide never was self-driven: the motion was not ended");
    report_what_was_applied(session_, motion_, applied_until(clock));
  }

  void report_rest(const Clock& clock) const
  {
    const Domain& main = *model_.main;
    if (main.rest.skipped > 0)
      session_.log.info(
          "ground at rest: {:.1f} % of all particle-steps were skipped, {:.0f} % of the last one",
          100.0 * main.rest.skipped / (double(clock.step) * main.particles.size()),
          100.0 - 100.0 * main.blocks.awake.shares.cost() / main.particles.size());
  }

  void save(const std::string& name, const Clock& clock)
  {
    energy_.check(clock.time()); // the last checkpoint must be a good one
    session_.write_checkpoint(name, "seismic", model_, clock,
                              [&](h5::File& file)
                              {
                                observer_.save(file);
                                h5::Group motion = file.create_group("motion");
                                for (const auto& [key, value] : motion_.identity)
                                  motion.attribute(key, value);
                                self_driven_.save(motion);
                                flip_.save(motion);
                              });
    observer_.write(applied_until(clock));
    session_.folder->prune(session_.case_file.output.checkpoint.keep);
  }

  /// Until when the motion was applied, s: the last step may go beyond the run's end.
  double applied_until(const Clock& clock) const
  {
    return std::min(clock.time(), session_.case_file.seismic.duration);
  }

  nlohmann::json summary(const Clock& clock) const
  {
    nlohmann::json result = observer_.summary();
    result["energy"] = energy_.summary();
    result["motion"] = motion_.summary(applied_until(clock));
    result["motion_title"] = motion_.title;
    result["skipped_particle_steps"] = model_.main->rest.skipped;
    const double end = motion_.wave->fade.end();
    result["motion_ended"] = std::isfinite(end) ? nlohmann::json(end) : nlohmann::json();
    for (const auto& [key, value] : motion_.identity) result["digests"][key] = value;
    if (!from_.empty()) result["digests"]["from"] = from_;
    return result;
  }

  Session& session_;
  Model& model_;
  const Motion& motion_;
  std::string from_;
  Observer observer_;
  EnergyWatch energy_;
  Departures departures_;
  SelfDriven self_driven_;
  FlipBlend flip_;
};

/// A motion asked for on the command line is not to be left out; load_motion() warns of one of the case.
void refuse_motion_of_fixed_base(Session& session)
{
  if (session.case_file.seismic.base != BaseKind::fixed) return;
  const Options& options = session.options;
  if (!options.motion.empty() || !options.vertical.empty() || options.scale != 1)
    throw Error(exit_code::usage,
                "mpm-seismic: --motion, --vertical and --scale: seismic.base.kind is fixed, "
                "and such a base takes no motion; leave them out, or make it compliant");
}

int run_seismic(Session& session)
{
  const Case& case_file = session.case_file;
  const Options& options = session.options;
  if (case_file.seismic.duration <= 0)
    throw Error(exit_code::bad_input, case_file.path.string() + ": has no seismic section; nothing to shake");
  refuse_motion_of_fixed_base(session);
  if (options.from.empty() && case_file.static_stage.gravity != 0 && !options.check)
    throw Error(exit_code::usage, "mpm-seismic: --from is missing: give the final.h5 of mpm-static");

  if (options.fresh && !options.from.empty() &&
      std::filesystem::weakly_canonical(options.from).parent_path() ==
          std::filesystem::weakly_canonical(options.out))
    throw Error(exit_code::usage,
                options.out.string() + ": --fresh would remove the static state; give another --out");

  // 1. The motion and the case.
  const Motion motion = load_motion(session);
  Model model;
  Clock clock;
  std::string from;
  bool as_new = false, told = false;
  const auto begin = [&] // unless nothing has been done to it yet
  {
    if (std::exchange(as_new, true)) return;
    model = make_model(case_file);
    if (!std::exchange(told, true)) report_filling(session.log, case_file, model.filling);
    clock = {};
    clock.dt = choose_step(case_file, *model.main);
    if (!options.from.empty()) from = load_static_state(session, model);
  };
  begin();
  if (case_file.seismic.duration / clock.dt > most_steps)
    throw Error(
        exit_code::bad_input,
        fmt::format(
            "seismic.duration: {:g} s are more than {:g} steps of {:.3g} s, which no run gets through; "
            "shorten it, or mend the time step of the record",
            case_file.seismic.duration, most_steps, clock.dt));
  if (options.check)
  {
    report_wave_fidelity(session, clock.dt, motion.wave.get());
    model = make_model(case_file);
    return predict_shaking(session, model, clock);
  }
  if (options.from.empty()) session.log.info("no gravity: starts from a stress-free state");

  // 2. The folder: ours, finished, or to be gone on with.
  RunFolder::Identity identity = seismic_settings(case_file);
  identity.insert(identity.end(), motion.identity.begin(), motion.identity.end());
  if (!from.empty()) identity.push_back({"from", from});
  session.open_folder(identity);
  if (session.finished_already()) return exit_code::done;

  // 3. The state: where an interrupted run stopped, or the switch from the static state.
  std::optional<Shaking> shaking;
  const auto load = [&](const h5::File& file)
  {
    begin();
    as_new = false;
    shaking.emplace(session, model, motion, from);
    shaking->resume(file, clock);
  };
  if (!session.resume(load))
  {
    begin();
    shaking.emplace(session, model, motion, from);
    shaking->start(clock);
  }

  // 4. Shaking and run-out.
  return shaking->run(clock);
}
} // namespace
} // namespace mpm

int main(int argc, char** argv)
{
  return mpm::run_program(argc, argv, "mpm-seismic", mpm::run_seismic);
}
