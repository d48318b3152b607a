#pragma once
// Particles by the chunk. A block's particles are worked on in chunks of 64 of one material: first all that
// they need of the splines, in lanes of particles or rows of nodes, then the sums. The compiler makes vectors
// of both; particle by particle it could not, since each one's nodes are somewhere else.

#include "solver/mpm/domain.hpp"
#include "solver/mpm/spline.hpp"
#include "solver/mpm/step.hpp"
#include "solver/mpm/tile.hpp"

#include <algorithm>

namespace mpm
{
/// Turns positions (m) of a block's particles into stencils that count nodes from the block's first.
class TileStencils
{
public:
  TileStencils(const Grid& grid, BlockIndex block)
      : spacing_(grid.spacing), from_x_(grid.origin_x + grid.spacing * block_cells * block.x),
        from_y_(grid.origin_y + grid.spacing * block_cells * block.y)
  {
  }
  Stencil x(double position) const { return within_tile(cubic_stencil(position - from_x_, spacing_)); }
  Stencil y(double position) const { return within_tile(cubic_stencil(position - from_y_, spacing_)); }
  /// Index in the tile of the first of a stencil's nodes.
  static int first_node(const Stencil& x, const Stencil& y) { return tile_index(x.first, y.first); }

  double spacing() const { return spacing_; } ///< m
  double from_x() const { return from_x_; }   ///< of the block's first node, m
  double from_y() const { return from_y_; }

private:
  /// A place that is no number, or out of reach, must not lead out of the tile; the end of the step finds it.
  static Stencil within_tile(Stencil s)
  {
    s.first = std::clamp(s.first, -tile_margin, tile_nodes - tile_margin - 4);
    return s;
  }
  double spacing_, from_x_, from_y_;
};

/// Greatest index in a tile that the first node of a stencil may have.
inline constexpr unsigned last_first_node =
    tile_index(tile_nodes - tile_margin - 4, tile_nodes - tile_margin - 4);

/// Splines come with the factors of Spline; what is left of them to divide by in a product of both directions
/// is taken out once a particle: weight times weight; slope times weight, which still lacks 1/h; moment times
/// weight, which still lacks h.
inline constexpr double inverse_weights = 1 / (spline_weight * spline_weight),
                        inverse_slopes = 1 / (spline_slope * spline_weight);

/// The cells in which a chunk of particles stands.
struct ChunkCells
{
  alignas(64) double x_fraction[chunk_size], y_fraction[chunk_size]; ///< position in the cell, 0 to 1
  alignas(64) int node[chunk_size]; ///< index in the tile of the first node of the stencil

  /// Fills in `count` particles of a tile at x, y (m), and repeats the last one until the lanes are full.
  void fill(const TileStencils& tile, const double* __restrict x, const double* __restrict y, int count);
};

/// Splines of a chunk's particles along one direction, node by node of the stencil: a lane for each particle.
struct LaneSplines
{
  alignas(64) double weight[4][chunk_size], slope[4][chunk_size], moment[4][chunk_size];

  /// Fills in `count` particles by their fraction of the cell, and as many as fill the lanes.
  void fill(const double* __restrict fraction, int count);
};

/// The same, particle by particle: a row of nodes for each.
class RowSplines
{
public:
  /// Fills in `count` particles, two at a time where a register holds both rows; otherwise they are found one
  /// by one when they are asked for.
  void fill(const double* fraction, int count);
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

/// What a chunk of particles needs to bring something to the grid, one particle after the other.
struct ChunkStencils
{
  ChunkCells cells;
  RowSplines x;
  LaneSplines y;

  void fill(const TileStencils& tile, const double* px, const double* py, int count)
  {
    cells.fill(tile, px, py, count);
    x.fill(cells.x_fraction, count);
    y.fill(cells.y_fraction, count);
  }
};

/// Fetches the particles of the next chunk into the cache, a little with every particle of this one: more
/// arrays are read side by side than the processor follows on its own.
struct Prefetch
{
  std::array<const double*, 16> stream; ///< fields at this chunk's first particle

  /// The fields that both transfers read, and three more.
  [[gnu::always_inline]] Prefetch(const Particles& p, int begin, const double* a, const double* b,
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

  /// A cache line, which holds particles k to k + 7, of a quarter of the fields. Called one by one, since the
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

/// Calls f(particle) for the particles of a block.
template <class Function>
void for_each_particle(const OccupiedBlock& block, const Function& f)
{
  for (const ParticleRange& range : block.ranges)
    for (int p = range.begin; p < range.end; ++p) f(p);
}

/// Calls f(begin, count) for the chunks of a range, in the order in which they are summed.
template <class Function>
void for_each_chunk(const ParticleRange& range, const Function& f)
{
  for (int begin = range.begin; begin < range.end; begin += chunk_size)
    f(begin, std::min(chunk_size, range.end - begin));
}

/// Calls f(material, begin, count) for the chunks of a block.
template <class Function>
void for_each_chunk(const OccupiedBlock& block, const Function& f)
{
  for (const ParticleRange& range : block.ranges)
    for_each_chunk(range, [&](int begin, int count) { f(range.material, begin, count); });
}
} // namespace mpm
