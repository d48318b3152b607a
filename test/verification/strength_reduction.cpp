#include "test/verification/strength_reduction.hpp"

#include "solver/mpm/step.hpp"
#include "solver/stages/time_step.hpp"

#include <cmath>

namespace mpm::verification
{
namespace
{
constexpr double elastic_time = 1.5; // s: gravity grows over a half of it, elastic

void run(Domain& domain, double gravity, double ramp, double duration, double dt)
{
  for (long k = 0; k * dt < duration; ++k)
  {
    const double s = ramp > 0 ? std::min(1.0, k * dt / ramp) : 1;
    domain.settings.gravity_y = -gravity * s * s * s * (10 + s * (6 * s - 15));
    domain.time = k * dt;
    step(domain, dt);
  }
}

/// The ground at rest under gravity while it is elastic; strengths are tried from there.
struct Settled
{
  Model model;
  Particles particles;
  double gravity, dt;
};

Settled settle(const Case& case_file)
{
  Settled ground{make_model(case_file), {}, case_file.static_stage.gravity, 0};
  add_static_boundaries(ground.model, case_file);
  Domain& domain = *ground.model.main;
  ground.dt = step_of(case_file.courant_number, domain);
  domain.settings.plastic = false;
  run(domain, ground.gravity, 0.5 * elastic_time, elastic_time, ground.dt);
  domain.settings.plastic = true;
  domain.settings.local_damping = 0;
  ground.particles = domain.particles;
  return ground;
}

/// Greatest displacement from the elastic state in m, of ground that has been given its strength.
double displacement(Settled& ground, double duration)
{
  Domain& domain = *ground.model.main;
  domain.particles = ground.particles;
  for (Material& material : domain.materials)
    for (auto& state : material.state) std::fill(state.begin(), state.end(), 0.0);
  sort_particles(domain);
  const std::vector<int> before = domain.particles.index_of;
  const Particles start = domain.particles;
  run(domain, ground.gravity, 0, duration, ground.dt);
  const Particles& p = domain.particles;
  double greatest = 0;
  for (std::size_t id = 0; id < before.size(); ++id)
    greatest = std::max(greatest, std::hypot(p.x[domain.particles.index_of[id]] - start.x[before[id]],
                                             p.y[domain.particles.index_of[id]] - start.y[before[id]]));
  return greatest;
}
} // namespace

Failure find_failure(const Case& case_file, const StrengthReduction& reduction)
{
  Settled ground = settle(case_file);
  Failure found{{"displacement", "trial", "displacement / height", {}, {}, {}}, 0};
  double stands = reduction.stands, falls = reduction.falls;
  while (falls - stands > reduction.tolerance)
  {
    const double trial = 0.5 * (stands + falls);
    reduction.weaken(*ground.model.main, trial);
    const double moved = displacement(ground, reduction.duration) / reduction.height;
    found.curve.x.push_back(trial);
    found.curve.model.push_back(moved);
    found.curve.reference.push_back(reduction.gone);
    (moved < reduction.gone ? stands : falls) = trial;
  }
  found.at = 0.5 * (stands + falls);
  return found;
}
} // namespace mpm::verification
