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
