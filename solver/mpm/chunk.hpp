#pragma once

#include "solver/mpm/domain.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/mpm/spline.hpp"
#include "solver/mpm/step.hpp"

#include <algorithm>

namespace mpm
{
/// Where a block's particles stand in its tile: turns positions (m) into stencils, one after the other.
class TileStencils
{
public:
  TileStencils(const Grid& grid, BlockIndex block)
      : spacing_(grid.spacing), inverse_(1 / grid.spacing),
        from_x_(grid.origin_x + grid.spacing * block_cells * block.x),
        from_y_(grid.origin_y + grid.spacing * block_cells * block.y)
  {
  }
  /// The four nodes of a direction at once; `cell` counts from the block's first.
  struct Direction
  {
    int cell;
    Row weight, slope, offset; ///< N, dN/dx in 1/m, x_i - x in m
  };
  Direction x(double position) const { return direction(position - from_x_); }
  Direction y(double position) const { return direction(position - from_y_); }
  /// Place of the first node of a stencil in the tile.
  static int first_node(const Direction& x, const Direction& y)
  {
    return (y.cell - 1 + tile_margin) * tile_stride + x.cell - 1 + tile_margin;
  }

private:
  Direction direction(double distance) const
  {
    const double local = distance * inverse_, cell = std::floor(local);
    const double f = local - cell, g = 1 - f;
    // The outer splines are cubes, so that small weights keep their relative accuracy; the third is what the
    // others leave of one, so that no momentum is lost on average.
    const Row t{g, f, g, f};
    Row weight = Row{0, 2.0 / 3, 0, 0} + t * t * (t * Row{1.0 / 6, 0.5, 0, 1.0 / 6} - Row{0, 1, 0, 0});
    weight[2] = (1 - weight[1]) - (weight[0] + weight[3]);
    const Row slope = inverse_ * t * (t * Row{-0.5, 1.5, -1.5, 0.5} + Row{0, -2, 2, 0});
    const Row offset = spacing_ * (Row{-1, 0, 1, 2} - f);
    return {static_cast<int>(cell), weight, slope, offset};
  }
  double spacing_, inverse_, from_x_, from_y_;
};

/// Calls f(material, begin, count) for the chunks of a home block, in the order in which they are summed.
template <class Function>
void for_each_chunk(const Home& home, const Function& f)
{
  for (const Range& range : home.ranges)
    for (int begin = range.begin; begin < range.end; begin += chunk_size)
      f(range.material, begin, std::min(chunk_size, range.end - begin));
}
} // namespace mpm
