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

/// The traction c (2 v_up - v) does the work c v_up^2 - c (v - v_up)^2: what comes up less what goes down.
void CompliantBase::measure_work(const Domain& domain, double dt, Energies& now) const
{
  const auto [ux, uy] = wave_->velocity(domain.time + 0.5 * dt);
  double incoming = 0, radiated = 0;
  for_each_face_node(domain, faces_,
                     [&](const Face& face, int node, int, double weight)
                     {
                       const auto [vx, vy] = domain.grid.middle_velocity(node);
                       const double cx = face.dashpot_x * weight, cy = face.dashpot_y * weight;
                       incoming += cx * ux * ux + cy * uy * uy;
                       radiated += cx * (vx - ux) * (vx - ux) + cy * (vy - uy) * (vy - uy);
                     });
  now[Energy::incoming] += dt * incoming;
  now[Energy::radiated_base] += dt * radiated;
}
} // namespace mpm
