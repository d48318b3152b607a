#include "solver/mpm/step.hpp"

#include "solver/mpm/flow.hpp"
#include "solver/mpm/health.hpp"

#include <cmath>

namespace mpm
{
namespace
{
/// Particles are sorted again before one may come within a quarter of a cell of the end of its tile.
constexpr double sort_limit = drift_cells - move_limit;

/// Keeps the particles of a column within the one cell: one that leaves it to the left comes in from the
/// right. Its reference position goes with it, so that displacements stay what they are.
void wrap(Particles& p, const Grid& grid)
{
  const double width = grid.spacing, left = grid.origin_x;
  for (int k = 0; k < p.size(); ++k)
  {
    const double shift = p.x[k] < left ? width : p.x[k] >= left + width ? -width : 0;
    p.x[k] += shift;
    p.reference_x[k] += shift;
  }
}

void throw_if_diverged(const Domain& domain, double dt)
{
  if (domain.measures.greatest_move <= move_limit && std::isfinite(domain.energy.step.work)) return;
  throw Diverged(failed_step(domain, dt));
}
} // namespace

void step(Domain& domain, double dt)
{
  domain.measures.times.start();
  if (domain.blocks.drift > sort_limit - move_limit)
  {
    check_places(domain);
    sort_particles(domain);
  }
  domain.measures.times.end(Phase::sort);
  filter_velocities(domain, dt);
  follow_flow(domain, dt);
  particles_to_grid(domain, dt); // (a)
  solve_grid(domain, dt);        // (b)
  domain.measures.times.end(Phase::grid);
  account(domain, dt); // what its forces did, for the energy balance
  domain.measures.times.end(Phase::boundaries);
  if (domain.settings.average_volume) average_volume_changes(domain, dt);
  grid_to_particles(domain, dt); // (c), (d)
  throw_if_diverged(domain, dt);
  domain.blocks.drift += domain.measures.greatest_move;
  if (domain.grid.wrapped) wrap(domain.particles, domain.grid);
  domain.measures.times.end(Phase::gather);
}
} // namespace mpm
