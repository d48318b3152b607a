#include "solver/stages/predict.hpp"

#include "io/case_size.hpp"
#include "io/memory.hpp"
#include "solver/mpm/parallel.hpp"

namespace mpm
{
namespace
{
constexpr int probe_steps = 50;

void report_memory(Session& session, const Model& model)
{
  CaseSize size = expected_size(session.scene);
  size.particles = model.main->particles.size();
  size.nodes = model.main->grid.nodes();
  const double needed = memory_needed(size, session.scene);
  const FreeMemory free = free_memory();
  session.log.info("{} particles, about {} of memory and {} a checkpoint; {} {}",
                   model.main->particles.size(), bytes_text(needed),
                   bytes_text(checkpoint_bytes(size.particles, session.scene)), free.limit,
                   bytes_text(free.bytes));
}
} // namespace

int predict(Session& session, Model& model, const Clock& clock, double duration)
{
  using Wall = std::chrono::steady_clock;
  advance(model, 0, clock.dt);
  const auto start = Wall::now();
  for (int k = 1; k <= probe_steps; ++k) advance(model, k * clock.dt, clock.dt);
  const double per_step = std::chrono::duration<double>(Wall::now() - start).count() / probe_steps;
  const double steps = duration / clock.dt;
  report_memory(session, model);
  session.log.info("dt {:.3e} s: {:.0f} steps for {} s, about {} on {} threads", clock.dt, steps, duration,
                   duration_text(per_step * steps), parallel::threads());
  return exit_code::done;
}
} // namespace mpm
