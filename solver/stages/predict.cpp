#include "solver/stages/predict.hpp"

#include "solver/mpm/parallel.hpp"

namespace mpm
{
namespace
{
constexpr double cells_per_wavelength = 26; // for 1 % phase error with cubic splines and lumped mass
constexpr int probe_steps = 50;
constexpr double bytes_per_particle = 160; // 19 doubles and ids
constexpr double bytes_per_node = 72;

/// Up to which S waves travel within 1 % of their speed, Hz.
double resolved_frequency(const Case& scene, const Material& material)
{
  return material.elastic().shear_speed() / (cells_per_wavelength * scene.grid.spacing);
}
} // namespace

void log_wave_fidelity(Session& session)
{
  for (const Material& material : session.scene.materials)
  {
    const Elastic& e = material.elastic();
    session.log.info("{}: density {} kg/m3, c_s {:.1f} m/s, c_p {:.1f} m/s; S waves within 1 % of their "
                     "speed up to {:.1f} Hz",
                     material.name, e.density, e.shear_speed(), e.pressure_speed(),
                     resolved_frequency(session.scene, material));
  }
}

nlohmann::json resolution(const Case& scene)
{
  nlohmann::json result{{"spacing", scene.grid.spacing},
                        {"particles_per_cell", scene.grid.particles_per_cell}};
  for (const Material& material : scene.materials)
    result["materials"][material.name] = {{"shear_speed", material.elastic().shear_speed()},
                                          {"frequency", resolved_frequency(scene, material)}};
  return result;
}

int predict(Session& session, Model& model, const Clock& clock, double duration)
{
  log_wave_fidelity(session);
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
