// mpm-seismic: shakes a slope from its static state, and follows the slide.
//
//   mpm-seismic cases/slope/case.yaml --from run/static/final.h5 --out run/a
//   mpm-seismic cases/slope/case.yaml --from run/static/final.h5 --motion record.AT2 --out run/b
//   (the same again)                                          goes on after an interruption

#include "io/checkpoint.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/stages/boundary_reports.hpp"
#include "solver/stages/energy_watch.hpp"
#include "solver/stages/fidelity.hpp"
#include "solver/stages/flip_blend.hpp"
#include "solver/stages/motion.hpp"
#include "solver/stages/observer.hpp"
#include "solver/stages/predict.hpp"
#include "solver/stages/self_driven.hpp"
#include "solver/stages/slide_report.hpp"

#include <cmath>

namespace mpm
{
namespace
{
constexpr int check_every = 100; // steps between looks at particles and wave speeds

/// A step within the case's Courant number that divides the gauges' interval, so that they are sampled
/// evenly.
double choose_step(const Case& scene, const Domain& main)
{
  const double most = scene.safety * scene.grid.spacing / greatest_wave_speed(main);
  const double every = scene.output.gauges.every;
  return every / std::ceil(every / most);
}

/// Loads the static state and checks that it is one, and of this ground.
void load_static_state(const Session& session, Model& model)
{
  const h5::File file = open_complete(session.options.from);
  const auto refuse = [&](const std::string& why)
  { throw Error(exit_code::bad_input, session.options.from.string() + ": " + why); };
  if (!file.exists("clock") || file.open_group("clock").attribute_string("stage") != "static" ||
      !file.exists("relaxation"))
    refuse("is no static state; give the final.h5 of mpm-static");
  const std::vector<std::string> theirs = file.read_strings("ground"), ours = ground_settings(session.scene);
  for (std::size_t k = 0; k < std::max(theirs.size(), ours.size()); ++k)
  {
    const std::string a = k < theirs.size() ? theirs[k] : "nothing",
                      b = k < ours.size() ? ours[k] : "nothing";
    if (a != b)
      refuse("was made with '" + a + "' where the case has '" + b + "'; run mpm-static for this case");
  }
  model.for_each_domain(
      [&](Domain& domain, const std::string& column)
      {
        if (column.empty())
          load_particles(file, domain);
        else
          load_particles(file.open_group("free_field/" + column), domain);
      });
}

class Shaking
{
public:
  Shaking(Session& session, Model& model, const Motion& motion)
      : session_(session), model_(model), motion_(motion), observer_(session, model, *motion.wave),
        energy_(session, model), flip_(session.scene.seismic.flip_blend, session.scene.seismic.flip_ends)
  {
  }

  void start(Clock& clock)
  {
    observer_.place_gauges();
    warn_of_unlike_columns(session_, model_);
    add_seismic_boundaries(model_, session_.scene, motion_.wave, false);
    energy_.open();
    observer_.look(clock, true);
  }

  void resume(const h5::File& file, Clock& clock)
  {
    add_seismic_boundaries(model_, session_.scene, motion_.wave, true);
    load_model(file, model_, clock);
    observer_.load(file);
    self_driven_.load(file.open_group("motion"));
    flip_.load(file.open_group("motion"));
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
      observer_.write();
      session_.finish("seismic", exit_code::diverged, model_, clock, summary());
      throw;
    }
  }

private:
  int go(Clock& clock)
  {
    const double duration = session_.scene.seismic.duration;
    Progress progress(session_.log, {"seismic", model_.main->particles.size(), parallel::threads(),
                                     clock.step, clock.time() / duration});
    const auto moment = [&]
    {
      return Moment{clock.time(), clock.time() / duration, clock.step, kinetic_energy(*model_.main),
                    greatest_speed(*model_.main)};
    };
    report_wave_fidelity(session_, clock.dt, motion_.wave.get());
    if (model_.base)
    {
      const double time = spring_time(session_.scene);
      session_.log.info("base spring: {}",
                        time > 0 ? fmt::format("{:.2f} s", time) : "none; the base may drift");
    }
    session_.log.info("seismic stage: {} particles, dt = {:.3e} s, {} s", model_.main->particles.size(),
                      clock.dt, duration);
    session_.loop_begins(clock.step, model_);
    while (clock.time() < duration * (1 - 1e-9))
    {
      model_.for_each_domain([&](Domain& domain, const std::string&)
                             { domain.flip_blend = flip_.at(clock.time()); });
      advance(model_, clock.time(), clock.dt);
      ++clock.step;
      observer_.look(clock, false);
      flip_.note(observer_.slide().now().area > 0, clock.time());
      end_motion();
      if (clock.step % check_every == 0)
      {
        limit_openings(*model_.main);
        check_particles(*model_.main, model_.reference_volume);
        energy_.check(clock.time());
        check_step(session_, model_, session_.scene.safety, clock);
        let_rest(clock.time());
      }
      if (progress.due()) progress.update(moment());
      if (session_.must_stop() || session_.checkpoint_due())
      {
        save(checkpoint_name(clock.step), clock);
        if (!session_.must_stop()) continue;
        session_.log.info("stopped at t = {:.3f} s; the same command goes on", clock.time());
        session_.finish("seismic", exit_code::interrupted, model_, clock, summary());
        return exit_code::interrupted;
      }
    }
    progress.finish(moment());
    report_boundaries(session_, model_);
    report_end();
    report_rest(clock);
    save("final.h5", clock);
    energy_.report();
    session_.log.info("{}", slide_text(observer_.slide().summary()));
    session_.folder->prune(0);
    session_.finish("seismic", exit_code::done, model_, clock, summary());
    return exit_code::done;
  }

