#include "solver/stages/predict.hpp"

#include "io/case/size.hpp"
#include "io/common/memory.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/stages/occasions.hpp"
#include "solver/stages/offers.hpp"
#include "solver/stages/settling.hpp"

namespace mpm
{
namespace
{
constexpr double probe_gravity = 0.1; // m/s2: so that numbers are no zeros, and nothing yields

/// Expected from the case, with particles and nodes as they have been made.
void report_memory(Session& session, const Model& model)
{
  CaseSize size = expected_size(session.case_file);
  size.particles = model.main->particles.size();
  size.nodes = model.main->grid.nodes();
  const double needed = memory_needed(size, session.case_file);
  const FreeMemory free = free_memory();
  session.log.info("{} particles, about {} of memory and {} a checkpoint; {} {}",
                   model.main->particles.size(), bytes_text(needed),
                   bytes_text(checkpoint_bytes(size.particles, session.case_file)), free.limit,
                   bytes_text(free.bytes));
}

/// The time of a step of the model with its boundaries.
StepCost cost_of_step(Model& model, const Clock& clock)
{
  for (const auto& [part, domain] : model.domains()) domain->settings.gravity_y = -probe_gravity;
  return probe(model, clock);
}

/// "1 min 50 s on 2 threads", and how long it would be on a machine that does nothing else.
std::string cost_text(const Session& session, const Chosen& chosen, double duration)
{
  const Occasions all = occasions_of(session.case_file, chosen.wave, chosen.dt, duration);
  const int threads = parallel::threads();
  const auto with = [&](double step)
  {
    return time_text(chosen.before +
                     stage_time(all, step, chosen.step.processor * threads, chosen.particles));
  };
  std::string text = fmt::format("{} on {} threads", with(chosen.step.wall), threads);
  if (chosen.step.disturbed())
    text += fmt::format(" of a machine that is busy now ({} undisturbed)", with(chosen.step.processor));
  return text;
}
} // namespace

int predict_shaking(Session& session, Model& model, const Clock& clock,
                    std::shared_ptr<const IncomingWave> wave)
{
  const double duration = session.case_file.seismic.duration, before = processor_seconds();
  report_memory(session, model);
  add_seismic_boundaries(model, session.case_file, wave, false);
  const Chosen chosen{double(model.main->particles.size()), clock.dt,  duration, before,
                      cost_of_step(model, clock),           wave.get()};
  session.log.info("dt {:.3e} s: {} steps for {} s, about {}", clock.dt, steps_in(duration, clock.dt),
                   duration, cost_text(session, chosen, duration));
  report_offers(session, chosen);
  return exit_code::done;
}

int predict_relaxation(Session& session, Model& model, const Clock& clock)
{
  const double before = processor_seconds();
  report_memory(session, model);
  const StaticSettings& s = session.case_file.static_stage;
  const Settling settling = expected_settling(session, model.main->particles.size());
  Chosen chosen{double(model.main->particles.size()), clock.dt, settling.time, before,
                cost_of_step(model, clock),           nullptr};
  const auto steps = [&](double time) { return steps_in(time, clock.dt); };
  const auto cost = [&](double time) { return cost_text(session, chosen, time); };
  session.log.info("dt {:.3e} s: at least {} steps, for the ramp of {} s; at most {}, in {} "
                   "(static.until.at_most)",
                   clock.dt, steps(s.ramp), s.ramp, steps(s.until.at_most), cost(s.until.at_most));
  if (settling.settles)
    session.log.info("settled after about {} steps, t = {:.1f} s, in about {} (tried with cells of {:.3g} m)",
                     steps(settling.time), settling.time, cost(settling.time), settling.spacing);
  else
  {
    chosen.duration = s.until.at_most;
    session.log.info("when it settles is not known: with cells of {:.3g} m it does not", settling.spacing);
  }
  report_offers(session, chosen);
  return exit_code::done;
}
} // namespace mpm
