#include "boundaries/free_field.hpp"

#include "solver/mpm/step.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
FreeFieldColumn::FreeFieldColumn(std::unique_ptr<Domain> owned, double side)
    : domain(std::move(owned)), side_(side)
{
  const Particles& p = domain->particles;
  ids_ = p.id;
  std::vector<double> height(p.size());
  for (int k = 0; k < p.size(); ++k) height[p.id[k]] = p.reference_y[k];
  std::sort(ids_.begin(), ids_.end(), [&](auto a, auto b) { return height[a] < height[b]; });
}

void FreeFieldColumn::advance(double time, double dt)
{
  stress = stress_of_rows();
  domain->time = time;
  step(*domain, dt);
  note_motion(dt);
}

void FreeFieldColumn::note_motion(double dt)
{
  const Grid& g = domain->grid;
  first_row = g.blocks.front().y * block_cells;
  const int count = (g.blocks.back().y + 1) * block_cells - first_row;
  velocity.assign(count, {});
  acceleration.assign(count, {});
  for (int row = 0; row < count; ++row)
  {
    const int node = g.node(0, first_row + row);
    if (node < 0 || g.mass[node] <= 0) continue;
    // Of the lumped equation of motion: where inertia is consistent, the model corrects its own nodes.
    velocity[row] = g.forced_velocity(node);
    const auto [ax, ay] = g.velocity_change(node);
    acceleration[row] = {ax / dt, ay / dt};
  }
}

int FreeFieldColumn::row_near(double y) const
{
  const Particles& p = domain->particles;
  int nearest = 0;
  const auto distance = [&](int row) { return std::fabs(p.reference_y[particle_of_row(row)] - y); };
  for (int row = 1; row < rows(); ++row)
    if (distance(row) < distance(nearest)) nearest = row;
  return nearest;
}

std::vector<RowStress> FreeFieldColumn::stress_of_rows() const
{
  const Particles& p = domain->particles;
  std::vector<RowStress> result;
  for (const std::int64_t id : ids_)
  {
    const int k = domain->particles.index_of[id];
    result.push_back(
        {p.volume[k] * p.stress_xx[k], p.volume[k] * p.stress_yy[k], p.volume[k] * p.stress_xy[k]});
  }
  return result;
}

FreeFieldBase FreeFieldColumn::base() const
{
  const Particles& p = domain->particles;
  const int k = particle_of_row(0);
  return {side_, {p.x[k] - p.reference_x[k], p.y[k] - p.reference_y[k]}};
}

/// Each particle within image_cells of the side has a ghost mirrored at it, with the load of the column's row
/// that is nearest in the undeformed ground. Particles of the base's outer row have a ghost of their dashpot
/// too.
void FreeFieldSide::begin(const Domain& domain, double position, double bottom, double size)
{
  faces_ = find_faces(domain, edge_, position, size);
  if (!column_) return;
  static_stress_ = column_->stress_of_rows();
  const std::vector<Face> base = find_faces(domain, Edge::bottom, bottom, size);
  const Particles& p = domain.particles;
  for (int id = 0; id < p.size(); ++id)
  {
    const int k = domain.particles.index_of[id];
    if (std::fabs(p.x[k] - position) > image_cells * domain.grid.spacing) continue;
    Image ghost;
    ghost.parent = id;
    ghost.offset[0] = 2 * (position - p.x[k]);
    ghost.load = column_->row_near(p.reference_y[k]);
    ghosts_.list.push_back(ghost);
    for (Face face : base)
      if (face.particle == id)
      {
        face.offset_x += ghost.offset[0];
        ghost_base_.push_back(face);
      }
  }
}

void FreeFieldSide::release(const Particles& particles)
{
  const auto gone = [&](const Face& face) { return has_left(particles, face); };
  std::erase_if(faces_, gone);
  std::erase_if(ghost_base_, gone);
  ghosts_.release(particles);
}

std::array<double, 2> FreeFieldSide::column_velocity(int row) const
{
  if (!column_) return {};
  const int k = row - column_->first_row;
  return k >= 0 && k < static_cast<int>(column_->velocity.size()) ? column_->velocity[k]
                                                                  : std::array<double, 2>{};
}

std::array<double, 2> FreeFieldSide::base_velocity(int row) const
{
  if (!column_->domain->settings.consistent_inertia) return column_velocity(row);
  if (!column_->compliant_base) return {};
  return column_->compliant_base->met_velocity(column_->domain->grid, row);
}

void FreeFieldSide::add_forces(Domain& domain, double dt)
{
  Grid& g = domain.grid;
  nodes_.spread(g, domain.particles, faces_);
  for (const FaceNode& at : nodes_)
  {
    const auto [vx, vy] = column_velocity(at.row);
    g.dashpot_x[at.node] += at.dashpot_x;
    g.dashpot_y[at.node] += at.dashpot_y;
    g.force_x[at.node] += at.dashpot_x * vx;
    g.force_y[at.node] += at.dashpot_y * vy;
  }
  if (!column_) return;
  add_ghost_base(domain, dt);
  load_ghosts();
  ghosts_.add_forces(domain, {column_->acceleration, column_->first_row});
}

