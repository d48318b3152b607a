#pragma once

#include "solver/mpm/grid.hpp"
#include "solver/mpm/simd.hpp"

namespace mpm
{
/// The rows of nodes of a block and around it, vector by vector.
struct NodeRows
{
  static constexpr int parts = block_cells / lanes; ///< vectors in a row of a block's nodes
  const Neighbours& around;

  /// Part `part` (-parts to 2 parts - 1) of row `row` (-8 to 15) of a field, counted from the block's own
  /// first; zeros where there is no block.
  Lanes of(const NodeField& field, int row, int part) const
  {
    const int y = row < 0 ? 0 : row < block_cells ? 1 : 2, x = part < 0 ? 0 : part < parts ? 1 : 2;
    const int block = around[3 * y + x];
    if (block < 0) return Lanes{};
    return load_as<Lanes>(
        &field[block * block_nodes + within_block(row) * block_cells + (part - (x - 1) * parts) * lanes]);
  }
};
} // namespace mpm
