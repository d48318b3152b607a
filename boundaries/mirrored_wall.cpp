#include "boundaries/mirrored_wall.hpp"

namespace mpm
{
namespace
{
constexpr int reach = 2; // node lines beyond the wall that a cubic spline of a particle inside touches

/// Adds the mirror image of the ghost's value to the inside one, and makes the ghost its image again.
inline void fold(double& inside, double& ghost, double sign)
{
  inside += sign * ghost;
  ghost = sign * inside;
}
} // namespace

void MirroredWall::bind(const Domain& domain)
{
  pairs_.clear();
  on_wall_.clear();
  shared_ = false;
  const Grid& grid = domain.grid;
  const int columns = grid.wrapped ? 1 : block_cells; // a wrapped block has one column of nodes
  for (const BlockIndex& block : grid.blocks)
    for (int y = 0; y < block_cells; ++y)
      for (int x = 0; x < columns; ++x)
      {
        const int i = block.x * block_cells + x, j = block.y * block_cells + y;
        const int depth = ((wall_.normal == Direction::x ? i : j) - wall_.line) * wall_.inward;
        if (depth < 0 || depth > reach) continue;
        const int mirrored = wall_.line - depth * wall_.inward;
        const int node = grid.node(i, j);
        const int ghost = wall_.normal == Direction::x ? grid.node(mirrored, j) : grid.node(i, mirrored);
        if (depth == 0)
          on_wall_.push_back(node);
        else if (ghost >= 0)
          pairs_.push_back({node, ghost});
      }
}

void MirroredWall::share_nodes(Grid& grid) const
{
  if (grid.share.empty()) grid.share.assign(grid.nodes(), 1.0);
  for (const Pair& pair : pairs_) grid.share[pair.ghost] = 0;
  for (const int node : on_wall_) grid.share[node] *= 0.5;
}

void MirroredWall::mirror_velocities(Grid& g)
{
  for (const auto& [inside, ghost] : pairs_)
  {
    g.velocity_x[ghost] = wall_.image_sign_x() * g.velocity_x[inside];
    g.velocity_y[ghost] = wall_.image_sign_y() * g.velocity_y[inside];
  }
}

void MirroredWall::constrain(Grid& g)
{
  if (!shared_) share_nodes(g);
  shared_ = true;
  const double sx = wall_.image_sign_x(), sy = wall_.image_sign_y();
  for (const auto& [inside, ghost] : pairs_)
  {
    fold(g.mass[inside], g.mass[ghost], 1);
    fold(g.momentum_x[inside], g.momentum_x[ghost], sx);
    fold(g.momentum_y[inside], g.momentum_y[ghost], sy);
    fold(g.force_x[inside], g.force_x[ghost], sx);
    fold(g.force_y[inside], g.force_y[ghost], sy);
  }
  for (auto* field : {&g.dashpot_x, &g.dashpot_y, &g.face_dashpot_x, &g.face_dashpot_y})
    if (!field->empty())
    {
      for (const auto& [inside, ghost] : pairs_) fold((*field)[inside], (*field)[ghost], 1);
      for (const int node : on_wall_) (*field)[node] *= 2;
    }
  for (const int node : on_wall_) // the node is its own image: odd components vanish, even ones double
  {
    g.mass[node] *= 2;
    g.momentum_x[node] *= 1 + sx;
    g.momentum_y[node] *= 1 + sy;
    g.force_x[node] *= 1 + sx;
    g.force_y[node] *= 1 + sy;
  }
}
} // namespace mpm
