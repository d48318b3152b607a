#include "solver/mpm/chunk.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using domains::Random;

TEST_CASE("A spline has four weights that are not negative and lead to its nodes", "[mpm]")
{
  Random random(11);
  for (int trial = 0; trial < 1000; ++trial)
  {
    const double h = random(0.1, 10), x = random(-100, 100) * h;
    const Stencil s = cubic_stencil(x, h);
    for (int k = 0; k < 4; ++k)
    {
      REQUIRE(s.weight[k] >= 0);
      REQUIRE(std::fabs(s.offset[k]) <= 2 * h * (1 + 1e-12));
      // x itself is known to 100 h times 1e-16.
      REQUIRE(x + s.offset[k] == Approx((s.first + k) * h).margin(1e-12 * h));
    }
  }
}

TEST_CASE("A node's weight and slope are continuous when a particle crosses a grid line", "[mpm]")
{
  const Stencil before = cubic_stencil(std::nextafter(5.0, 0.0), 1), after = cubic_stencil(5.0, 1);
  REQUIRE(after.first == before.first + 1);
  CHECK(before.weight[0] < 1e-40); // the node that is left behind had a cube of the round-off
  for (int k = 0; k < 3; ++k)
  {
    CHECK(std::fabs(before.weight[k + 1] - after.weight[k]) < 1e-15);
    CHECK(std::fabs(before.slope[k + 1] - after.slope[k]) < 3e-15); // curvature 2 times 1e-15
  }
}

TEST_CASE("Weights of a chunk are those of the spline, also of particles that drifted out of their block",
          "[mpm]")
{
  Random random(13);
  Grid grid;
  grid.spacing = 0.7;
  grid.origin_x = -3.1;
  grid.origin_y = 12.9;
  double worst = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    const BlockIndex block{static_cast<int>(random(-20, 20)), static_cast<int>(random(-20, 20))};
    const int count = 1 + trial % chunk_size;
    std::array<double, chunk_size> x, y;
    for (int k = 0; k < count; ++k)
    {
      x[k] = grid.origin_x + grid.spacing * (block_cells * block.x + random(-0.75, block_cells + 0.75));
      y[k] = grid.origin_y + grid.spacing * (block_cells * block.y + random(-0.75, block_cells + 0.75));
    }
    const TileStencils stencils(grid, block);
    for (int k = 0; k < count; ++k)
    {
      const Stencil sx = cubic_stencil(x[k] - grid.origin_x, grid.spacing);
      const Stencil sy = cubic_stencil(y[k] - grid.origin_y, grid.spacing);
      const int column = sx.first - block.x * block_cells + tile_margin;
      const int row = sy.first - block.y * block_cells + tile_margin;
      REQUIRE(column >= 0);
      REQUIRE(column + 3 < tile_nodes);
      const auto wx = stencils.x(x[k]), wy = stencils.y(y[k]);
      REQUIRE(TileStencils::first_node(wx, wy) == row * tile_stride + column);
      for (int i = 0; i < 4; ++i)
        for (const double error : {wx.weight[i] - sx.weight[i], wy.weight[i] - sy.weight[i],
                                   (wx.slope[i] - sx.slope[i]) * 0.7, (wy.slope[i] - sy.slope[i]) * 0.7,
                                   (wx.offset[i] - sx.offset[i]) / 0.7, (wy.offset[i] - sy.offset[i]) / 0.7})
          worst = std::max(worst, std::fabs(error));
    }
  }
  CHECK(worst < 3e-13); // both take the local coordinate from numbers up to 160 cells: 160 * 1e-16 * a few
}
