#pragma once

#include "solver/mpm/domain.hpp"

namespace mpm
{
enum class Direction
{
  x,
  y,
};

/// A straight wall on a grid line: material lies on the side `inward` (+1 or -1) of the node line `line`.
struct Wall
{
  Direction normal;
  int line;
  int inward;
  bool slip; ///< slides along the wall; otherwise it sticks

  /// Sign of a vector's x and y component in the mirror image: S of METHODS section 2.
  double image_sign_x() const { return slip && normal == Direction::y ? 1 : -1; }
  double image_sign_y() const { return slip && normal == Direction::x ? 1 : -1; }
};

/// Kinematic wall by mirrored particles (Schulz & Sutmann 2019), done as a fold of the nodes: image particles
/// are never made (METHODS section 2). Walls of one domain are folded one after the other, which makes the
/// corners.
class MirroredWall final : public Boundary
{
public:
  explicit MirroredWall(const Wall& wall) : wall_(wall) {}
  void bind(const Domain& domain) override;
  void constrain(Grid& grid) override;
  void mirror_velocities(Grid& grid) override;

private:
  void share_nodes(Grid& grid) const;
  struct Pair
  {
    int inside, ghost;
  };
  Wall wall_;
  std::vector<Pair> pairs_;
  std::vector<int> on_wall_;
  bool shared_ = false; ///< whether the grid knows which nodes are images
};
} // namespace mpm
