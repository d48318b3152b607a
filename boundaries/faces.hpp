#pragma once

#include "solver/mpm/domain.hpp"
#include "solver/mpm/spline.hpp"

namespace mpm
{
/// The piece of an outer face that belongs to a particle of the outer row: it moves with the particle, half a
/// particle distance outside it (METHODS section 2, point of application), and carries a viscous dashpot.
struct Face
{
  std::int64_t particle;       ///< id
  double offset_x, offset_y;   ///< from the particle to the face, m
  double dashpot_x, dashpot_y; ///< impedance times area, N s/m per m
};

/// Which outer face of a model.
enum class Edge
{
  bottom,
  left,
  right,
};

/// Faces of the outer row of particles at `edge`, whose line is at `position` (m); `size` is the particle
/// distance h/n. Impedances rho c are those of each particle's own material (eqs. 4, 5).
std::vector<Face> find_faces(const Domain& domain, Edge edge, double position, double size);

/// Calls f(node, j, weight) for the 16 grid nodes around each face; j is the node's grid row.
template <class Function>
void for_each_face_node(const Domain& domain, const std::vector<Face>& faces, const Function& f)
{
  const Grid& g = domain.grid;
  NodeFinder find(g);
  for (const Face& face : faces)
  {
    const int k = domain.place[face.particle];
    const Stencil sx = cubic_stencil(domain.particles.x[k] + face.offset_x - g.origin_x, g.spacing);
    const Stencil sy = cubic_stencil(domain.particles.y[k] + face.offset_y - g.origin_y, g.spacing);
    find.move_to(sx.first, sy.first);
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        if (const int node = find(sx.first + i, sy.first + j); node >= 0)
          f(face, node, sy.first + j, sx.weight[i] * sy.weight[j]);
  }
}

/// Saves or loads faces, under names that begin with `prefix`.
void visit_faces(StateVisitor& visitor, std::string prefix, std::vector<Face>& faces);
} // namespace mpm
