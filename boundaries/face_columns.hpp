#pragma once

#include "boundaries/faces.hpp"

namespace mpm
{
/// Dashpots of a level face that act on its velocity instead of that of each node. At node column i the face
/// moves with u_i = sum_j w_j v_j over the nodes j of the column that it touches, w_j = c_j / sum c_j, and
/// node j gets the force c_j (2 v_up - u_i), v being the mean of a step's start and end as in solve_grid.
///
/// With consistent inertia the field of the splines moves as the ground, and node values differ from it by
/// (kh)^2 / 6 of a wave: dashpots at the nodes would err by as much, as they have to with the lumped mass,
/// which errs alike. A column's nodes are coupled by a matrix of rank one, so that the equation of motion
/// with them has a closed form (Sherman & Morrison 1950); like the centred dashpot of a node it never gives
/// energy.
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
    std::array<double, 2> dashpot{};  ///< sum c, N s/m per m
    std::array<double, 2> velocity{}; ///< u, m/s
    std::array<double, 2> way{};      ///< sum c_j r_j, r_j being what u = 1 m/s takes from the mean of node j
  };
  std::vector<Column> columns_;
  int first_ = 0; ///< grid column of the first
};
} // namespace mpm
