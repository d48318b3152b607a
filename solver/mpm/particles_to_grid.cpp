#include "solver/mpm/chunk.hpp"

namespace mpm
{
namespace
{
/// What the particles of a block bring to the nodes.
struct Tiles
{
  Tile mass;
  PairTile momentum, force;
};

/// What the particles of a chunk have to give, as vectors (x, y) one after the other: mass m, momentum m v
/// and m C column by column (eq. 2), internal force -V sigma column by column; all over the factors of the
/// splines.
struct Sources
{
  alignas(64) double mass[chunk_size];
  alignas(64) double momentum[chunk_size][2], spread_x[chunk_size][2], spread_y[chunk_size][2];
  alignas(64) double force_x[chunk_size][2], force_y[chunk_size][2];

  void gather(const Particles& p, int begin, int count, double mass_scale, double spacing)
  {
    const double mass_factor = mass_scale * inverse_weights, volume_factor = inverse_slopes / spacing;
    for (int k = 0; k < count; ++k)
    {
      const int q = begin + k;
      const double m = mass_factor * p.mass[q], mh = spacing * m, V = volume_factor * p.volume[q];
      mass[k] = m;
      momentum[k][0] = m * p.velocity_x[q];
      momentum[k][1] = m * p.velocity_y[q];
      spread_x[k][0] = mh * p.affine_xx[q];
      spread_x[k][1] = mh * p.affine_yx[q];
      spread_y[k][0] = mh * p.affine_xy[q];
      spread_y[k][1] = mh * p.affine_yy[q];
      force_x[k][0] = -V * p.stress_xx[q];
      force_x[k][1] = force_y[k][0] = -V * p.stress_xy[q];
      force_y[k][1] = -V * p.stress_yy[q];
    }
  }
};

/// Sums at the 16 nodes of one cell's stencil over the particles in that cell, which follow each other:
///
///   m_i = sum N_i m,   P_i = sum N_i m (v + C (x_i - x)),   f_i = -sum V sigma grad N_i.
///
/// N_i is a product of two splines, so that all of x (weight, slope, moment) comes as a row of four nodes
/// once a particle, and all of y as a number for each of the four rows.
class CellSums
{
public:
  explicit CellSums(int node) : node_(node) {}

  void add(const ChunkStencils& s, const Sources& from, int k)
  {
    const Spline<Row> x = s.x[k];
    const Pairs w = twice(x.weight), slope = twice(x.slope), moment = twice(x.moment);
    const Row m = from.mass[k] * x.weight;
    const Pairs p_w = w * everywhere(from.momentum[k]) + moment * everywhere(from.spread_x[k]);
    const Pairs p_moment = w * everywhere(from.spread_y[k]);
    const Pairs f_w = slope * everywhere(from.force_x[k]), f_slope = w * everywhere(from.force_y[k]);
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j)
    {
      const double wy = s.y.weight[j][k], dwy = s.y.slope[j][k], my = s.y.moment[j][k];
      mass_[j] += wy * m;
      momentum_[j] += wy * p_w;
      momentum_[j] += my * p_moment;
      force_[j] += wy * f_w;
      force_[j] += dwy * f_slope;
    }
  }

  void add_to(Tiles& tiles) const
  {
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j)
    {
      const int node = node_ + j * tile_stride;
      double *mass = &tiles.mass.value[node], *momentum = &tiles.momentum.value[2 * node],
             *force = &tiles.force.value[2 * node];
      store(mass, load_as<Row>(mass) + mass_[j]);
      store(momentum, load_as<Pairs>(momentum) + momentum_[j]);
      store(force, load_as<Pairs>(force) + force_[j]);
    }
  }

private:
  int node_;
  Row mass_[4]{};
  Pairs momentum_[4]{}, force_[4]{};
};

/// Adds a chunk to the tiles, cell by cell.
void scatter(const ChunkStencils& stencils, const Sources& sources, int count, Tiles& tiles,
             const Prefetch& next)
{
  for (int k = 0; k < count;)
  {
    const int node = stencils.cells.node[k];
    CellSums sums(node);
    for (; k < count && stencils.cells.node[k] == node; ++k)
    {
      if ((k & 1) == 0) next.fetch(k & ~7, (k & 6) / 2);
      sums.add(stencils, sources, k);
    }
    sums.add_to(tiles);
  }
}

/// Adds one material's particles of a block to its tiles.
void scatter_range(const Domain& domain, const TileStencils& tile, const ParticleRange& range,
                   double mass_scale, Tiles& tiles)
{
  const Particles& p = domain.particles;
  ChunkStencils stencils;
  Sources sources;
  for_each_chunk(range,
                 [&](int begin, int count)
                 {
                   const double* none = &p.x[begin];
                   const Prefetch next(p, begin, none, none, none);
                   stencils.fill(tile, &p.x[begin], &p.y[begin], count);
                   sources.gather(p, begin, count, mass_scale, domain.grid.spacing);
                   scatter(stencils, sources, count, tiles, next);
                 });
}

/// Adds the particles of a block to the grid, materials of the same mass scale together. The weight of a node
/// is its mass times gravity; where a static stage scales masses, weights stay as they are.
void scatter_block(Domain& domain, const OccupiedBlock& occupied)
{
  Grid& grid = domain.grid;
  const TileStencils tile(grid, occupied.block);
  const auto scale_of = [&](const ParticleRange& range)
  { return domain.materials[range.material].mass_scale; };
  for (auto range = occupied.ranges.begin(); range != occupied.ranges.end();)
  {
    Tiles tiles;
    std::memset(&tiles, 0, sizeof tiles);
    const double mass_scale = scale_of(*range);
    for (; range != occupied.ranges.end() && scale_of(*range) == mass_scale; ++range)
      scatter_range(domain, tile, *range, mass_scale, tiles);
    const double gx = domain.settings.gravity_x / mass_scale, gy = domain.settings.gravity_y / mass_scale;
    for (int k = 0; k < tile_size; ++k)
    {
      tiles.force.value[2 * k] += gx * tiles.mass.value[k];
      tiles.force.value[2 * k + 1] += gy * tiles.mass.value[k];
    }
    add_tile(grid, occupied.around, tiles.mass, grid.mass);
    add_tile(grid, occupied.around, tiles.momentum, grid.momentum_x, grid.momentum_y);
    add_tile(grid, occupied.around, tiles.force, grid.force_x, grid.force_y);
  }
}
} // namespace

void particles_to_grid(Domain& domain, double dt)
{
  domain.grid.for_each_block([&](int k) { domain.grid.clear(k); });
  parallel::for_each_in_turn(domain.blocks.colours,
                             [&](int k) { scatter_block(domain, domain.blocks.occupied[k]); });
  domain.measures.times.end(Phase::scatter);
  for (const auto& boundary : domain.boundaries) boundary->add_forces(domain, dt);
  domain.measures.times.end(Phase::boundaries);
}
} // namespace mpm
