#include "solver/mpm/chunk.hpp"

namespace mpm
{
namespace
{
/// Cell and fraction of it in which each of `count` positions stands.
void locate(const double* __restrict position, double from, double inverse, int count,
            double* __restrict cell, double* __restrict fraction)
{
  for (int k = 0; k < count; ++k)
  {
    const double local = (position[k] - from) * inverse;
    cell[k] = std::floor(local);
    fraction[k] = local - cell[k];
  }
}
} // namespace

void ChunkStencils::find(const TileStencils& tile, const double* __restrict x, const double* __restrict y,
                         int count)
{
  const double inverse = 1 / tile.spacing();
  alignas(64) double column[chunk_size], row[chunk_size], y_fraction[chunk_size];
  locate(x, tile.from_x(), inverse, count, column, x_fraction);
  locate(y, tile.from_y(), inverse, count, row, y_fraction);
  for (int k = 0; k < count; ++k)
    node[k] = TileStencils::place(static_cast<int>(column[k]) - 1, static_cast<int>(row[k]) - 1);
#pragma GCC unroll 4
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < count; ++k)
    {
      const auto s = cubic_spline(y_fraction[k], [j](const double* all) { return all[j]; });
      y_weight[j][k] = s.weight;
      y_slope[j][k] = s.slope;
      y_moment[j][k] = s.moment;
    }
}

void ChunkStencils::find_rows(int count)
{
  if constexpr (!two_rows_a_register) return;
  static_assert(chunk_size % 2 == 0);
  if (count % 2 == 1) x_fraction[count] = 0; // the second of the last two, which is not there
  for (int k = 0; k < count; k += 2)
  {
    const Spline<Pairs> s = cubic_spline(x_fraction[k], x_fraction[k + 1]);
    store_pairs(x_weight[k], s.weight);
    store_pairs(x_slope[k], s.slope);
    store_pairs(x_moment[k], s.moment);
  }
}
} // namespace mpm
