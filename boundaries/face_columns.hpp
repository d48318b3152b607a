#pragma once

#include "boundaries/faces.hpp"

namespace mpm
{
/// Dashpots of a level face that act on its velocity instead of that of each node. At a column of nodes the
/// face moves with u = sum_j w_j v_j over the nodes j that it touches, w_j = c_j / sum c_j, and node j gets
/// the force c_j (2 v_up - u), v being the mean of a step's start and end as in solve_grid.
///
/// With consistent inertia the field of the splines moves as the ground, and node values differ from it by
/// (kh)^2 / 6 of a wave: dashpots at the nodes would err by as much, as they have to with the lumped mass,
/// which errs alike.
///
/// The nodes of a column are coupled by a matrix of rank one, so that their equations of motion have a closed
/// form (Sherman & Morrison, Ann. Math. Stat. 21 (1950) 124). Let v0_j be the mean velocity of node j without
/// these dashpots and r_j = (dt/2) c_j / (m_j + (dt/2) d_j) its mobility, the share of u that it loses when
/// the face moves with u; d_j are dashpots at the node itself, which hold it. Then
///
///   v_j = v0_j - r_j u,     u = sum c_j v0_j / (sum c_j + sum c_j r_j).
///
/// Like the centred dashpot of a node that never gives energy.
class FaceColumns
{
public:
  /// Gives `nodes`, which have moved without these dashpots, what the face's say in the step of dt s; their
  /// coefficients are Grid::face_dashpot_x and face_dashpot_y.
  void apply(Grid& grid, const FaceNodes& nodes, double dt);
  /// Velocity of the face at a column of nodes, mean of the step's start and end, m/s.
  const std::array<double, 2>& velocity(int column) const { return columns_[column - first_].velocity; }

private:
  struct Column
  {
    std::array<double, 2> dashpot{};    ///< sum c, N s/m per m
    std::array<double, 2> velocity{};   ///< u, m/s
    std::array<double, 2> compliance{}; ///< sum c_j r_j: how much the nodes yield to the face, N s/m per m
  };
  std::vector<Column> columns_;
  int first_ = 0; ///< grid column of the first
};
} // namespace mpm