  /// Once the motion is over and the free field stands still, ground at rest may be skipped.
  void let_rest(double time)
  {
    const double below = session_.scene.seismic.rest_below;
    const auto [vx, vy] = motion_.wave->velocity(time);
    bool still = time >= motion_.wave->end() && vx == 0 && vy == 0;
    for (const FreeFieldColumn* column : {model_.left.get(), model_.right.get()})
      still &= !column || greatest_speed(*column->domain) < below;
    allow_rest(*model_.main, still ? below : 0);
  }

  bool ends_self_driven() const { return session_.scene.seismic.motion.end == MotionEnd::self_driven; }

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
        time, moved.area, Slide::moved, SelfDriven::least_speed, SelfDriven::hold, moved.advance(),
        motion_.wave->fade.end());
  }

  void fade_when_self_driven()
  {
    if (!std::isnan(self_driven_.decided())) motion_.wave->fade.start = self_driven_.decided();
  }

  void report_end() const
  {
    if (ends_self_driven() && std::isnan(self_driven_.decided()))
      session_.log.info("the slide never was self-driven: the whole motion was applied");
  }

  void report_rest(const Clock& clock) const
  {
    const Domain& main = *model_.main;
    if (main.rest.skipped > 0)
      session_.log.info(
          "ground at rest: {:.1f} % of all particle-steps were skipped, {:.0f} % of the last one",
          100.0 * main.rest.skipped / (double(clock.step) * main.particles.size()),
          100.0 - 100.0 * main.awake.shares.cost() / main.particles.size());
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
    observer_.write();
    session_.folder->prune(session_.scene.output.checkpoint.keep);
  }

  nlohmann::json summary() const
  {
    nlohmann::json result = observer_.summary();
    result["energy"] = energy_.summary();
    result["motion"] = motion_.title;
    result["skipped_particle_steps"] = model_.main->rest.skipped;
    const double end = motion_.wave->fade.end();
    result["motion_ended"] = std::isfinite(end) ? nlohmann::json(end) : nlohmann::json();
    for (const auto& [key, value] : motion_.identity) result["digests"][key] = value;
    if (!session_.options.from.empty()) result["digests"]["from"] = sha256_file(session_.options.from);
    return result;
  }

  Session& session_;
  Model& model_;
  const Motion& motion_;
  Observer observer_;
  EnergyWatch energy_;
  SelfDriven self_driven_;
  FlipBlend flip_;
};

/// A motion asked for on the command line is not to be left out; one of the case is warned of.
void refuse_motion_of_fixed_base(Session& session)
{
  if (session.scene.seismic.base != BaseKind::fixed) return;
  const Options& options = session.options;
  if (!options.motion.empty() || !options.vertical.empty() || options.scale != 1)
    throw Error(exit_code::usage,
                "mpm-seismic: --motion, --vertical and --scale: seismic.base.kind is fixed, "
                "and such a base takes no motion; leave them out, or make it compliant");
  if (session.scene.seismic.motion.horizontal || session.scene.seismic.motion.vertical)
    session.log.warn("seismic.base: a fixed base takes no motion: the record is not applied");
}

int run_seismic(Session& session)
{
  const Case& scene = session.scene;
  const Options& options = session.options;
  if (scene.seismic.duration <= 0)
    throw Error(exit_code::bad_input, scene.path.string() + ": has no seismic section; nothing to shake");
  refuse_motion_of_fixed_base(session);
  if (options.from.empty() && scene.statics.gravity != 0 && !options.check)
    throw Error(exit_code::usage, "mpm-seismic: --from is missing: give the final.h5 of mpm-static");

  if (options.fresh && !options.from.empty() &&
      std::filesystem::weakly_canonical(options.from).parent_path() ==
          std::filesystem::weakly_canonical(options.out))
    throw Error(exit_code::usage,
                options.out.string() + ": --fresh would remove the static state; give another --out");

  // 1. The motion and the scene.
  const Motion motion = load_motion(session);
  Model model = make_model(scene);
  Clock clock;
  clock.dt = choose_step(scene, *model.main);
  if (options.check)
  {
    report_wave_fidelity(session, clock.dt, motion.wave.get());
    return predict_shaking(session, model, clock);
  }
  if (options.from.empty())
    session.log.info("no gravity: starts from a stress-free state");
  else
    load_static_state(session, model);

  // 2. The folder: ours, finished, or to be gone on with.
  RunFolder::Identity identity{{"stage", "seismic"}};
  for (const auto& setting : settings_with_digests(scene)) identity.push_back(setting);
  identity.insert(identity.end(), motion.identity.begin(), motion.identity.end());
  if (!options.from.empty()) identity.push_back({"from", sha256_file(options.from)});
  session.open_folder(identity);
  if (std::filesystem::exists(*session.folder / "final.h5"))
  {
    session.log.info("{}: is finished already; --fresh starts anew", (*session.folder / "final.h5").string());
    return exit_code::done;
  }

  // 3. The state: where an interrupted run stopped, or the switch from the static state.
  Shaking shaking(session, model, motion);
  if (const auto file = session.newest_checkpoint())
    shaking.resume(*file, clock);
  else
    shaking.start(clock);

  // 4. Shaking and run-out.
  return shaking.run(clock);
}
} // namespace
} // namespace mpm

int main(int argc, char** argv)
{
  return mpm::run_program(argc, argv, "mpm-seismic", mpm::run_seismic);
}
