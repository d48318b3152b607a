#include "boundaries/compliant_base.hpp"

namespace mpm
{
void CompliantBase::add_forces(Domain& domain, double dt)
{
  const auto [vx, vy] = wave_->velocity(domain.time + 0.5 * dt);
  Grid& g = domain.grid;
  for_each_face_node(domain, faces_,
                     [&](const Face& face, int node, int, double weight)
                     {
                       const double cx = face.dashpot_x * weight, cy = face.dashpot_y * weight;
                       g.dashpot_x[node] += cx;
                       g.dashpot_y[node] += cy;
                       g.force_x[node] += 2 * cx * vx;
                       g.force_y[node] += 2 * cy * vy;
                     });
}
} // namespace mpm
