#include "boundaries/face_columns.hpp"

#include <algorithm>

namespace mpm
{
namespace
{
constexpr double light = 6; // z of a node of which half the dashpot acts on the face

/// s of a node with the mass m and the dashpot c, of a column's with the sums of c and of c m.
double share_on_face(double m, double c, double dashpots, double mass)
{
  if (!(m > 0 && dashpots > 0)) return 0;
  const double z = c / dashpots * (mass / dashpots) / m, ratio = z / light, square = ratio * ratio;
  return 1 / (1 + square * square);
}

/// s c of a node, by component.
std::array<double, 2> on_face(const Grid& g, int node, double share)
{
  return {share * g.face_dashpot_x[node], share * g.face_dashpot_y[node]};
}

/// r of a node with s c, by component.
std::array<double, 2> mobility(const Grid& g, int node, std::array<double, 2> c, double dt)
{
  const double m = g.mass[node], half = 0.5 * dt;
  return {half * c[0] / (m + half * g.dashpot_x[node]), half * c[1] / (m + half * g.dashpot_y[node])};
}
} // namespace

void FaceColumns::split(Grid& g, const FaceNodes& nodes)
{
  columns_.clear();
  shares_.clear();
  if (nodes.size() == 0) return;
  const auto [low, high] = std::minmax_element(
      nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.column < b.column; });
  first_ = low->column;
  columns_.resize(high->column - first_ + 1);
  const auto both = [&](int node) { return g.face_dashpot_x[node] + g.face_dashpot_y[node]; };
  for (const FaceNode& at : nodes)
  {
    column_of(at).dashpots += both(at.node);
    column_of(at).mass += both(at.node) * g.mass[at.node];
  }
  for (const FaceNode& at : nodes)
  {
    const Column& column = column_of(at);
    const double s = share_on_face(g.mass[at.node], both(at.node), column.dashpots, column.mass);
    shares_.push_back(s);
    g.dashpot_x[at.node] += (1 - s) * g.face_dashpot_x[at.node];
    g.dashpot_y[at.node] += (1 - s) * g.face_dashpot_y[at.node];
  }
}

void FaceColumns::apply(Grid& g, const FaceNodes& nodes, double dt)
{
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    const FaceNode& at = nodes[k];
    if (g.mass[at.node] <= g.smallest_mass) continue;
    Column& column = column_of(at);
    const std::array<double, 2> c = on_face(g, at.node, shares_[k]), r = mobility(g, at.node, c, dt),
                                v = g.middle_velocity(at.node);
    for (int i = 0; i < 2; ++i)
    {
      column.dashpot[i] += c[i];
      column.velocity[i] += c[i] * v[i];
      column.compliance[i] += c[i] * r[i];
    }
  }
  for (Column& column : columns_)
    for (int i = 0; i < 2; ++i)
      if (column.dashpot[i] > 0) column.velocity[i] /= column.dashpot[i] + column.compliance[i];
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    const FaceNode& at = nodes[k];
    if (g.mass[at.node] <= g.smallest_mass) continue;
    const auto [ux, uy] = column_of(at).velocity;
    const auto [rx, ry] = mobility(g, at.node, on_face(g, at.node, shares_[k]), dt);
    const double change_x = -2 * rx * ux, change_y = -2 * ry * uy;
    g.velocity_x[at.node] += change_x;
    g.velocity_y[at.node] += change_y;
    g.change_x[at.node] += change_x;
    g.change_y[at.node] += change_y;
  }
}

std::array<double, 2> FaceColumns::met_velocity(const Grid& g, const FaceNodes& nodes, std::size_t k) const
{
  const auto [ux, uy] = columns_[nodes[k].column - first_].velocity;
  const auto [vx, vy] = g.forced_velocity(nodes[k].node);
  const double s = shares_[k];
  return {s * ux + (1 - s) * vx, s * uy + (1 - s) * vy};
}
} // namespace mpm
