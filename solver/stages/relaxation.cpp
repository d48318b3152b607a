#include "solver/stages/relaxation.hpp"

#include "io/common/signals.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/stages/checkpoint.hpp"
#include "solver/stages/time_step.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
constexpr int check_every = 10;        // steps between looks at the criteria
constexpr int held_checks = 10;        // in a row: the criteria hold over 100 steps, not by chance in one
constexpr int health_every = 100;      // steps between looks at particles, energies and wave speeds
constexpr double handover = 10;        // elastic statics are done at this multiple of the wanted ratios
constexpr double creep_warning = 1e-3; // m/s
constexpr double noted_share = 0.05;   // of gravity, by which it may grow between two notes of its work

/// 10 s^3 - 15 s^4 + 6 s^5, with zero slope and curvature at both ends, so that gravity sends no wave of its
/// own.
double ramp(double s)
{
  s = std::min(s, 1.0);
  return s * s * s * (10 + s * (-15 + 6 * s));
}

/// Area that has yielded and greatest plastic strain.
std::pair<double, double> yielded(const Domain& domain)
{
  double area = 0, greatest = 0;
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    const auto* strain = domain.materials[m].field("plastic_strain");
    if (strain == nullptr) continue;
    for (std::size_t k = 0; k < strain->size(); ++k)
    {
      if ((*strain)[k] > 0) area += domain.particles.volume[domain.material_begin[m] + k];
      greatest = std::max(greatest, (*strain)[k]);
    }
  }
  return {area, greatest};
}
} // namespace

Model make_static_model(const Case& case_file, Clock& clock)
{
  Model model = make_model(case_file);
  add_static_boundaries(model, case_file);
  if (case_file.static_stage.mass_scaling) scale_masses(model);
  clock = {.dt = step_of(case_file.static_stage.courant_number, *model.main)};
  return model;
}

Relaxation::Relaxation(Session& session, Model& model)
    : session_(session), model_(model), energy_(session, model)
{
  const Particles& p = model.main->particles;
  for (int k = 0; k < p.size(); ++k)
    weight_ +=
        p.mass[k] * session.case_file.static_stage.gravity * (p.y[k] - session.case_file.domain.bottom);
  for (const Material& material : model.main->materials) plasticity_ |= !material.state.empty();
  set_phase(Phase::elastic);
}

/// Begins a phase in the ground and in the columns; the criteria have to hold anew.
void Relaxation::set_phase(Phase phase)
{
  phase_ = phase;
  held_ = 0;
  for (const auto& [part, domain] : model_.domains()) domain->settings.plastic = phase == Phase::plastic;
}

/// In y, m/s2.
double Relaxation::gravity_at(double time) const
{
  const StaticSettings& s = session_.case_file.static_stage;
  return -s.gravity * ramp(std::max(0.0, time) / s.ramp);
}

void Relaxation::load(const h5::File& state, const Clock& clock)
{
  // What acted in the last step: the energies of a run that is loaded at its end are told with it.
  for (const auto& [part, domain] : model_.domains())
    domain->settings.gravity_y = gravity_at(clock.time() - clock.dt);
  const h5::Group group = state.open_group(checkpoint::relaxation);
  const std::int64_t plastic = group.attribute_int("plastic"), held = group.attribute_int("held");
  unbalanced_ = group.attribute_double("unbalanced");
  kinetic_ = group.attribute_double("kinetic");
  if ((plastic != 0 && plastic != 1) || held < 0 || held > held_checks ||
      !(unbalanced_ >= 0 && kinetic_ >= 0))
    throw Error(exit_code::bad_input, group.where() + ": no run leaves such a phase; use another file");
  set_phase(plastic ? Phase::plastic : Phase::elastic);
  held_ = held;
}

void Relaxation::save(const std::string& name, const Clock& clock)
{
  write_checkpoint(session_, name, model_, clock,
                   [&](h5::File& file)
                   {
                     h5::Group group = file.create_group(checkpoint::relaxation);
                     group.attribute("plastic", std::int64_t(phase_ == Phase::plastic));
                     group.attribute("held", held_);
                     group.attribute("unbalanced", unbalanced_);
                     group.attribute("kinetic", kinetic_);
                   });
}

