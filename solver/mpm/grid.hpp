#pragma once

#include "solver/mpm/parallel.hpp"
#include "solver/mpm/simd.hpp"

#include <Eigen/Core>

#include <array>
#include <compare>
#include <type_traits>
#include <vector>

namespace mpm
{
inline constexpr int block_cells = 8;                         ///< cells (and nodes) along a block's edge
inline constexpr int block_nodes = block_cells * block_cells; ///< nodes that a block owns
inline constexpr int tile_margin = 2; ///< nodes of a tile left of its block: 1 of the stencil, 1 of drift
inline constexpr int tile_nodes = block_cells + 2 * tile_margin + 1;
inline constexpr int tile_stride = 16;
inline constexpr int tile_size = tile_nodes * tile_stride;

inline constexpr int block_cost = 4; ///< time that a loop over a block's nodes takes, in particles

/// Place of a block, column by column: its cells are [8 x, 8 x + 8) by [8 y, 8 y + 8).
struct BlockIndex
{
  int x, y;
  bool operator==(const BlockIndex&) const = default;
  std::strong_ordering operator<=>(const BlockIndex& other) const
  {
    if (const auto order = x <=> other.x; order != 0) return order;
    return y <=> other.y;
  }
  int colour() const { return (x & 1) + 2 * (y & 1); }
};

/// The 3 x 3 blocks around a block as places in Grid::blocks, -1 where there is none; row by row from below.
using Neighbours = std::array<int, 9>;

/// One number at each node; a row of a block is as aligned as vectors are.
using NodeField = std::vector<double, Eigen::aligned_allocator<double>>;

/// Sparse background grid: only blocks that hold material, and those that their stencils reach, exist.
/// Node (i, j) stands at origin + spacing * (i, j); node fields are stored block by block, row by row.
struct Grid
{
  double spacing = 1;
  double origin_x = 0, origin_y = 0;
  bool wrapped = false; ///< one cell wide, the node index wraps in x: a free-field column (METHODS section 5)

  std::vector<BlockIndex> blocks; ///< sorted
  std::vector<Neighbours> neighbours;
  int built = 0; ///< how often: places in the node fields hold until the next time

  NodeField mass;
  NodeField momentum_x, momentum_y;
  NodeField force_x, force_y;
  NodeField dashpot_x,
      dashpot_y; ///< of dashpots at the nodes, N s/m per m; empty without absorbing boundaries
  NodeField face_dashpot_x,
      face_dashpot_y;               ///< of dashpots on the base's face, which act on its velocity; empty
                                    ///< without them and with the lumped mass
  NodeField velocity_x, velocity_y; ///< updated velocity v*
  NodeField change_x,
      change_y;          ///< v* - P/m of the lumped mass, see correct_inertia; empty without it
  NodeField linked_mass; ///< mass of nodes that take part in that, kg per m
  /// Part of a node that belongs to the ground, for sums over nodes: 0 for images beyond a mirrored wall, 1/2
  /// on it, 1/4 where two walls meet; empty without walls.
  NodeField share;
  double smallest_mass = 0; ///< nodes with less stay at rest, kg per m

