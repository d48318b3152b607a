#include "solver/stages/predict.hpp"

#include "io/case/size.hpp"
#include "io/common/memory.hpp"
#include "solver/mpm/parallel.hpp"

namespace mpm
{
namespace
{
constexpr int probe_steps = 50;   // after a first one, which sorts
constexpr double usual_ramps = 2; // after which a slope that stands has settled, as a rule

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

/// Wall time of a step, s, as measured on the ground before anything moves.
double probe(Model& model, const Clock& clock)
{
  using Wall = std::chrono::steady_clock;
  advance(model, 0, clock.dt);
  const auto start = Wall::now();
  for (int k = 1; k <= probe_steps; ++k) advance(model, k * clock.dt, clock.dt);
  return std::chrono::duration<double>(Wall::now() - start).count() / probe_steps;
}
} // namespace

int predict_shaking(Session& session, Model& model, const Clock& clock)
{
  report_memory(session, model);
  const double duration = session.case_file.seismic.duration, steps = duration / clock.dt;
  session.log.info("dt {:.3e} s: {:.0f} steps for {} s, about {} on {} threads", clock.dt, steps, duration,
                   duration_text(probe(model, clock) * steps), parallel::threads());
  return exit_code::done;
}

int predict_relaxation(Session& session, Model& model, const Clock& clock)
{
  report_memory(session, model);
  const StaticSettings& s = session.case_file.static_stage;
  const double per_step = probe(model, clock), ramp = s.ramp / clock.dt;
  const double usual = std::min(usual_ramps * ramp, s.until.at_most / clock.dt),
               most = s.until.at_most / clock.dt;
  session.log.info(
      "dt {:.3e} s: at least {:.0f} steps, for the ramp of {} s; usually about {:.0f} until the ground "
      "has settled, in {} on {} threads; at most {:.0f}, in {} (static.until.at_most)",
      clock.dt, ramp, s.ramp, usual, duration_text(per_step * usual), parallel::threads(), most,
      duration_text(per_step * most));
  return exit_code::done;
}
} // namespace mpm
