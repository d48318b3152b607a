#include "solver/stages/shaking.hpp"

#include "io/common/signals.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/stages/boundary_reports.hpp"
#include "solver/stages/checkpoint.hpp"
#include "solver/stages/slide_report.hpp"
#include "solver/stages/time_step.hpp"

#include <cmath>
#include <utility>

namespace mpm
{
namespace
{
constexpr int check_every = 100; // steps between looks at particles, energies and wave speeds
} // namespace

Shaking::Shaking(Session& session, Model& model, const Motion& motion, std::string from)
    : session_(session), case_file_(session.case_file), model_(model), motion_(motion),
      from_(std::move(from)), observer_(session, model, *motion.wave), energy_(session, model),
      departures_(session, model), self_driven_(case_file_.output.slide)
{
}

void Shaking::start(const Clock& clock)
{
  observer_.place_gauges();
  warn_of_unlike_columns(session_, model_);
  add_seismic_boundaries(model_, case_file_, motion_.wave, false);
  energy_.open();
  observer_.look(clock, true);
}

void Shaking::load(const h5::File& state, Clock& clock)
{
  const double first_step = clock.dt;
  add_seismic_boundaries(model_, case_file_, motion_.wave, true);
  load_model(state, model_, clock, case_file_.seismic.duration);
  observer_.load(state, clock, first_step);
  const h5::Group motion = state.open_group(checkpoint::motion);
  self_driven_.load(motion, clock.time());
  fade_when_self_driven();
}

/// A run that is loaded at its end steps no more: it writes what may be missing and ends as it did.
int Shaking::run(Clock& clock, Start start)
{
  Progress progress(session_.log,
                    {session_.options.stage(), model_.main->particles.size(), parallel::threads(), clock.step,
                     clock.time() / case_file_.seismic.duration});
  report_start(clock);
  stop_at_a_step();
  const Summary summary(session_, model_, clock);
  try
  {
    if (start != Start::at_end && loop(clock, progress) == Ended::interrupted)
    {
      session_.log.info("stopped at t = {:.3f} s; the same command goes on", clock.time());
      summary.finish(exit_code::interrupted, facts(clock));
      return exit_code::interrupted;
    }
    progress.finish(moment(clock));
    report_boundaries(session_, model_);
    departures_.report();
    if (start != Start::at_end) observer_.look_last(clock);
    report_end(clock);
    if (start == Start::at_end)
      observer_.write(applied_until(clock)); // the state itself stays as it is, to the byte
    else
    {
      check_health(model_); // throws Diverged: the last state must be a good one
      energy_.check(clock.time());
      save(final_name, clock);
    }
  }
  catch (const Diverged& error)
  {
    report_sides(session_, model_); // ground that leaves its side may be why
    observer_.write(applied_until(clock));
    summary.finish(exit_code::diverged, facts(clock));
    throw after_steps(error, clock);
  }
  energy_.report();
  session_.log.info("{}", slide_text(observer_.slide().summary(), case_file_.output.slide.moved));
  summary.finish(exit_code::done, facts(clock), observer_.files());
  return exit_code::done;
}

void Shaking::report_start(const Clock& clock)
{
  if (model_.base)
  {
    const double time = spring_time(case_file_);
    session_.log.info("base spring: {}",
                      time > 0 ? fmt::format("{:.2f} s", time) : "none; the base may drift");
  }
  session_.log.info("seismic stage: {} particles, dt = {:.3e} s, {:g} s", model_.main->particles.size(),
                    clock.dt, case_file_.seismic.duration);
}

Shaking::Ended Shaking::loop(Clock& clock, Progress& progress)
{
  while (!is_over(clock.time(), case_file_.seismic.duration))
  {
    step(clock);
    const bool ended = take_out_departed(clock);
    look_after(clock);
    if (progress.due()) progress.update(moment(clock));
    if (ended) break;
    if (series_.due()) series_.write([&] { observer_.write(applied_until(clock)); });
    if ((!session_.must_stop() && !session_.checkpoint_due()) || !is_good()) continue;
    session_.write_checkpoint([&] { save(checkpoint_name(clock.step), clock); });
    if (session_.must_stop()) return Ended::interrupted;
  }
  return Ended::by_itself;
}

/// Whether the state is one to go on from. Where it is not, look_after() ends the run if it finds it so too:
/// a run ends the same whenever its checkpoints are due.
bool Shaking::is_good() const
try
{
  check_health(model_);
  energy_.check_growth();
  return true;
}
catch (const Diverged&)
{
  return false;
}

void Shaking::step(Clock& clock)
{
  advance(model_, clock.time(), clock.dt);
  ++clock.step;
}

/// What is looked at after a step: measures, the end of the motion, and now and then whether all is well.
void Shaking::look_after(Clock& clock)
{
  observer_.look(clock, false);
  end_motion(clock);
  if (clock.step % check_every != 0) return;
  limit_openings(*model_.main);
  check_health(model_);
  energy_.check(clock.time());
  halve_step_if_outrun(session_, model_, case_file_.courant_number, clock);
  let_rest(clock.time());
}

/// Takes out ground that has left the model; whether that ends the run.
bool Shaking::take_out_departed(const Clock& clock)
{
  if (clock.step % Departures::every != 0 || !departures_.take_out(clock.time())) return false;
  const bool nothing_left = model_.main->particles.size() == 0;
  if (case_file_.seismic.leaving == GroundLeaving::remove && !nothing_left) return false;
  session_.log.warn("the run ends at t = {:.2f} s of {} s: {}", clock.time(), case_file_.seismic.duration,
                    nothing_left ? "all ground has left the model"
                                 : "ground has left the model, and seismic.leaving is stop");
  return true;
}

/// Once the motion is over and the free field stands still, ground at rest may be skipped. Before, forces
/// from outside could set it moving, which it would not notice (see Rest).
void Shaking::let_rest(double time)
{
  const double below = case_file_.seismic.rest_below;
  const auto [vx, vy] = motion_.wave->velocity(time);
  bool still = time >= motion_.wave->end() && vx == 0 && vy == 0;
  for (const Edge side : both_sides)
    if (const FreeFieldColumn* column = model_.column(side))
      still &= greatest_speed(column->domain->particles) < below;
  allow_rest(*model_.main, still ? below : 0);
}

bool Shaking::ends_self_driven() const
{
  return case_file_.seismic.motion.end == MotionEnd::self_driven;
}

/// Lets the motion fade from the sample on that shows a self-driven slide. Between two samples nothing is
/// decided: a run that was loaded would judge the ground of its checkpoint.
void Shaking::end_motion(const Clock& clock)
{
  const MovedGround& moved = observer_.slide().now();
  const double time = observer_.slide().time();
  if (!ends_self_driven() || time != clock.time() || !self_driven_.decide(moved, time)) return;
  fade_when_self_driven();
  session_.log.info(
      "t = {:.2f} s: the slide is self-driven: {:.1f} m2 have moved more than {} m and advanced at "
      "{} m/s or more for {} s (now {:.2f} m/s); the motion fades until t = {:.2f} s",
      time, moved.area, case_file_.output.slide.moved, self_driven_.least_speed(), SelfDriven::hold,
      moved.advance(), motion_.wave->fade.end());
}

/// After a restart too: the wave itself does not know that it was ended.
void Shaking::fade_when_self_driven()
{
  if (!std::isnan(self_driven_.decided())) motion_.wave->fade.start = self_driven_.decided();
}

/// The state, and with it history.h5, so that a run that is killed has its results until then.
void Shaking::save(const std::string& name, const Clock& clock)
{
  write_checkpoint(session_, name, model_, clock,
                   [&](h5::File& file)
                   {
                     observer_.save(file);
                     h5::Group motion = file.create_group(checkpoint::motion);
                     for (const auto& [key, value] : motion_.identity) motion.attribute(key, value);
                     self_driven_.save(motion);
                   });
  observer_.write(applied_until(clock));
  session_.folder->prune(case_file_.output.checkpoint.keep);
}

void Shaking::report_end(const Clock& clock) const
{
  if (ends_self_driven())
  {
    if (std::isnan(self_driven_.decided()))
      session_.log.info("the slide never was self-driven: the motion was not ended");
    report_what_was_applied(session_, motion_, applied_until(clock));
  }
  const Domain& main = *model_.main;
  if (main.rest.skipped > 0)
    session_.log.info("ground at rest: {:.1f} % of all particle-steps were skipped, {:.0f} % of the last one",
                      100.0 * main.rest.skipped / (double(clock.step) * main.particles.size()),
                      100.0 - 100.0 * main.blocks.awake.shares.cost() / main.particles.size());
}

/// Until when the motion was applied, s: the last step may go beyond the run's end.
double Shaking::applied_until(const Clock& clock) const
{
  return std::min(clock.time(), case_file_.seismic.duration);
}

Moment Shaking::moment(const Clock& clock) const
{
  return {clock.time(), clock.time() / case_file_.seismic.duration, clock.step, kinetic_energy(*model_.main),
          greatest_speed(model_.main->particles)};
}

/// What summary.json tells of this stage.
nlohmann::json Shaking::facts(const Clock& clock) const
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
} // namespace mpm
