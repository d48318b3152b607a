#include "solver/stages/predict.hpp"

#include "solver/mpm/parallel.hpp"

namespace mpm
{
namespace
{
constexpr int probe_steps = 50;
constexpr double bytes_per_particle = 160; // 19 doubles and ids
constexpr double bytes_per_node = 72;
constexpr double usual_ramps = 2; // after which a slope that stands has settled, as a rule

/// Wall time of a step, s.
double probe(Model& model, const Clock& clock)
{
  using Wall = std::chrono::steady_clock;
  advance(model, 0, clock.dt);
  const auto start = Wall::now();
  for (int k = 1; k <= probe_steps; ++k) advance(model, k * clock.dt, clock.dt);
  return std::chrono::duration<double>(Wall::now() - start).count() / probe_steps;
}

void report_size(Session& session, const Model& model)
{
  const int particles = model.main->particles.size();
  const double state = 1e-6 * bytes_per_particle * particles;
  // A checkpoint is put together in memory before it is written.
  const double memory = 2 * state + 1e-6 * bytes_per_node * model.main->grid.nodes();
  session.log.info("{} particles, about {:.0f} MB of memory and {:.0f} MB a checkpoint", particles, memory,
                   state);
}
} // namespace

int predict_shaking(Session& session, Model& model, const Clock& clock)
{
  report_size(session, model);
  const double duration = session.scene.seismic.duration, steps = duration / clock.dt;
  session.log.info("dt {:.3e} s: {:.0f} steps for {} s, about {} on {} threads", clock.dt, steps, duration,
                   duration_text(probe(model, clock) * steps), parallel::threads());
  return exit_code::done;
}

int predict_relaxation(Session& session, Model& model, const Clock& clock)
{
  report_size(session, model);
  const StaticSettings& s = session.scene.statics;
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
