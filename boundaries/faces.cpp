#include "boundaries/faces.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
std::vector<Face> find_faces(const Domain& domain, Edge edge, double position, double size)
{
  const Particles& p = domain.particles;
  const bool bottom = edge == Edge::bottom;
  std::vector<std::pair<double, Face>> found;
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    const Elastic& law = domain.materials[m].elastic();
    const double shear = law.density * law.shear_speed() * size,
                 pressure = law.density * law.pressure_speed() * size;
    for (int k = domain.material_begin[m]; k < domain.material_begin[m + 1]; ++k)
    {
      const double depth = bottom ? p.reference_y[k] - position : std::fabs(p.reference_x[k] - position);
      if (depth > 0.75 * size) continue;
      const double outward = edge == Edge::left ? -0.5 * size : 0.5 * size;
      const Face face = bottom ? Face{p.id[k], 0, -0.5 * size, shear, pressure}
                               : Face{p.id[k], outward, 0, pressure, shear};
      found.push_back({bottom ? p.reference_x[k] : p.reference_y[k], face});
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Face> faces;
  for (const auto& [along, face] : found) faces.push_back(face);
  return faces;
}

namespace
{
/// What a face's dashpots bring to a node per unit of weight: the dashpots and the force of their far ends,
/// as in FaceNode.
Row brought(const Face& face, const std::array<double, 2>& far_end)
{
  return Row{face.dashpot_x, face.dashpot_y, face.dashpot_x * far_end[0], face.dashpot_y * far_end[1]};
}

void add(Row (&nodes)[16], const Row& x_weight, const Row& y_weight, const Row& brought)
{
  for (int row = 0; row < 4; ++row)
  {
    const Row weight = y_weight[row] * x_weight;
#pragma GCC unroll 4
    for (int column = 0; column < 4; ++column) nodes[4 * row + column] += weight[column] * brought;
  }
}
} // namespace

void FaceNodes::lay_out(const Grid& grid)
{
  built_ = grid.built;
  slots_.clear();
  nodes_.clear();
  NodeFinder find(grid);
  std::vector<int> slot(grid.nodes(), -1);
  for (const Cell& cell : cells_)
  {
    find.move_to(cell.i, cell.j);
    Slots& slots = slots_.emplace_back(Slots{cell.i, cell.j, {}});
    for (int k = 0; k < 16; ++k)
    {
      const int column = cell.i + k % 4, row = cell.j + k / 4, node = find(column, row);
      if (node >= 0 && slot[node] < 0)
      {
        slot[node] = static_cast<int>(nodes_.size());
        nodes_.push_back({node, grid.wrapped ? 0 : column, row, 0, 0, 0, 0});
      }
      slots.at[k] = node < 0 ? -1 : slot[node];
    }
  }
}

void FaceNodes::find(const Domain& domain, const std::vector<Face>& faces,
                     std::span<const std::array<double, 2>> far_end)
{
  const Grid& g = domain.grid;
  cells_.clear();
  for (std::size_t k = 0; k < faces.size(); ++k)
  {
    const int at = domain.place[faces[k].particle];
    const Stencil x = cubic_stencil(domain.particles.x[at] + faces[k].offset_x - g.origin_x, g.spacing);
    const Stencil y = cubic_stencil(domain.particles.y[at] + faces[k].offset_y - g.origin_y, g.spacing);
    if (cells_.empty() || cells_.back().i != x.first || cells_.back().j != y.first)
      cells_.push_back({x.first, y.first});
    const auto end = far_end.empty() ? std::array<double, 2>{} : far_end[k];
    add(cells_.back().at, x.weight, y.weight, brought(faces[k], end));
  }
  const auto same = [](const Cell& cell, const Slots& slots)
  { return cell.i == slots.i && cell.j == slots.j; };
  if (built_ != g.built || !std::equal(cells_.begin(), cells_.end(), slots_.begin(), slots_.end(), same))
    lay_out(g);
  for (FaceNode& node : nodes_) store_row(&node.dashpot_x, Row{});
  for (std::size_t c = 0; c < cells_.size(); ++c)
    for (int k = 0; k < 16; ++k)
    {
      if (slots_[c].at[k] < 0) continue;
      double* const sum = &nodes_[slots_[c].at[k]].dashpot_x;
      store_row(sum, load_row(sum) + cells_[c].at[k]);
    }
}

void visit_faces(StateVisitor& visitor, std::string prefix, std::vector<Face>& faces)
{
  RecordVisitor<Face> list(visitor, std::move(prefix), faces);
  list.each_integer(
      "particle", [](Face & face) -> auto& { return face.particle; });
  list.member("offset_x", "m", &Face::offset_x);
  list.member("offset_y", "m", &Face::offset_y);
  list.member("dashpot_x", "N s/m2", &Face::dashpot_x);
  list.member("dashpot_y", "N s/m2", &Face::dashpot_y);
}
} // namespace mpm
