#include "boundaries/face_columns.hpp"

#include <algorithm>

namespace mpm
{
namespace
{
/// r_j of a node, by component.
std::array<double, 2> mobility(const Grid& g, int node, double dt)
{
  const double m = g.mass[node], half = 0.5 * dt;
  return {half * g.face_dashpot_x[node] / (m + half * g.dashpot_x[node]),
          half * g.face_dashpot_y[node] / (m + half * g.dashpot_y[node])};
}
} // namespace

void FaceColumns::apply(Grid& g, const FaceNodes& nodes, double dt)
{
  columns_.clear();
  if (nodes.begin() == nodes.end()) return;
  const auto [low, high] = std::minmax_element(
      nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.column < b.column; });
  first_ = low->column;
  columns_.resize(high->column - first_ + 1);
  for (const FaceNode& at : nodes)
  {
    if (g.mass[at.node] <= g.smallest_mass) continue;
    Column& column = columns_[at.column - first_];
    const std::array<double, 2> v = g.middle_velocity(at.node), r = mobility(g, at.node, dt);
    const std::array<double, 2> c{g.face_dashpot_x[at.node], g.face_dashpot_y[at.node]};
    for (int k = 0; k < 2; ++k)
    {
      column.dashpot[k] += c[k];
      column.velocity[k] += c[k] * v[k];
      column.compliance[k] += c[k] * r[k];
    }
  }
  for (Column& column : columns_)
    for (int k = 0; k < 2; ++k)
      if (column.dashpot[k] > 0) column.velocity[k] /= column.dashpot[k] + column.compliance[k];
  for (const FaceNode& at : nodes)
  {
    if (g.mass[at.node] <= g.smallest_mass) continue;
    const auto [ux, uy] = velocity(at.column);
    const auto [rx, ry] = mobility(g, at.node, dt);
    g.velocity_x[at.node] -= 2 * rx * ux;
    g.velocity_y[at.node] -= 2 * ry * uy;
  }
}
} // namespace mpm
