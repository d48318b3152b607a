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

  /// Signs of a vector's x and y component in the mirror image, S: the normal component turns round; so does
  /// the tangential one where the wall sticks.
  double image_sign_x() const { return slip && normal == Direction::y ? 1 : -1; }
  double image_sign_y() const { return slip && normal == Direction::x ? 1 : -1; }
};

/// Kinematic wall by mirrored particles (Schulz & Sutmann, Proc. PARTICLES 2019, 522-533), without making
/// them. The image of a particle has its weight at the mirror node, N_i(x*) = N_i*(x), so that all images
/// together are a fold of the nodes:
///
///   m_i += m_i*,   P_i += S P_i*,   f_i += S f_i*,
///
/// and the same with i and i* exchanged. A node on the wall is its own mirror node: what turns round vanishes
/// there, the rest doubles. Walls of one domain are folded one after the other, which makes the corners.
class MirroredWall final : public Boundary
{
public:
  explicit MirroredWall(const Wall& wall) : wall_(wall) {}
  void bind(const Domain& domain) override;
  void constrain(Grid& grid) override;
  void mirror_velocities(Grid& grid) override;

private:
  void share_nodes(Grid& grid) const;
  /// Indices of a node and its mirror node beyond the wall.
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
