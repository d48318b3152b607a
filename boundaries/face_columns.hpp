#pragma once

#include "boundaries/faces.hpp"

namespace mpm
{
/// Dashpots of a level face that act on its velocity instead of that of each node. With consistent inertia
/// the field of the splines moves as the ground, and node values differ from it by (kh)^2 / 6 of a wave:
/// dashpots at the nodes would err by as much, as they have to with the lumped mass, which errs alike.
///
/// Of the dashpot c_j of node j the share s_j acts on the face, the rest on the node itself, as dashpots do
/// elsewhere. At a column of nodes the face moves with u = sum s_j c_j v_j / sum s_j c_j, and node j gets the
/// force c_j (2 v_up - s_j u - (1 - s_j) v_j), v being the mean of a step's start and end as in solve_grid.
/// Its sum over the column, sum c_j (2 v_up - v_j), does not depend on the shares.
///
/// The face reaches half a particle distance further down than the particles: at the end of their reach a
/// node's mass goes to zero before its dashpot does. On the face alone such a node would follow the far end
/// at once, take u with it, u -> 2 v_up, and leave the other nodes without traction. With w_j = c_j / sum c
/// and the mean mass m = sum w_j m_j along the face,
///
///   s_j = 1 / (1 + (z_j / 6)^4),     z_j = w_j m / m_j:
///
/// z = 2.3 and s = 0.98 at the lowest node where the face stands on a line of nodes below 2 x 2 particles a
/// cell, and s ~ m_j^4 at the end of the reach. A node without mass has the dashpot's force that balances its
/// stress, on the face or not, so that the split costs little (boundaries/README.md).
///
/// The nodes of a column are coupled by a matrix of rank one, so that their equations of motion have a closed
/// form (Sherman & Morrison, Ann. Math. Stat. 21 (1950) 124). Let v0_j be the mean velocity of node j without
/// the face and r_j = (dt/2) s_j c_j / (m_j + (dt/2) d_j) its mobility, the share of u that it loses when the
/// face moves with u; d_j are dashpots at the node itself, which hold it, (1 - s_j) c_j among them. Then
///
///   v_j = v0_j - r_j u,     u = sum s_j c_j v0_j / (sum s_j c_j + sum s_j c_j r_j).
///
/// Like the centred dashpot of a node that never gives energy, whatever the shares are.
class FaceColumns
{
public:
  /// Before the equation of motion, when all masses and dashpots are there: finds the shares of `nodes` and
  /// adds what acts on the nodes themselves to Grid::dashpot_x and dashpot_y. Grid::face_dashpot_x and
  /// face_dashpot_y keep the whole c_j.
  void split(Grid& grid, const FaceNodes& nodes);
  /// Gives `nodes`, which have moved without the face, what the face's dashpots say in the step of dt s.
  void apply(Grid& grid, const FaceNodes& nodes, double dt);
  /// Velocity that the dashpot of nodes[k] met in the step, s u + (1 - s) v, m/s.
  std::array<double, 2> met_velocity(const Grid& grid, const FaceNodes& nodes, std::size_t k) const;
  /// u of the first column, m/s.
  const std::array<double, 2>& first_velocity() const { return columns_.front().velocity; }

private:
  struct Column
  {
    double dashpots = 0, mass = 0;      ///< sum c, N s/m per m, and sum c m, of both components
    std::array<double, 2> dashpot{};    ///< sum s c, N s/m per m
    std::array<double, 2> velocity{};   ///< u, m/s
    std::array<double, 2> compliance{}; ///< sum s c r: how much the nodes yield to the face, N s/m per m
  };
  Column& column_of(const FaceNode& at) { return columns_[at.column - first_]; }

  std::vector<Column> columns_;
  std::vector<double> shares_; ///< s of each node
  int first_ = 0;              ///< grid column of the first
};
} // namespace mpm
