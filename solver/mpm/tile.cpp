#include "solver/mpm/tile.hpp"

#include "solver/mpm/node_rows.hpp"

namespace mpm
{
namespace
{
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
    field[block * block_nodes + index_in_block(0, y)] += sum;
  }
}
} // namespace

void add_tile(const Grid& grid, const Neighbours& around, const Tile& tile, NodeField& field)
{
  if (grid.wrapped) return add_to_column<1>(around, tile.value.data(), field);
  for_each_run(grid, around,
               [&](int node, int at, auto count)
               {
                 double* __restrict to = &field[node];
                 for (int k = 0; k < count; ++k) to[k] += tile.value[at + k];
               });
}

void add_tile(const Grid& grid, const Neighbours& around, const PairTile& tile, NodeField& x, NodeField& y)
{
  if (grid.wrapped)
  {
    add_to_column<2>(around, tile.value.data(), x);
    add_to_column<2>(around, tile.value.data() + 1, y);
    return;
  }
  for_each_run(grid, around,
               [&](int node, int at, auto count)
               {
                 double* __restrict to_x = &x[node], * __restrict to_y = &y[node];
                 const double* __restrict from = &tile.value[2 * at];
                 for (int k = 0; k < count; ++k)
                 {
                   to_x[k] += from[2 * k];
                   to_y[k] += from[2 * k + 1];
                 }
               });
}

void read_tile(const Grid& grid, const Neighbours& around, const NodeField& field, Tile& tile)
{
  constexpr int parts = NodeRows::parts;
  static_assert(tile_margin == 2 && tile_stride == 2 * block_cells);
  const NodeRows rows{around};
  for (int k = 0; k < tile_nodes; ++k)
  {
    const int row = k - tile_margin;
    double* const to = &tile.value[k * tile_stride];
    if (grid.wrapped)
    {
      for (int part = 0; part < 2 * parts; ++part)
        store(to + part * lanes, rows.of(field, row, 0)[0] - Lanes{});
      continue;
    }
    Lanes before = rows.of(field, row, -1); // its last two nodes are the row's first
    for (int part = 0; part < 2 * parts; ++part)
    {
      const Lanes next = rows.of(field, row, part);
      store(to + part * lanes, two_before(before, next));
      before = next;
    }
  }
}

void read_tile(const Grid& grid, const Neighbours& around, const NodeField& x, const NodeField& y,
               PairTile& tile)
{
  tile.value.fill(0);
  for_each_run(grid, around,
               [&](int node, int at, auto count)
               {
                 const double* __restrict from_x = &x[node], * __restrict from_y = &y[node];
                 double* __restrict to = &tile.value[2 * at];
                 for (int k = 0; k < count; ++k)
                 {
                   to[2 * k] = from_x[k];
                   to[2 * k + 1] = from_y[k];
                 }
               });
}
} // namespace mpm
