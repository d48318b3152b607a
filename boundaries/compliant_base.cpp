#include "boundaries/compliant_base.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
void CompliantBase::release(const Particles& particles)
{
  const auto gone = [&](const Face& face) { return has_left(particles, face); };
  for (std::size_t k = faces_.size(); k-- > 0;)
    if (gone(faces_[k])) spring_.drop(k);
  std::erase_if(faces_, gone);
}

void CompliantBase::add_forces(Domain& domain, double dt)
{
  nodes_.spread(domain.grid, domain.particles, faces_, stretch_spring(domain.particles, dt));
  const auto [vx, vy] = wave_->velocity(domain.time + 0.5 * dt);
  Grid& g = domain.grid;
  auto& dashpot_x = domain.settings.consistent_inertia ? g.face_dashpot_x : g.dashpot_x;
  auto& dashpot_y = domain.settings.consistent_inertia ? g.face_dashpot_y : g.dashpot_y;
  for (const FaceNode& at : nodes_)
  {
    dashpot_x[at.node] += at.dashpot_x;
    dashpot_y[at.node] += at.dashpot_y;
    g.force_x[at.node] += 2 * vx * at.dashpot_x + at.drive_x;
    g.force_y[at.node] += 2 * vy * at.dashpot_y + at.drive_y;
  }
  input_[0][0] += 2 * vx * dt;
  input_[0][1] += 2 * vy * dt;
}

void CompliantBase::constrain(Grid& grid)
{
  if (!grid.face_dashpot_x.empty()) columns_.split(grid, nodes_);
}

void CompliantBase::apply_dashpots(Grid& grid, double dt)
{
  columns_.apply(grid, nodes_, dt);
}

std::array<double, 2> CompliantBase::met_velocity(const Grid& grid, int row) const
{
  if (nodes_.size() == 0) return {};
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (nodes_[k].row == row) return columns_.met_velocity(grid, nodes_, k);
  return columns_.first_velocity();
}

std::vector<std::array<double, 2>> CompliantBase::stretch_spring(const Particles& particles, double dt)
{
  if (!spring_.acts()) return {};
  std::vector<std::array<double, 2>> behind; // what a face lacks to the free field
  behind.reserve(faces_.size());
  for (const Face& face : faces_)
  {
    const auto [x, y] = distance(particles, free_field_, face);
    behind.push_back({-x, -y});
  }
  return spring_.follow(behind, dt);
}

std::array<double, 2> CompliantBase::distance(const Particles& p,
                                              const std::vector<FreeFieldBase>& free_field,
                                              const Face& face) const
{
  const int k = p.index_of[face.particle];
  const auto [ux, uy] = free_field_displacement(free_field, p.reference_x[k], input_[0]);
  return {p.x[k] - p.reference_x[k] - ux, p.y[k] - p.reference_y[k] - uy};
}

BaseDrift CompliantBase::drift(const Particles& particles, const std::vector<FreeFieldBase>& free_field) const
{
  BaseDrift result;
  if (faces_.empty()) return result;
  const auto along = [&](const Face& face)
  { return particles.reference_x[particles.index_of[face.particle]]; };
  const double middle = 0.5 * (along(faces_.front()) + along(faces_.back()));
  result.half_length = along(faces_.back()) - middle;
  double moment = 0, inertia = 0; // about the middle; the faces are evenly spaced
  for (const Face& face : faces_)
  {
    const auto [ux, uy] = distance(particles, free_field, face);
    const double arm = along(face) - middle;
    moment += arm * uy;
    inertia += arm * arm;
    result.greatest = std::max(result.greatest, std::hypot(ux, uy));
  }
  result.rotation = inertia > 0 ? moment / inertia : 0;
  result.corner = {distance(particles, free_field, faces_.front()),
                   distance(particles, free_field, faces_.back())};
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

std::string CompliantBase::state_problem(const Domain& domain) const
{
  if (input_.size() != 1) return "the input's displacement is not one";
  if (!spring_.fits(faces_.size())) return "the spring is not that of as many faces";
  return faces_problem(faces_, domain.particles, domain.grid.spacing);
}

/// The traction c (2 v_up - u) does the work c v_up^2 - c (u - v_up)^2 on a face that moves with u: what
/// comes up less what goes down. The nodes may move with another velocity v than the u that a dashpot met.
/// The spring is the part of the static reaction that learns.
void CompliantBase::measure_work(const Domain& domain, double dt, Energies& now) const
{
  const Grid& g = domain.grid;
  const auto [upx, upy] = wave_->velocity(domain.time + 0.5 * dt);
  double incoming = 0, radiated = 0, spring = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
  {
    const FaceNode& at = nodes_[k];
    const auto [vx, vy] = g.middle_velocity(at.node);
    const auto [ux, uy] =
        domain.settings.consistent_inertia ? columns_.met_velocity(g, nodes_, k) : std::array{vx, vy};
    spring += at.drive_x * vx + at.drive_y * vy;
    incoming += at.dashpot_x * upx * upx + at.dashpot_y * upy * upy;
    radiated +=
        at.dashpot_x * (upx * upx - (2 * upx - ux) * vx) + at.dashpot_y * (upy * upy - (2 * upy - uy) * vy);
  }
  now[Energy::incoming] += dt * incoming;
  now[Energy::radiated_base] += dt * radiated;
  now[Energy::reaction] += dt * spring;
}
} // namespace mpm
