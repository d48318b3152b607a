#include "solver/mpm/chunk.hpp"

#include <memory>

namespace mpm
{
namespace
{
/// Sums over the particles of one material in each cell, kept where the cell's lower left node is.
struct CellSums
{
  NodeField mass, change; ///< m and m tr L
};

/// What the first pass found of every particle for the second.
struct Scratch
{
  explicit Scratch(int particles)
      : rate(std::make_unique_for_overwrite<double[]>(particles)),
        place(std::make_unique_for_overwrite<int[]>(particles))
  {
  }
  std::unique_ptr<double[]> rate; ///< tr L = sum v* . grad w, 1/s
  std::unique_ptr<int[]> place;   ///< its cell in the tile of its block
};

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
  for (const Range& range : occupied.ranges)
    if (range.material == material)
      for (int p = range.begin; p < range.end; ++p) f(p);
}

void add_home(const Domain& domain, const OccupiedBlock& occupied, int material, Scratch& scratch,
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
                      const int place = TileStencils::place(x.first + 1, y.first + 1);
                      scratch.rate[p] = divergence(velocity, x, y);
                      scratch.place[p] = place;
                      sum.value[2 * place] += particles.mass[p];
                      sum.value[2 * place + 1] += particles.mass[p] * scratch.rate[p];
                    });
  add_tile(grid, occupied.around, sum, sums.mass, sums.change);
}

void apply_home(Domain& domain, const OccupiedBlock& occupied, int material, const Scratch& scratch,
                const CellSums& sums, double dt)
{
  Particles& particles = domain.particles;
  PairTile sum;
  read_tile(domain.grid, occupied.around, sums.mass, sums.change, sum);
  const double bulk = domain.materials[material].elastic().bulk_modulus();
  for_each_particle(occupied, material,
                    [&](int p)
                    {
                      const double* cell = &sum.value[2 * scratch.place[p]];
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
    parallel::for_each_in_turn(domain.blocks.colours,
                               [&](int k) { add_home(domain, domain.blocks.occupied[k], m, scratch, sums); });
    parallel::for_each(domain.blocks.awake,
                       [&](int k) { apply_home(domain, domain.blocks.occupied[k], m, scratch, sums, dt); });
  }
}
} // namespace mpm
