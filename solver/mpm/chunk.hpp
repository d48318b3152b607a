#pragma once

#include "solver/mpm/domain.hpp"
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
      : spacing_(grid.spacing), from_x_(grid.origin_x + grid.spacing * block_cells * block.x),
        from_y_(grid.origin_y + grid.spacing * block_cells * block.y)
  {
  }
  /// Stencils of a direction; nodes count from the block's first.
  Stencil x(double position) const { return cubic_stencil(position - from_x_, spacing_); }
  Stencil y(double position) const { return cubic_stencil(position - from_y_, spacing_); }
  /// Place of the first node of a stencil in the tile.
  static int first_node(const Stencil& x, const Stencil& y) { return place(x.first, y.first); }
  static constexpr int place(int i, int j) { return (j + tile_margin) * tile_stride + i + tile_margin; }

  double spacing() const { return spacing_; }
  double from_x() const { return from_x_; }
  double from_y() const { return from_y_; }

private:
  double spacing_, from_x_, from_y_;
};

/// Products of the splines of both directions come with these factors, which are taken out particle by
/// particle: weight and weight; slope and weight, over 1/h; moment and weight, over h.
inline constexpr double inverse_weights = 1 / (spline_weight * spline_weight),
                        inverse_slopes = 1 / (spline_slope * spline_weight);

/// Where a chunk of particles stands in its tile.
struct ChunkPlaces
{
  alignas(64) double x_fraction[chunk_size], y_fraction[chunk_size]; ///< of the cell
  alignas(64) int node[chunk_size]; ///< first node of the stencil in the tile

  /// Fills the places of `count` particles of a tile, and of as many as fill the lanes with the last one.
  void find(const TileStencils& tile, const double* __restrict x, const double* __restrict y, int count);
};

/// Splines of a chunk's particles along one direction, node by node of the stencil.
struct LaneSplines
{
  alignas(64) double weight[4][chunk_size], slope[4][chunk_size], moment[4][chunk_size];

  /// Fills those of `count` particles, and of as many as fill the lanes.
  void find(const double* __restrict fraction, int count);
};

/// The same, particle by particle: a row of nodes each.
class RowSplines
{
public:
  /// Fills the rows of `count` particles, two at a time where a register holds both, or leaves them to find
  /// one by one.
  void find(const double* fraction, int count);
  /// Of particle k.
  Spline<Row> operator[](int k) const
  {
    if constexpr (two_rows_a_register)
      return {load_as<Row>(weight_[k]), load_as<Row>(slope_[k]), load_as<Row>(moment_[k])};
    else
      return cubic_spline(fraction_[k]);
  }

private:
  const double* fraction_;
  alignas(64) double weight_[chunk_size][4], slope_[chunk_size][4], moment_[chunk_size][4];
};

/// Stencils of a chunk of particles that bring something to the grid, one after the other.
struct ChunkStencils
{
  ChunkPlaces place;
  RowSplines x;
  LaneSplines y;

  void find(const TileStencils& tile, const double* px, const double* py, int count)
  {
    place.find(tile, px, py, count);
    x.find(place.x_fraction, count);
    y.find(place.y_fraction, count);
  }
};

/// Brings the particles of the next chunk near, a little with every particle of this one.
struct Ahead
{
  std::array<const double*, 16> stream; ///< fields at this chunk's first particle

  /// The fields that both transfers read, and three more.
  [[gnu::always_inline]] Ahead(const Particles& p, int begin, const double* a, const double* b,
                               const double* c)
      : stream{&p.x[begin],
               &p.y[begin],
               &p.mass[begin],
               &p.volume[begin],
               &p.velocity_x[begin],
               &p.velocity_y[begin],
               &p.affine_xx[begin],
               &p.affine_xy[begin],
               &p.affine_yx[begin],
               &p.affine_yy[begin],
               &p.stress_xx[begin],
               &p.stress_xy[begin],
               &p.stress_yy[begin],
               a,
               b,
               c}
  {
  }

  /// A line, which holds particles k to k + 7, of a quarter of the fields. Called one by one, since the
  /// compiler drops loops and functions that do nothing else.
  [[gnu::always_inline]] void fetch(int k, int quarter) const
  {
    const double* const* of = &stream[4 * quarter];
    const std::size_t line = chunk_size + static_cast<unsigned>(k);
    __builtin_prefetch(of[0] + line);
    __builtin_prefetch(of[1] + line);
    __builtin_prefetch(of[2] + line);
    __builtin_prefetch(of[3] + line);
  }
};

/// Calls f(begin, count) for the chunks of a range, in the order in which they are summed.
template <class Function>
void for_each_chunk(const Range& range, const Function& f)
{
  for (int begin = range.begin; begin < range.end; begin += chunk_size)
    f(begin, std::min(chunk_size, range.end - begin));
}

/// Calls f(material, begin, count) for the chunks of a occupied block block.
template <class Function>
void for_each_chunk(const OccupiedBlock& occupied, const Function& f)
{
  for (const Range& range : occupied.ranges)
    for_each_chunk(range, [&](int begin, int count) { f(range.material, begin, count); });
}
} // namespace mpm
