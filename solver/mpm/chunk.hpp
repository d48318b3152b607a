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
  /// Stencils of a direction; nodes count from the block's first.
  Stencil x(double position) const { return cubic_stencil(position - from_x_, spacing_, inverse_); }
  Stencil y(double position) const { return cubic_stencil(position - from_y_, spacing_, inverse_); }
  /// Place of the first node of a stencil in the tile.
  static int first_node(const Stencil& x, const Stencil& y)
  {
    return (y.first + tile_margin) * tile_stride + x.first + tile_margin;
  }

private:
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
