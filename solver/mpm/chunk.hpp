#pragma once

#include "solver/mpm/domain.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/mpm/spline.hpp"
#include "solver/mpm/step.hpp"

#include <algorithm>

namespace mpm
{
/// Spline weights of up to 64 particles, four nodes each, and the place of their first node in the block's
/// tile.
struct ChunkWeights
{
  alignas(64) std::array<double, 4 * chunk_size> x, y, slope_x, slope_y, offset_x, offset_y;
  std::array<int, chunk_size> tile;
};

/// Weights of particles at `x`, `y` (m) that belong to `block`.
inline void find_weights(const Grid& grid, BlockIndex block, const double* x, const double* y, int count,
                         ChunkWeights& w)
{
  const double h = grid.spacing, inverse = 1 / h;
  const double from_x = grid.origin_x + h * block_cells * block.x,
               from_y = grid.origin_y + h * block_cells * block.y;
  const auto direction = [=](double position, double from, double* value, double* slope, double* offset)
  {
    const double local = (position - from) * inverse;
    const double cell = std::floor(local);
    const double f = local - cell;
    cubic_weights(f, value[0], value[1], value[2], value[3]);
    cubic_slopes(f, slope[0], slope[1], slope[2], slope[3]);
    for (int k = 0; k < 4; ++k)
    {
      slope[k] *= inverse;
      offset[k] = (k - 1 - f) * h;
    }
    return static_cast<int>(cell) - 1 + tile_margin;
  };
#pragma GCC ivdep
  for (int p = 0; p < count; ++p)
  {
    const int column = direction(x[p], from_x, &w.x[4 * p], &w.slope_x[4 * p], &w.offset_x[4 * p]);
    const int row = direction(y[p], from_y, &w.y[4 * p], &w.slope_y[4 * p], &w.offset_y[4 * p]);
    w.tile[p] = row * tile_stride + column;
  }
}

/// Calls f(material, begin, count) for the chunks of a home block, in the order in which they are summed.
template <class Function>
void for_each_chunk(const Home& home, const Function& f)
{
  for (const Range& range : home.ranges)
    for (int begin = range.begin; begin < range.end; begin += chunk_size)
      f(range.material, begin, std::min(chunk_size, range.end - begin));
}
} // namespace mpm
