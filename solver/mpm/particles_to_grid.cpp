#include "solver/mpm/chunk.hpp"

namespace mpm
{
namespace
{
struct Tiles
{
  Tile mass, momentum_x, momentum_y, force_x, force_y;
};

inline void add(Tile& tile, int node, const Row& row)
{
  store_row(&tile.value[node], load_row(&tile.value[node]) + row);
}

/// Momentum by eq. (2), internal force f = -V sigma grad w.
void scatter(const Particles& p, const Range& range, const TileStencils& stencils, Tiles& tiles)
{
  for (int q = range.begin; q < range.end; ++q)
  {
    const auto x = stencils.x(p.x[q]), y = stencils.y(p.y[q]);
    const int first = TileStencils::first_node(x, y);
    const double V = p.volume[q];
    const Row m = p.mass[q] * x.weight;
    const Row ux = m * (p.velocity_x[q] + p.affine_xx[q] * x.offset), ux_dy = m * p.affine_xy[q];
    const Row uy = m * (p.velocity_y[q] + p.affine_yx[q] * x.offset), uy_dy = m * p.affine_yy[q];
    const Row fx_w = (-V * p.stress_xx[q]) * x.slope, fx_dw = (-V * p.stress_xy[q]) * x.weight;
    const Row fy_w = (-V * p.stress_xy[q]) * x.slope, fy_dw = (-V * p.stress_yy[q]) * x.weight;
    const Row y_moment = y.weight * y.offset;
    for (int j = 0; j < 4; ++j)
    {
      const double wy = y.weight[j], dwy = y.slope[j], wdy = y_moment[j];
      const int node = first + j * tile_stride;
      add(tiles.mass, node, wy * m);
      add(tiles.momentum_x, node, wy * ux + wdy * ux_dy);
      add(tiles.momentum_y, node, wy * uy + wdy * uy_dy);
      add(tiles.force_x, node, wy * fx_w + dwy * fx_dw);
      add(tiles.force_y, node, wy * fy_w + dwy * fy_dw);
    }
  }
}

void scatter_home(Domain& domain, const Home& home)
{
  Tiles tiles;
  for (Tile* tile : {&tiles.mass, &tiles.momentum_x, &tiles.momentum_y, &tiles.force_x, &tiles.force_y})
    tile->value.fill(0);
  const TileStencils stencils(domain.grid, home.block);
  for (const Range& range : home.ranges) scatter(domain.particles, range, stencils, tiles);
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