void Relaxation::step(Clock& clock, bool measure)
{
  const double strong = noted_share * session_.case_file.static_stage.gravity;
  const double before = gravity_at(clock.time() - clock.dt), now = gravity_at(clock.time());
  for (const auto& [part, domain] : model_.domains())
  {
    // Between two notes gravity counts as growing linearly with the ground's movement: a steep ramp needs
    // more of them than the checks make, and a jump one on either side.
    if (std::fabs(now - domain->energy.gravity_y) > strong)
      for (const double gravity : {before, now})
      {
        domain->settings.gravity_y = gravity;
        note_gravity(*domain);
      }
    domain->settings.gravity_y = now;
    domain->settings.measure_force_balance = measure;
  }
  advance(model_, clock.time(), clock.dt);
  ++clock.step;
}

void Relaxation::check(const Clock& clock)
{
  check_health(model_);
  for (const auto& [part, domain] : model_.domains()) note_gravity(*domain);
  // While gravity begins to grow all energies are tiny, and the trapezoid of its work is coarse beside them.
  if (clock.time() >= 0.5 * session_.case_file.static_stage.ramp) energy_.check(clock.time());
}

/// Measures both ratios. In the elastic phase ten times the wanted ones will do, after which the laws may
/// yield; elastic ground has only that phase, and its end is the end.
bool Relaxation::converged(const Clock& clock)
{
  const Convergence& until = session_.case_file.static_stage.until;
  unbalanced_ = 0;
  for (const auto& [part, domain] : model_.domains())
    unbalanced_ = std::max(unbalanced_, domain->measures.force_balance.ratio());
  kinetic_ = kinetic_energy(*model_.main) / weight_;
  if (clock.time() < session_.case_file.static_stage.ramp) return false;
  const double easier = phase_ == Phase::elastic && plasticity_ ? handover : 1;
  const bool now = unbalanced_ < easier * until.unbalanced && kinetic_ < easier * until.kinetic;
  held_ = now ? held_ + 1 : 0;
  if (held_ < held_checks) return false;
  if (phase_ == Phase::plastic || !plasticity_) return true;
  session_.log.info("elastic equilibrium at t = {:.2f} s (unbalanced {:.1e}); from here the ground may yield",
                    clock.time(), unbalanced_);
  set_phase(Phase::plastic);
  return false;
}

/// Which criteria do not hold, for the message that the stage gave up.
std::string Relaxation::failure() const
{
  const Convergence& until = session_.case_file.static_stage.until;
  std::string text;
  if (unbalanced_ >= until.unbalanced)
    text += fmt::format(" unbalanced force {:.2e} is not below {:.2e};", unbalanced_, until.unbalanced);
  if (kinetic_ >= until.kinetic)
    text += fmt::format(" kinetic energy ratio {:.2e} is not below {:.2e};", kinetic_, until.kinetic);
  if (phase_ == Phase::elastic && plasticity_) text += " the elastic state was not reached;";
  if (text.empty()) text = " the criteria did not hold for 100 steps;";
  return text;
}

void Relaxation::report(const Clock& clock) const
{
  const auto [area, strain] = yielded(*model_.main);
  const double speed = greatest_speed(model_.main->particles);
  session_.log.info(
      "static state at t = {:.2f} s: unbalanced {:.2e}, kinetic {:.2e}, greatest speed {:.2e} m/s, "
      "yielded {:.1f} m2, greatest plastic strain {:.2e}",
      clock.time(), unbalanced_, kinetic_, speed, area, strain);
  if (speed > creep_warning)
    session_.log.warn("the ground still creeps at {:.1e} m/s: it stands barely, or not", speed);
}

int Relaxation::run(Clock& clock, Start start)
{
  const Summary summary(session_, model_, clock);
  try
  {
    return run_to_end(clock, start, summary);
  }
  catch (const Diverged& error)
  {
    summary.finish(exit_code::diverged, facts());
    throw after_steps(error, clock);
  }
}

