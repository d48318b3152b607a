#include "solver/mpm/chunk.hpp"

#include <memory>

namespace mpm
{
namespace
{
/// Sums over the particles of one material in each cell, held at the cell's lower left node.
struct CellSums
{
  NodeField mass, change; ///< m and m tr L
};

/// What the first pass found of every particle for the second.
struct Scratch
{
  explicit Scratch(int particles)
      : rate(std::make_unique_for_overwrite<double[]>(particles)),
        cell(std::make_unique_for_overwrite<int[]>(particles))
  {
  }
  std::unique_ptr<double[]> rate; ///< tr L = sum v* . grad w, 1/s
  std::unique_ptr<int[]> cell;    ///< tile index of its cell's lower left node
};

/// tr L = sum v* . grad w at a particle, 1/s.
double divergence(const PairTile& velocity, const Stencil& x, const Stencil& y)
{
  double sum = 0;
  for (int j = 0; j < 4; ++j)
  {
    const double* v = &velocity.value[2 * (TileStencils::first_node(x, y) + j * tile_stride)];
    for (int i = 0; i < 4; ++i)
      sum += x.slope[i] * y.weight[j] * v[2 * i] + x.weight[i] * y.slope[j] * v[2 * i + 1];
  }
  return sum;
}

/// Calls f(particle) for the particles of a material in a block.
template <class Function>
void for_each_particle(const OccupiedBlock& occupied, int material, const Function& f)
{
  for (const ParticleRange& range : occupied.ranges)
    if (range.material == material)
      for (int p = range.begin; p < range.end; ++p) f(p);
}

/// First pass: finds tr L of a block's particles of one material, and adds m and m tr L to their cells.
void add_block(const Domain& domain, const OccupiedBlock& occupied, int material, Scratch& scratch,
               CellSums& sums)
{
  const Grid& grid = domain.grid;
  const Particles& particles = domain.particles;
  PairTile velocity, sum;
  read_tile(grid, occupied.around, grid.velocity_x, grid.velocity_y, velocity);
  sum.value.fill(0);
  const TileStencils tile(grid, occupied.block);
  for_each_particle(occupied, material,
                    [&](int p)
                    {
                      const Stencil x = tile.x(particles.x[p]), y = tile.y(particles.y[p]);
                      const int cell = tile_index(x.first + 1, y.first + 1);
                      scratch.rate[p] = divergence(velocity, x, y);
                      scratch.cell[p] = cell;
                      sum.value[2 * cell] += particles.mass[p];
                      sum.value[2 * cell + 1] += particles.mass[p] * scratch.rate[p];
                    });
  add_tile(grid, occupied.around, sum, sums.mass, sums.change);
}

/// Second pass: sigma += K dt (mean - tr L) 1 and V *= 1 + dt (mean - tr L), with the mean over the cell, sum
/// m tr L / sum m.
void apply_block(Domain& domain, const OccupiedBlock& occupied, int material, const Scratch& scratch,
                 const CellSums& sums, double dt)
{
  Particles& particles = domain.particles;
  PairTile sum;
  read_tile(domain.grid, occupied.around, sums.mass, sums.change, sum);
  const double bulk = domain.materials[material].elastic().bulk_modulus();
  for_each_particle(occupied, material,
                    [&](int p)
                    {
                      const double* cell = &sum.value[2 * scratch.cell[p]];
                      const double strain = dt * (cell[1] / cell[0] - scratch.rate[p]);
                      particles.stress_xx[p] += bulk * strain;
                      particles.stress_yy[p] += bulk * strain;
                      particles.stress_zz[p] += bulk * strain;
                      particles.volume[p] *= 1 + strain;
                    });
}
} // namespace

void average_volume_changes(Domain& domain, double dt)
{
  Scratch scratch(domain.particles.size());
  CellSums sums;
  for (int m = 0; m < static_cast<int>(domain.materials.size()); ++m)
  {
    if (domain.materials[m].state_fields().empty()) continue;
    sums.mass.assign(domain.grid.nodes(), 0.0);
    sums.change.assign(domain.grid.nodes(), 0.0);
    parallel::for_each_in_turn(domain.blocks.colours, [&](int k)
                               { add_block(domain, domain.blocks.occupied[k], m, scratch, sums); });
    parallel::for_each(domain.blocks.awake,
                       [&](int k) { apply_block(domain, domain.blocks.occupied[k], m, scratch, sums, dt); });
  }
}
} // namespace mpm
