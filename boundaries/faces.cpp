#include "boundaries/faces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

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

/// Sums at the 16 nodes of one cell's stencil, kept while one face after the other stands in that cell.
struct FaceNodes::CellSums
{
  int i, j; ///< first node
  Row dashpot_x[4]{}, dashpot_y[4]{}, drive_x[4]{}, drive_y[4]{};

  void add(const Stencil& x, const Stencil& y, const Face& face, const std::array<double, 2>& far_end)
  {
    for (int row = 0; row < 4; ++row)
    {
      const Row weight = y.weight[row] * x.weight;
      dashpot_x[row] += face.dashpot_x * weight;
      dashpot_y[row] += face.dashpot_y * weight;
      drive_x[row] += (face.dashpot_x * far_end[0]) * weight;
      drive_y[row] += (face.dashpot_y * far_end[1]) * weight;
    }
  }
};

void FaceNodes::add(const Grid& grid, const NodeFinder& find, const CellSums& sums)
{
  slot_.resize(grid.nodes(), -1);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
    {
      const int node = find(sums.i + column, sums.j + row);
      if (node < 0) continue;
      if (slot_[node] < 0)
      {
        slot_[node] = static_cast<int>(nodes_.size());
        nodes_.push_back({node, grid.wrapped ? 0 : sums.i + column, sums.j + row, 0, 0, 0, 0});
      }
      FaceNode& at = nodes_[slot_[node]];
      at.dashpot_x += sums.dashpot_x[row][column];
      at.dashpot_y += sums.dashpot_y[row][column];
      at.drive_x += sums.drive_x[row][column];
      at.drive_y += sums.drive_y[row][column];
    }
}

void FaceNodes::find(const Domain& domain, const std::vector<Face>& faces,
                     std::span<const std::array<double, 2>> far_end)
{
  const Grid& g = domain.grid;
  NodeFinder find(g);
  nodes_.clear();
  std::optional<CellSums> sums;
  const auto flush = [&]
  {
    if (!sums) return;
    find.move_to(sums->i, sums->j);
    add(g, find, *sums);
  };
  for (std::size_t k = 0; k < faces.size(); ++k)
  {
    const int at = domain.place[faces[k].particle];
    const Stencil x = cubic_stencil(domain.particles.x[at] + faces[k].offset_x - g.origin_x, g.spacing);
    const Stencil y = cubic_stencil(domain.particles.y[at] + faces[k].offset_y - g.origin_y, g.spacing);
    if (!sums || sums->i != x.first || sums->j != y.first)
    {
      flush();
      sums = CellSums{x.first, y.first};
    }
    sums->add(x, y, faces[k], far_end.empty() ? std::array<double, 2>{} : far_end[k]);
  }
  flush();
  for (const FaceNode& at : nodes_) slot_[at.node] = -1;
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
