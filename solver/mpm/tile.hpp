#pragma once
// What the particles of a block work on: dense copies of node fields, and how they are filled and added.

#include "solver/mpm/grid.hpp"

#include <array>
#include <type_traits>

namespace mpm
{
/// A dense copy of one node field for the particles of a block, with the margin that they reach.
struct alignas(64) Tile
{
  std::array<double, tile_size> value;
};

/// The same of a field of vectors, (x, y) after (x, y).
struct alignas(64) PairTile
{
  std::array<double, 2 * tile_size> value;
};

/// Calls f(node, at, count) for the runs of consecutive nodes that a tile and the grid share: `node` is the
/// first one's index in the node fields, `at` its index in the tile, the count a compile-time constant. A
/// tile reaches into all 3 x 3 blocks `around`. In a wrapped grid every tile column is the one node column.
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
    const auto rows = [&](int block, int column, auto count, int tile_column)
    {
      if (block < 0) return;
      const int node = block * block_nodes + column;
      const int tile = (block_cells * (band - 1) + tile_margin) * tile_stride + tile_column;
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

/// Adds a tile to the node field of the blocks around it.
void add_tile(const Grid& grid, const Neighbours& around, const Tile& tile, NodeField& field);

/// Adds a tile of vectors to the node fields of their components.
void add_tile(const Grid& grid, const Neighbours& around, const PairTile& tile, NodeField& x, NodeField& y);

/// Copies a node field into a tile; nodes of blocks that do not exist are zero.
void read_tile(const Grid& grid, const Neighbours& around, const NodeField& field, Tile& tile);

/// Copies the components of a vector field into a tile; nodes of blocks that do not exist are zero.
void read_tile(const Grid& grid, const Neighbours& around, const NodeField& x, const NodeField& y,
               PairTile& tile);
} // namespace mpm
