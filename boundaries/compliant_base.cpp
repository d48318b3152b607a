#include "boundaries/compliant_base.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
void CompliantBase::add_forces(Domain& domain, double dt)
{
  stretch_spring(domain, dt);
  const auto [vx, vy] = wave_->velocity(domain.time + 0.5 * dt);
  Grid& g = domain.grid;
  for_each_face_node(domain, faces_,
                     [&](const Face& face, int node, int, double weight)
                     {
                       const auto [sx, sy] = spring_.far_end_velocity(&face - faces_.data());
                       const double cx = face.dashpot_x * weight, cy = face.dashpot_y * weight;
                       g.dashpot_x[node] += cx;
                       g.dashpot_y[node] += cy;
                       g.force_x[node] += cx * (2 * vx + sx);
                       g.force_y[node] += cy * (2 * vy + sy);
                     });
  input_[0][0] += 2 * vx * dt;
  input_[0][1] += 2 * vy * dt;
}

void CompliantBase::stretch_spring(const Domain& domain, double dt)
{
  std::vector<std::array<double, 2>> behind; // what a face lacks to the free field
  for (const Face& face : faces_)
  {
    const auto [x, y] = distance(domain, free_field_, face);
    behind.push_back({-x, -y});
  }
  spring_.follow(behind, dt);
}

std::array<double, 2> CompliantBase::distance(const Domain& domain,
                                              const std::vector<FreeFieldBase>& free_field,
                                              const Face& face) const
{
  const Particles& p = domain.particles;
  const int k = domain.place[face.particle];
  const auto [ux, uy] = free_field_displacement(free_field, p.reference_x[k], input_[0]);
  return {p.x[k] - p.reference_x[k] - ux, p.y[k] - p.reference_y[k] - uy};
}

BaseDrift CompliantBase::drift(const Domain& domain, const std::vector<FreeFieldBase>& free_field) const
{
  BaseDrift result;
  if (faces_.empty()) return result;
  const auto along = [&](const Face& face)
  { return domain.particles.reference_x[domain.place[face.particle]]; };
  const double middle = 0.5 * (along(faces_.front()) + along(faces_.back()));
  result.half_length = along(faces_.back()) - middle;
  double moment = 0, inertia = 0; // about the middle; the faces are evenly spaced
  for (const Face& face : faces_)
  {
    const auto [ux, uy] = distance(domain, free_field, face);
    const double arm = along(face) - middle;
    moment += arm * uy;
    inertia += arm * arm;
    result.greatest = std::max(result.greatest, std::hypot(ux, uy));
  }
  result.rotation = inertia > 0 ? moment / inertia : 0;
  result.corner = {distance(domain, free_field, faces_.front()), distance(domain, free_field, faces_.back())};
  return result;
}

void CompliantBase::visit_state(StateVisitor& visitor)
{
  visit_faces(visitor, "face_", faces_);
  spring_.visit_state(visitor);
  RecordVisitor<std::array<double, 2>> input(visitor, "input_displacement_", input_);
  input.each("x", "m", [](auto& u) -> double& { return u[0]; });
  input.each("y", "m", [](auto& u) -> double& { return u[1]; });
}

/// Of the dashpots the traction c (2 v_up - v) does the work c v_up^2 - c (v - v_up)^2: what comes up less
/// what goes down. The spring is the part of the static reaction that learns.
void CompliantBase::measure_work(const Domain& domain, double dt, Energies& now) const
{
  const auto [ux, uy] = wave_->velocity(domain.time + 0.5 * dt);
  double incoming = 0, radiated = 0, spring = 0;
  for_each_face_node(domain, faces_,
                     [&](const Face& face, int node, int, double weight)
                     {
                       const auto [vx, vy] = domain.grid.middle_velocity(node);
                       const double cx = face.dashpot_x * weight, cy = face.dashpot_y * weight;
                       const auto [sx, sy] = spring_.far_end_velocity(&face - faces_.data());
                       spring += cx * sx * vx + cy * sy * vy;
                       incoming += cx * ux * ux + cy * uy * uy;
                       radiated += cx * (vx - ux) * (vx - ux) + cy * (vy - uy) * (vy - uy);
                     });
  now[Energy::incoming] += dt * incoming;
  now[Energy::radiated_base] += dt * radiated;
  now[Energy::reaction] += dt * spring;
}
} // namespace mpm
