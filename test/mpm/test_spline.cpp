#include "solver/mpm/chunk.hpp"
#include "test/scenes.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using scenes::Random;

TEST_CASE("Cubic splines add up to one, reproduce the place and have the moment h2/3", "[mpm]")
{
  Random random(11);
  double unity = 0, place = 0, moment = 0, no_slope = 0, slope_place = 0;
  for (int trial = 0; trial < 10000; ++trial)
  {
    const double h = random(0.1, 10), x = random(-100, 100) * h;
    const Stencil s = cubic_stencil(x, h);
    double w = 0, wx = 0, wxx = 0, d = 0, dx = 0;
    for (int k = 0; k < 4; ++k)
    {
      REQUIRE(s.weight[k] >= 0);
      REQUIRE(std::fabs(s.offset[k]) <= 2 * h * (1 + 1e-12));
      w += s.weight[k];
      wx += s.weight[k] * s.offset[k];
      wxx += s.weight[k] * s.offset[k] * s.offset[k];
      d += s.slope[k];
      dx += s.slope[k] * s.offset[k];
      // The offsets lead to grid nodes; x itself is known to 100 h times 1e-16.
      REQUIRE(x + s.offset[k] == Approx((s.first + k) * h).margin(1e-12 * h));
    }
    unity = std::max(unity, std::fabs(w - 1));
    place = std::max(place, std::fabs(wx) / h);
    moment = std::max(moment, std::fabs(wxx / (h * h / 3) - 1));
    no_slope = std::max(no_slope, std::fabs(d) * h);
    slope_place = std::max(slope_place, std::fabs(dx - 1));
  }
  // Four terms of order one: a few times the unit round-off.
  CHECK(unity < 2e-15);
  CHECK(place < 2e-15);
  CHECK(moment < 1e-14);
  CHECK(no_slope < 2e-15);
  CHECK(slope_place < 5e-15);
}

TEST_CASE("Slopes are the derivatives of the weights", "[mpm]")
{
  Random random(12);
  const double h = 0.7, d = 0.02; // the difference formula stays within the cell, where N is a cubic
  double worst = 0;
  for (int trial = 0; trial < 1000; ++trial)
  {
    const double f = random(0.05, 0.95);
    const auto weight = [&](double at, int k) { return cubic_stencil((3 + at) * h, h).weight[k]; };
    const Stencil s = cubic_stencil((3 + f) * h, h);
    for (int k = 0; k < 4; ++k)
    {
      const double difference =
          (weight(f - 2 * d, k) - 8 * weight(f - d, k) + 8 * weight(f + d, k) - weight(f + 2 * d, k)) /
          (12 * d * h);
      worst = std::max(worst, std::fabs(difference - s.slope[k]) * h);
    }
  }
  CHECK(worst < 5e-14); // exact for cubics but for round-off 1e-16 / d, times the coordinate 4
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