/// Gives the ghosts of each row the dynamic stress (eq. 6) and the mass of the column's.
void FreeFieldSide::load_ghosts()
{
  ghosts_.loads.resize(column_->rows());
  for (int row = 0; row < column_->rows(); ++row)
  {
    const RowStress &now = column_->stress[row], &at_rest = static_stress_[row];
    const double xy = now.xy - at_rest.xy;
    ghosts_.loads[row] = {.stress_x = {now.xx - at_rest.xx, xy},
                          .stress_y = {xy, now.yy - at_rest.yy},
                          .mass = column_->domain->particles.mass[column_->particle_of_row(row)]};
  }
}

/// Below the ghost rows the base goes on: its dashpots' force c (2 v_up - v_column) on nodes that hold
/// ground.
void FreeFieldSide::add_ghost_base(Domain& domain, double dt)
{
  const auto [ux, uy] = wave_->velocity(domain.time + 0.5 * dt);
  Grid& g = domain.grid;
  ghost_nodes_.spread(g, domain.particles, ghost_base_);
  for (const FaceNode& at : ghost_nodes_)
  {
    if (g.mass[at.node] <= 0) continue;
    const auto [cx, cy] = base_velocity(at.row);
    g.force_x[at.node] += at.dashpot_x * (2 * ux - cx);
    g.force_y[at.node] += at.dashpot_y * (2 * uy - cy);
  }
}

/// The dashpots' traction c (v_column - v) does the work c (v_column - v) v_column - c (v - v_column)^2: what
/// the column brings, less what the scattered wave takes away. Consistent inertia moves a node with another
/// velocity v' than the v that its dashpot met.
void FreeFieldSide::measure_work(const Domain& domain, double dt, Energies& now) const
{
  double brought = 0, radiated = 0;
  for (const FaceNode& at : nodes_)
  {
    const auto [vx, vy] = domain.grid.forced_velocity(at.node);
    const auto [wx, wy] = domain.grid.middle_velocity(at.node);
    const auto [ux, uy] = column_velocity(at.row);
    brought += at.dashpot_x * (ux - vx) * ux + at.dashpot_y * (uy - vy) * uy;
    radiated += at.dashpot_x * (ux - vx) * (ux - wx) + at.dashpot_y * (uy - vy) * (uy - wy);
  }
  now[Energy::radiated_sides] += dt * radiated;
  if (!column_) return;
  now[Energy::free_field] += dt * (brought + ghost_base_power(domain, dt)) + ghosts_.work(domain.grid, dt);
}

double FreeFieldSide::ghost_base_power(const Domain& domain, double dt) const
{
  const auto [ux, uy] = wave_->velocity(domain.time + 0.5 * dt);
  double power = 0;
  for (const FaceNode& at : ghost_nodes_)
  {
    const auto [vx, vy] = domain.grid.middle_velocity(at.node);
    const auto [cx, cy] = base_velocity(at.row);
    power += at.dashpot_x * (2 * ux - cx) * vx + at.dashpot_y * (2 * uy - cy) * vy;
  }
  return power;
}

double FreeFieldSide::separation(const Particles& p) const
{
  if (!column_) return 0;
  const Particles& q = column_->domain->particles;
  double greatest = 0;
  for (const Face& face : faces_)
  {
    const int k = p.index_of[face.particle];
    const int c = column_->particle_of_row(column_->row_near(p.reference_y[k]));
    const double ux = p.x[k] - p.reference_x[k] - (q.x[c] - q.reference_x[c]);
    const double uy = p.y[k] - p.reference_y[k] - (q.y[c] - q.reference_y[c]);
    greatest = std::max(greatest, std::hypot(ux, uy));
  }
  return greatest;
}

void FreeFieldSide::visit_state(StateVisitor& visitor)
{
  visit_faces(visitor, "face_", faces_);
  if (!column_) return;
  ghosts_.visit_list(visitor, "ghost_");
  visit_faces(visitor, "ghost_base_", ghost_base_);
  RecordVisitor<RowStress> rows(visitor, "static_stress_volume_", static_stress_);
  rows.member("xx", "N m/m", &RowStress::xx);
  rows.member("yy", "N m/m", &RowStress::yy);
  rows.member("xy", "N m/m", &RowStress::xy);
}

std::string FreeFieldSide::state_problem(const Domain& domain) const
{
  if (std::string problem = faces_problem(faces_, domain.particles, domain.grid.spacing);
      !problem.empty() || !column_)
    return problem;
  const std::size_t rows = column_->rows();
  if (static_stress_.size() != rows) return "the static stress is not that of the column's rows";
  if (std::string problem = faces_problem(ghost_base_, domain.particles, domain.grid.spacing);
      !problem.empty())
    return problem;
  return ghosts_.problem(domain.grid, domain.particles, rows);
}
} // namespace mpm
