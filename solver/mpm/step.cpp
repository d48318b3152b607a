#include "solver/mpm/step.hpp"

#include <cmath>

namespace mpm
{
namespace
{
/// Cells that a particle may drift from its block before the next sort; the tile margin holds one.
constexpr double drift_limit = 0.75;
constexpr double move_limit = 0.25;

/// Keeps the particles of a column within the one cell, together with their reference positions.
void wrap(Domain& domain)
{
  Particles& p = domain.particles;
  const double width = domain.grid.spacing, left = domain.grid.origin_x;
  for (int k = 0; k < p.size(); ++k)
  {
    const double shift = p.x[k] < left ? width : p.x[k] >= left + width ? -width : 0;
    p.x[k] += shift;
    p.reference_x[k] += shift;
  }
}

void find_diverged(const Domain& domain)
{
  if (domain.measures.greatest_move <= move_limit && std::isfinite(domain.energy.step.work)) return;
  throw Diverged(
      domain.name +
      ": a particle moves more than a quarter of a cell, or is deformed wholly, in the step at t = " +
      std::to_string(domain.time) + " s");
}
} // namespace

void step(Domain& domain, double dt)
{
  domain.measures.times.start();
  if (domain.blocks.drift > drift_limit - move_limit) sort_particles(domain);
  domain.measures.times.lap(Phase::sort);
  particles_to_grid(domain, dt); // (a) mass, momentum and forces to the grid
  solve_grid(domain, dt);        // (b) equation of motion
  domain.measures.times.lap(Phase::grid);
  account(domain, dt); //     its work, for the energy balance
  domain.measures.times.lap(Phase::boundaries);
  if (domain.settings.average_volume) average_volume_changes(domain, dt);
  grid_to_particles(domain, dt); // (c) velocities back to the particles, (d) deformation and stress
  find_diverged(domain);
  domain.blocks.drift += domain.measures.greatest_move;
  if (domain.grid.wrapped) wrap(domain);
  domain.measures.times.lap(Phase::gather);
}
} // namespace mpm
