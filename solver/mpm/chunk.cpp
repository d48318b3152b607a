#include "solver/mpm/chunk.hpp"

namespace mpm
{
namespace
{
/// Particles up to a whole number of lanes.
int filled(int count)
{
  static_assert(chunk_size % lanes == 0 && lanes % 2 == 0);
  return (count + lanes - 1) / lanes * lanes;
}

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

void ChunkPlaces::find(const TileStencils& tile, const double* __restrict x, const double* __restrict y,
                       int count)
{
  const double inverse = 1 / tile.spacing();
  alignas(64) double column[chunk_size], row[chunk_size];
  locate(x, tile.from_x(), inverse, count, column, x_fraction);
  locate(y, tile.from_y(), inverse, count, row, y_fraction);
  for (int k = 0; k < count; ++k)
    node[k] = TileStencils::place(static_cast<int>(column[k]) - 1, static_cast<int>(row[k]) - 1);
  for (int k = count; k < filled(count); ++k)
  {
    x_fraction[k] = x_fraction[count - 1];
    y_fraction[k] = y_fraction[count - 1];
    node[k] = node[count - 1];
  }
}

void LaneSplines::find(const double* __restrict fraction, int count)
{
  const int all = filled(count);
#pragma GCC unroll 4
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < all; ++k)
    {
      const auto s = cubic_spline(fraction[k], [j](const double* of) { return of[j]; });
      weight[j][k] = s.weight;
      slope[j][k] = s.slope;
      moment[j][k] = s.moment;
    }
}

void RowSplines::find(const double* fraction, int count)
{
  fraction_ = fraction;
  if constexpr (!two_rows_a_register) return;
  for (int k = 0; k < count; k += 2)
  {
    const Spline<Pairs> s = cubic_spline(fraction[k], fraction[k + 1]);
    store_pairs(weight_[k], s.weight);
    store_pairs(slope_[k], s.slope);
    store_pairs(moment_[k], s.moment);
  }
}
} // namespace mpm
