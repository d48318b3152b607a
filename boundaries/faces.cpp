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
      if (!in_outer_row(depth, size)) continue;
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
/// Adds a vector (x, y) to the 16 nodes around a point, row by row, (x, y) after (x, y).
void add(double* nodes, const Pairs& x_weight, const Row& y_weight, const double* vector)
{
  const Pairs part = x_weight * everywhere(vector);
#pragma GCC unroll 4
  for (int row = 0; row < 4; ++row)
    store(nodes + 8 * row, load_as<Pairs>(nodes + 8 * row) + y_weight[row] * part);
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

void FaceNodes::spread(const Grid& g, const Particles& p, const std::vector<Face>& faces,
                       std::span<const std::array<double, 2>> far_end)
{
  cells_.clear();
  for (std::size_t k = 0; k < faces.size(); ++k)
  {
    const int at = p.index_of[faces[k].particle];
    const Stencil x = cubic_stencil(p.x[at] + faces[k].offset_x - g.origin_x, g.spacing);
    const Stencil y = cubic_stencil(p.y[at] + faces[k].offset_y - g.origin_y, g.spacing);
    if (cells_.empty() || cells_.back().i != x.first || cells_.back().j != y.first)
      cells_.push_back(Cell{x.first, y.first});
    Cell& cell = cells_.back();
    const Pairs x_weight = twice(x.weight);
    add(cell.dashpot, x_weight, y.weight, &faces[k].dashpot_x);
    if (far_end.empty()) continue;
    const double drive[] = {faces[k].dashpot_x * far_end[k][0], faces[k].dashpot_y * far_end[k][1]};
    add(cell.drive, x_weight, y.weight, drive);
  }
  const auto same = [](const Cell& cell, const Slots& slots)
  { return cell.i == slots.i && cell.j == slots.j; };
  if (built_ != g.built || !std::equal(cells_.begin(), cells_.end(), slots_.begin(), slots_.end(), same))
    lay_out(g);
  for (FaceNode& node : nodes_) node.dashpot_x = node.dashpot_y = node.drive_x = node.drive_y = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c)
    for (int k = 0; k < 16; ++k)
    {
      if (slots_[c].at[k] < 0) continue;
      FaceNode& node = nodes_[slots_[c].at[k]];
      node.dashpot_x += cells_[c].dashpot[2 * k];
      node.dashpot_y += cells_[c].dashpot[2 * k + 1];
      node.drive_x += cells_[c].drive[2 * k];
      node.drive_y += cells_[c].drive[2 * k + 1];
    }
}

std::string faces_problem(const std::vector<Face>& faces, const Particles& particles, double spacing)
{
  const double far = 100 * spacing; // faces stand beside their particles, ghosts' within a few cells
  for (const Face& face : faces)
  {
    if (face.particle < 0 || face.particle >= std::ssize(particles.index_of) || has_left(particles, face))
      return "a face belongs to particle " + std::to_string(face.particle) + ", which is not there";
    if (!(std::fabs(face.offset_x) < far && std::fabs(face.offset_y) < far)) return "a face stands far off";
    if (!(face.dashpot_x >= 0 && face.dashpot_y >= 0)) return "a dashpot is negative";
  }
  return {};
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
