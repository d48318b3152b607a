#include "solver/stages/predict.hpp"

#include "solver/mpm/parallel.hpp"

namespace mpm
{
namespace
{
constexpr int probe_steps = 50;
constexpr double bytes_per_particle = 160; // 19 doubles and ids
constexpr double bytes_per_node = 72;
} // namespace

int predict(Session& session, Model& model, const Clock& clock, double duration)
{
  using Wall = std::chrono::steady_clock;
  advance(model, 0, clock.dt);
  const auto start = Wall::now();
  for (int k = 1; k <= probe_steps; ++k) advance(model, k * clock.dt, clock.dt);
  const double per_step = std::chrono::duration<double>(Wall::now() - start).count() / probe_steps;
  const double steps = duration / clock.dt;
  const int particles = model.main->particles.size();
  const double state = 1e-6 * bytes_per_particle * particles;
  // A checkpoint is put together in memory before it is written.
  const double memory = 2 * state + 1e-6 * bytes_per_node * model.main->grid.nodes();
  session.log.info("{} particles, about {:.0f} MB of memory and {:.0f} MB a checkpoint", particles, memory,
                   state);
  session.log.info("dt {:.3e} s: {:.0f} steps for {} s, about {} on {} threads", clock.dt, steps, duration,
                   duration_text(per_step * steps), parallel::threads());
  return exit_code::done;
}
} // namespace mpm