  double inverse_spacing() const { return 1 / spacing; }
  /// Mean of a node's velocity before and after the equation of motion; zero where it stays at rest, m/s.
  std::array<double, 2> middle_velocity(int node) const
  {
    if (mass[node] <= smallest_mass) return {};
    return {0.5 * (momentum_x[node] / mass[node] + velocity_x[node]),
            0.5 * (momentum_y[node] / mass[node] + velocity_y[node])};
  }
  /// Mean of a node's velocity before the step and after its forces: what dashpots act on, m/s.
  std::array<double, 2> forced_velocity(int node) const
  {
    if (mass[node] <= smallest_mass) return {};
    const auto [ax, ay] = velocity_change(node);
    return {momentum_x[node] / mass[node] + 0.5 * ax, momentum_y[node] / mass[node] + 0.5 * ay};
  }
  /// What the forces on a node changed its velocity by in the step, m/s; zero where it stays at rest.
  std::array<double, 2> velocity_change(int node) const
  {
    if (mass[node] <= smallest_mass) return {};
    if (!change_x.empty()) return {change_x[node], change_y[node]};
    return {velocity_x[node] - momentum_x[node] / mass[node],
            velocity_y[node] - momentum_y[node] / mass[node]};
  }
  int nodes() const { return static_cast<int>(blocks.size()) * block_nodes; }
  /// Place of a block in `blocks`, -1 if it does not exist.
  int find(BlockIndex block) const;
  /// Place of node (i, j) in the node fields, -1 if its block does not exist.
  int node(int i, int j) const;
  Neighbours around(BlockIndex block) const;
  /// Makes the grid of exactly these blocks (sorted, unique) and sizes the node fields.
  void build(std::vector<BlockIndex> wanted, bool with_dashpots, bool with_face_dashpots);
  void clear(int block);
  /// Calls f(place in blocks) for all blocks, on all threads.
  template <class Function>
  void for_each_block(const Function& f) const
  {
    parallel::for_each(static_cast<int>(blocks.size()), block_cost, f);
  }
};

/// Block that owns cell or node i of a direction.
inline int block_of(int i)
{
  return i >> 3;
}

/// Finds the nodes of one stencil after the other, quickly when they are near each other.
class NodeFinder
{
public:
  explicit NodeFinder(const Grid& grid) : grid_(grid) {}
  /// Moves to the stencil whose first node is (i, j).
  void move_to(int i, int j)
  {
    const BlockIndex block{block_of(i), block_of(j)};
    if (known_ && block == block_) return;
    block_ = block;
    around_ = grid_.around(block);
    known_ = true;
  }
  /// Place of node (i, j) of that stencil, -1 if its block does not exist.
  int operator()(int i, int j) const
  {
    const int block = around_[3 * (block_of(j) - block_.y + 1) + block_of(i) - block_.x + 1];
    const int column = grid_.wrapped ? 0 : i & (block_cells - 1);
    return block < 0 ? -1 : block * block_nodes + (j & (block_cells - 1)) * block_cells + column;
  }

private:
  const Grid& grid_;
  BlockIndex block_{};
  Neighbours around_{};
  bool known_ = false;
};

/// A block's own dense copy of one node field, with the margin that its particles reach.
struct alignas(64) Tile
{
  std::array<double, tile_size> value;
};

/// The same of a field of vectors, (x, y) after (x, y).
struct alignas(64) PairTile
{
  std::array<double, 2 * tile_size> value;
};

/// Runs of consecutive nodes shared by a tile and the grid: f(place in the grid, place in the tile, count),
/// the count being a compile-time constant. In a wrapped grid every tile column is the one node column.
template <class Function>
void for_each_run(const Grid& grid, const Neighbours& around, const Function& f)
{
  constexpr std::integral_constant<int, 1> one{};
  constexpr std::integral_constant<int, tile_margin> before{};
  constexpr std::integral_constant<int, block_cells> inside{};
  constexpr std::integral_constant<int, tile_margin + 1> after{};
  constexpr int first_row[] = {block_cells - tile_margin, 0, 0},
                end_row[] = {block_cells, block_cells, after};
  for (int band = 0; band < 3; ++band)
  {
    // Rows that a block and the tile share, from the block's node `column` on.
    const auto rows = [&](int block, int column, auto count, int place)
    {
      if (block < 0) return;
      const int node = block * block_nodes + column;
      const int tile = (block_cells * (band - 1) + tile_margin) * tile_stride + place;
      for (int row = first_row[band]; row < end_row[band]; ++row)
        f(node + row * block_cells, tile + row * tile_stride, count);
    };
    const int* const blocks = &around[3 * band];
    if (grid.wrapped)
    {
      for (int column = 0; column < tile_nodes; ++column) rows(blocks[1], 0, one, column);
      continue;
    }
    rows(blocks[0], block_cells - tile_margin, before, 0);
    rows(blocks[1], 0, inside, tile_margin);
    rows(blocks[2], 0, after, tile_margin + block_cells);
  }
}

/// Adds a tile, or one component of a tile of vectors, to the column of nodes of a wrapped grid.
template <int components>
void add_to_column(const Neighbours& around, const double* tile, NodeField& field)
{
  for (int row = 0; row < tile_nodes; ++row)
  {
    const int y = row - tile_margin, block = around[y < 0 ? 1 : y < block_cells ? 4 : 7];
    if (block < 0) continue;
    double sum = 0;
    for (int column = 0; column < tile_nodes; ++column)
      sum += tile[components * (row * tile_stride + column)];
    field[block * block_nodes + (y & (block_cells - 1)) * block_cells] += sum;
  }
}

/// Adds a tile to the node field of the blocks around it.
inline void add_tile(const Grid& grid, const Neighbours& around, const Tile& tile, NodeField& field)
{
  if (grid.wrapped) return add_to_column<1>(around, tile.value.data(), field);
  for_each_run(grid, around,
               [&](int node, int place, auto count)
               {
                 double* __restrict to = &field[node];
                 for (int k = 0; k < count; ++k) to[k] += tile.value[place + k];
               });
}

/// Adds a tile of vectors to the node fields of their components.
inline void add_tile(const Grid& grid, const Neighbours& around, const PairTile& tile, NodeField& x,
                     NodeField& y)
{
  if (grid.wrapped)
  {
    add_to_column<2>(around, tile.value.data(), x);
    add_to_column<2>(around, tile.value.data() + 1, y);
    return;
  }
  for_each_run(grid, around,
               [&](int node, int place, auto count)
               {
                 double* __restrict to_x = &x[node], * __restrict to_y = &y[node];
                 const double* __restrict from = &tile.value[2 * place];
                 for (int k = 0; k < count; ++k)
                 {
                   to_x[k] += from[2 * k];
                   to_y[k] += from[2 * k + 1];
                 }
               });
}

/// Copies a node field into a tile; nodes of blocks that do not exist are zero.
inline void read_tile(const Grid& grid, const Neighbours& around, const NodeField& field, Tile& tile)
{
  tile.value.fill(0);
  for_each_run(grid, around,
               [&](int node, int place, auto count)
               {
                 const double* __restrict from = &field[node];
                 double* __restrict to = &tile.value[place];
                 for (int k = 0; k < count; ++k) to[k] = from[k];
               });
}

/// Copies the components of a vector field into a tile; nodes of blocks that do not exist are zero.
inline void read_tile(const Grid& grid, const Neighbours& around, const NodeField& x, const NodeField& y,
                      PairTile& tile)
{
  tile.value.fill(0);
  for_each_run(grid, around,
               [&](int node, int place, auto count)
               {
                 const double* __restrict from_x = &x[node], * __restrict from_y = &y[node];
                 double* __restrict to = &tile.value[2 * place];
                 for (int k = 0; k < count; ++k)
                 {
                   to[2 * k] = from_x[k];
                   to[2 * k + 1] = from_y[k];
                 }
               });
}
} // namespace mpm
