#include "solver/mpm/chunk.hpp"

namespace mpm
{
namespace
{
/// `count` up to a whole number of lanes.
int filled(int count)
{
  static_assert(chunk_size % lanes == 0 && lanes % 2 == 0);
  return (count + lanes - 1) / lanes * lanes;
}

/// Stores the first nodes of stencils. A place that is no number, or out of reach, must not lead out of the
/// tile; the end of the step finds it.
void store_within(int* to, const Lanes& nodes)
{
  typedef unsigned Unsigned __attribute__((vector_size(lanes * sizeof(int))));
  store_integers(to, nodes);
  Unsigned first;
  std::memcpy(&first, to, sizeof first);
  first = first < last_first_node ? first : last_first_node - Unsigned{}; // of what is negative too
  std::memcpy(to, &first, sizeof first);
}

/// The cells in which some points stand, along one direction, and how far into them: x = from + h (cell +
/// fraction).
struct CellLanes
{
  Lanes cell, fraction;

  CellLanes(const Lanes& position, double from, double inverse)
  {
    const Lanes local = (position - from) * inverse;
    cell = floor_of(local);
    fraction = local - cell;
  }
};
} // namespace

void ChunkCells::fill(const TileStencils& tile, const double* __restrict x, const double* __restrict y,
                      int count)
{
  const double inverse = 1 / tile.spacing();
  constexpr int first = tile_index(-1, -1); // a stencil begins a node before its cell
  for (int k = 0; k < count; k += lanes)
  {
    const CellLanes column(load_first(x + k, count - k), tile.from_x(), inverse);
    const CellLanes row(load_first(y + k, count - k), tile.from_y(), inverse);
    store(&x_fraction[k], column.fraction);
    store(&y_fraction[k], row.fraction);
    store_within(&node[k], tile_stride * row.cell + column.cell + first);
  }
  for (int k = count; k < filled(count); ++k)
  {
    x_fraction[k] = x_fraction[count - 1];
    y_fraction[k] = y_fraction[count - 1];
    node[k] = node[count - 1];
  }
}

void LaneSplines::fill(const double* __restrict fraction, int count)
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

void RowSplines::fill(const double* fraction, int count)
{
  fraction_ = fraction;
  if constexpr (!two_rows_a_register) return;
  for (int k = 0; k < count; k += 2)
  {
    const Spline<Pairs> s = cubic_spline(fraction[k], fraction[k + 1]);
    store(weight_[k], s.weight);
    store(slope_[k], s.slope);
    store(moment_[k], s.moment);
  }
}
} // namespace mpm
