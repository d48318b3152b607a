#include "solver/mpm/grid.hpp"

#include <algorithm>

namespace mpm
{
int Grid::find(BlockIndex block) const
{
  if (wrapped) block.x = 0;
  const auto found = std::lower_bound(blocks.begin(), blocks.end(), block);
  return found != blocks.end() && *found == block ? static_cast<int>(found - blocks.begin()) : -1;
}

int Grid::node(int i, int j) const
{
  const int block = find({block_of(i), block_of(j)});
  return block < 0 ? -1 : block * block_nodes + index_in_block(wrapped ? 0 : i, j);
}

Neighbours Grid::around(BlockIndex block) const
{
  Neighbours result;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) result[3 * y + x] = find({block.x + x - 1, block.y + y - 1});
  return result;
}

void Grid::build(std::vector<BlockIndex> wanted, bool with_dashpots, bool with_face_dashpots)
{
  ++built;
  blocks = std::move(wanted);
  neighbours.clear();
  for (const BlockIndex& block : blocks) neighbours.push_back(around(block));
  const std::size_t count = nodes();
  for (auto* field : {&mass, &momentum_x, &momentum_y, &force_x, &force_y, &velocity_x, &velocity_y})
    field->assign(count, 0.0);
  for (auto* field : {&dashpot_x, &dashpot_y}) field->assign(with_dashpots ? count : 0, 0.0);
  for (auto* field : {&face_dashpot_x, &face_dashpot_y}) field->assign(with_face_dashpots ? count : 0, 0.0);
  share.clear();
  for (auto* field : {&change_x, &change_y, &linked_mass, &gained_x, &gained_y}) field->clear();
}

void Grid::clear(int block)
{
  const std::size_t from = static_cast<std::size_t>(block) * block_nodes;
  for (auto* field : {&mass, &momentum_x, &momentum_y, &force_x, &force_y, &dashpot_x, &dashpot_y,
                      &face_dashpot_x, &face_dashpot_y})
    if (!field->empty()) std::fill_n(field->begin() + from, block_nodes, 0.0);
}
} // namespace mpm