int Relaxation::run_to_end(Clock& clock, Start start, const Summary& summary)
{
  const StaticSettings& settings = session_.case_file.static_stage;
  Progress progress(session_.log, {session_.options.stage(), model_.main->particles.size(),
                                   parallel::threads(), clock.step, clock.time() / settings.until.at_most});
  session_.log.info("static stage: {} particles, dt = {:.3e} s, gravity in {} s",
                    model_.main->particles.size(), clock.dt, settings.ramp);
  stop_at_a_step();
  const Ended ended = start == Start::at_end ? Ended::converged : loop(clock, progress);
  if (ended == Ended::interrupted)
  {
    summary.finish(exit_code::interrupted, nlohmann::json::object());
    return exit_code::interrupted;
  }
  progress.finish(moment(clock));
  report(clock);
  energy_.report();
  if (ended == Ended::out_of_time)
  {
    session_.log.error(
        "static stage did not converge by t = {:.1f} s:{} the slope does not stand, or static.until asks for "
        "more than the case gives (static.until.at_most allows more time)",
        clock.time(), failure());
    summary.finish(exit_code::not_converged, facts());
    return exit_code::not_converged;
  }
  // A final state that is whole stays as it is: what was made from it names its digest.
  if (start != Start::at_end)
  {
    check_health(model_); // throws Diverged: the last state must be a good one
    save(final_name, clock);
  }
  summary.finish(exit_code::done, facts());
  return exit_code::done;
}

std::optional<Relaxation::Ends> Relaxation::settle(Clock& clock, std::int64_t most)
try
{
  Ends ends;
  for (const std::int64_t last = clock.step + most; clock.step < last;)
  {
    const bool measure = (clock.step + 1) % check_every == 0;
    step(clock, measure);
    if (measure && converged(clock)) return Ends{plasticity_ ? ends.elastic : clock.time(), clock.time()};
    if (phase_ == Phase::elastic) ends.elastic = clock.time();
    if (clock.step % health_every == 0) check_health(model_);
  }
  return {};
}
catch (const Diverged&)
{
  return {};
}

/// Steps; forces are summed up for the criteria only in the steps that are looked at.
Relaxation::Ended Relaxation::loop(Clock& clock, Progress& progress)
{
  const StaticSettings& settings = session_.case_file.static_stage;
  while (clock.time() < settings.until.at_most)
  {
    const bool measure = (clock.step + 1) % check_every == 0;
    step(clock, measure);
    const bool done = measure && converged(clock);
    if (clock.step % health_every == 0)
    {
      check(clock);
      halve_step_if_outrun(session_, model_, settings.courant_number, clock);
    }
    if (progress.due()) progress.update(moment(clock));
    if (done) return Ended::converged;
    if ((!session_.must_stop() && !session_.checkpoint_due()) || !is_good()) continue;
    session_.write_checkpoint(
        [&]
        {
          save(checkpoint_name(clock.step), clock);
          session_.folder->prune(session_.case_file.output.checkpoint.keep);
        });
    if (session_.must_stop()) return Ended::interrupted;
  }
  return Ended::out_of_time;
}

/// Whether the state is one to go on from. Where it is not, check() ends the run if it finds it so too: a run
/// ends the same whenever its checkpoints are due.
bool Relaxation::is_good() const
try
{
  check_health(model_);
  return true;
}
catch (const Diverged&)
{
  return false;
}

Moment Relaxation::moment(const Clock& clock) const
{
  return {clock.time(), NAN, clock.step, kinetic_energy(*model_.main),
          greatest_speed(model_.main->particles)};
}

/// What summary.json tells of this stage.
nlohmann::json Relaxation::facts() const
{
  const auto [area, strain] = yielded(*model_.main);
  return {{"unbalanced", unbalanced_},
          {"kinetic", kinetic_},
          {"greatest_speed", greatest_speed(model_.main->particles)},
          {"yielded_area", area},
          {"greatest_plastic_strain", strain},
          {"energy", energy_.summary()}};
}
} // namespace mpm
