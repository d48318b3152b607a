#pragma once
// The background grid. It is cut into square blocks of 8 x 8 nodes, of which only those that particles reach
// exist: memory and time follow the ground, not its bounding box. Particles of a block work on a tile, their
// own dense copy of the block with the margin that their stencils touch, which is then added to the blocks
// around. Two blocks of one colour (of four, like the squares of a 2 x 2 pattern) are a block apart, so that
// their tiles share no node: the blocks of a colour may be added at the same time, and every node still gets
// its contributions in one order. That is why results do not depend on the number of threads.

#include "solver/mpm/parallel.hpp"

#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <new>
#include <vector>

namespace mpm
{
inline constexpr int block_cells = 8;                         ///< cells (and nodes) along a block's edge
inline constexpr int block_nodes = block_cells * block_cells; ///< nodes that a block owns

/// Cells by which a particle may stand beside the block that it was sorted into.
inline constexpr int drift_cells = 1;
/// Nodes of a tile to the left of its block, and below it: a particle in cell i touches the nodes i - 1 to
/// i + 2, and may have drifted by a cell. To the right it takes one more.
inline constexpr int tile_margin = 1 + drift_cells;
inline constexpr int tile_nodes = block_cells + 2 * tile_margin + 1; ///< along a tile's edge
inline constexpr int tile_stride = 16; ///< from a row of a tile to the next: whole vectors
inline constexpr int tile_size = tile_nodes * tile_stride;

inline constexpr int block_cost = 4; ///< time that a loop over a block's nodes takes, in particles

/// Block that owns cell or node i of a direction: i / 8, rounded down.
inline int block_of(int i)
{
  static_assert(std::has_single_bit(unsigned(block_cells)));
  return i >> std::countr_zero(unsigned(block_cells));
}
/// Which of its block's rows or columns cell or node i is.
inline int within_block(int i)
{
  return i & (block_cells - 1);
}
/// Index of a node in its block, by column and row of the grid or of the block.
inline int index_in_block(int i, int j)
{
  return within_block(j) * block_cells + within_block(i);
}
/// Index in a tile of the node in column i and row j of the tile's block, which may be outside the block.
constexpr int tile_index(int i, int j)
{
  return (j + tile_margin) * tile_stride + i + tile_margin;
}

/// Column and row of a block among the blocks: its cells are [8 x, 8 x + 8) by [8 y, 8 y + 8). In the order
/// of columns.
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

/// Indices in Grid::blocks of the 3 x 3 blocks around a block, row by row from below; -1 where there is none.
using Neighbours = std::array<int, 9>;

/// Memory that begins at a cache line, and so where a vector of any instructions may.
template <class T>
struct CacheLineAllocator
{
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  CacheLineAllocator() = default;
  template <class Other>
  CacheLineAllocator(const CacheLineAllocator<Other>&)
  {
  }
  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), alignment)); }
  void deallocate(T* memory, std::size_t) { ::operator delete(memory, alignment); }
  bool operator==(const CacheLineAllocator&) const = default;
};

/// One number at each node; a row of a block is as aligned as vectors are.
using NodeField = std::vector<double, CacheLineAllocator<double>>;

/// Sparse background grid. Node (i, j) stands at origin + spacing * (i, j). Node fields are stored block by
/// block in the order of `blocks`, row by row in a block; all values are per m out of plane.
struct Grid
{
  double spacing = 1;                ///< h, m
  double origin_x = 0, origin_y = 0; ///< m
  /// One cell wide: every column of nodes is the same one, so that nothing varies in x. With all of a
  /// stencil's columns on one node, sum N = 1 and sum dN/dx = 0: the domain is a column of ground in one
  /// dimension.
  bool wrapped = false;

  std::vector<BlockIndex> blocks; ///< sorted: those that hold particles, and the eight around each
  std::vector<Neighbours> neighbours;
  int built = 0; ///< how often `blocks` was made; indices of nodes hold until the next time

  NodeField mass;                   ///< m_i, kg
  NodeField momentum_x, momentum_y; ///< P_i = sum w m (v + C (x_i - x)), N s
  NodeField force_x, force_y;       ///< internal, weight and boundaries', N
  /// Coefficients c of dashpots at the nodes, N s/m: their force is -c v; what their far ends add is in the
  /// forces. Empty without absorbing boundaries.
  NodeField dashpot_x, dashpot_y;
  /// Of dashpots on the base's face, which act on the face's velocity but for a share that is in dashpot_x
  /// and dashpot_y too (FaceColumns), N s/m. Empty without them and with the lumped mass.
  NodeField face_dashpot_x, face_dashpot_y;
  NodeField velocity_x, velocity_y; ///< v* at the end of the step, m/s
  NodeField change_x, change_y;     ///< v* - P/m of the lumped mass, m/s; empty but for correct_inertia
  NodeField linked_mass;            ///< mass of nodes that take part in correct_inertia, kg
  NodeField gained_x, gained_y;     ///< v* - P/m, which FLIP's particles take, m/s; empty without it
  /// Part of a node that belongs to the ground, for sums over nodes: 0 for images beyond a mirrored wall, 1/2
  /// on it, 1/4 where two walls meet; empty without walls.
  NodeField share;
  /// Nodes with this mass or less stay at rest, kg: what reaches them from the ends of stencils is rounding.
  double smallest_mass = 0;

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
  /// Index of a block in `blocks`, -1 if it does not exist.
  int find(BlockIndex block) const;
  /// Index of node (i, j) in the node fields, -1 if its block does not exist.
  int node(int i, int j) const;
  Neighbours around(BlockIndex block) const;
  /// Makes the grid of exactly these blocks (sorted, unique) and sizes the node fields.
  void build(std::vector<BlockIndex> wanted, bool with_dashpots, bool with_face_dashpots);
  /// Sets what particles and boundaries add to a block to zero.
  void clear(int block);
  /// Calls f(index in blocks) for all blocks, on all threads.
  template <class Function>
  void for_each_block(const Function& f) const
  {
    parallel::for_each(static_cast<int>(blocks.size()), block_cost, f);
  }
};

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
  /// Index of node (i, j) of that stencil in the node fields, -1 if its block does not exist.
  int operator()(int i, int j) const
  {
    const int block = around_[3 * (block_of(j) - block_.y + 1) + block_of(i) - block_.x + 1];
    return block < 0 ? -1 : block * block_nodes + index_in_block(grid_.wrapped ? 0 : i, j);
  }

private:
  const Grid& grid_;
  BlockIndex block_{};
  Neighbours around_{};
  bool known_ = false;
};
} // namespace mpm
