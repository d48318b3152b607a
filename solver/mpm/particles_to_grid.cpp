#include "solver/mpm/chunk.hpp"

namespace mpm
{
namespace
{
struct Tiles
{
  Tile mass, momentum_x, momentum_y, force_x, force_y;
};

inline void add(double* to, const Row& row)
{
  store_row(to, load_row(to) + row);
}

/// Momentum by eq. (2), internal force f = -V sigma grad w.
void scatter(const Particles& p, int begin, int count, const ChunkWeights& w, Tiles& tiles)
{
  for (int k = 0; k < count; ++k)
  {
    const int q = begin + k;
    const Row wx = load_row(&w.x[4 * k]), dwx = load_row(&w.slope_x[4 * k]),
              dx = load_row(&w.offset_x[4 * k]);
    const double V = p.volume[q];
    const Row m = p.mass[q] * wx;
    const Row ux = m * (p.velocity_x[q] + p.affine_xx[q] * dx), ux_dy = m * p.affine_xy[q];
    const Row uy = m * (p.velocity_y[q] + p.affine_yx[q] * dx), uy_dy = m * p.affine_yy[q];
    const Row fx_w = (-V * p.stress_xx[q]) * dwx, fx_dw = (-V * p.stress_xy[q]) * wx;
    const Row fy_w = (-V * p.stress_xy[q]) * dwx, fy_dw = (-V * p.stress_yy[q]) * wx;
    for (int j = 0; j < 4; ++j)
    {
      const double wy = w.y[4 * k + j], dwy = w.slope_y[4 * k + j], wdy = wy * w.offset_y[4 * k + j];
      const int node = w.tile[k] + j * tile_stride;
      add(&tiles.mass.value[node], wy * m);
      add(&tiles.momentum_x.value[node], wy * ux + wdy * ux_dy);
      add(&tiles.momentum_y.value[node], wy * uy + wdy * uy_dy);
      add(&tiles.force_x.value[node], wy * fx_w + dwy * fx_dw);
      add(&tiles.force_y.value[node], wy * fy_w + dwy * fy_dw);
    }
  }
}

void scatter_home(Domain& domain, const Home& home)
{
  Tiles tiles;
  for (Tile* tile : {&tiles.mass, &tiles.momentum_x, &tiles.momentum_y, &tiles.force_x, &tiles.force_y})
    tile->value.fill(0);
  ChunkWeights weights;
  const Particles& p = domain.particles;
  for_each_chunk(home,
                 [&](int, int begin, int count)
                 {
                   find_weights(domain.grid, home.block, &p.x[begin], &p.y[begin], count, weights);
                   scatter(p, begin, count, weights, tiles);
                 });
  for (int k = 0; k < tile_size; ++k)
  {
    tiles.force_x.value[k] += domain.gravity_x * tiles.mass.value[k];
    tiles.force_y.value[k] += domain.gravity_y * tiles.mass.value[k];
  }
  Grid& grid = domain.grid;
  add_tile(grid, home.around, tiles.mass, grid.mass);
  add_tile(grid, home.around, tiles.momentum_x, grid.momentum_x);
  add_tile(grid, home.around, tiles.momentum_y, grid.momentum_y);
  add_tile(grid, home.around, tiles.force_x, grid.force_x);
  add_tile(grid, home.around, tiles.force_y, grid.force_y);
}
} // namespace

void particles_to_grid(Domain& domain, double dt)
{
  parallel::for_each(static_cast<int>(domain.grid.blocks.size()), [&](int k) { domain.grid.clear(k); });
  for (const auto& colour : domain.colours)
    parallel::for_each(static_cast<int>(colour.size()),
                       [&](int k) { scatter_home(domain, domain.homes[colour[k]]); });
  for (const auto& boundary : domain.boundaries) boundary->add_forces(domain, dt);
}
} // namespace mpm
