// What holds the model in either stage, and the switch between them.

#include "solver/mpm/flow.hpp"
#include "solver/stages/model.hpp"

#include "boundaries/frozen_images.hpp"
#include "boundaries/mirrored_wall.hpp"

#include <algorithm>

namespace mpm
{
namespace
{
int cells_across(const Case& case_file)
{
  return static_cast<int>(std::lround(case_file.domain.width() / case_file.grid.spacing));
}

/// Holds both components of motion, as rough rock does.
Wall bottom_wall()
{
  return {Direction::y, 0, 1, false};
}
/// Holds the normal component; the ground slides along it.
Wall left_wall()
{
  return {Direction::x, 0, 1, true};
}
Wall right_wall(const Case& case_file)
{
  return {Direction::x, cells_across(case_file), -1, true};
}

void add_walls(Domain& domain, std::span<const Wall> walls)
{
  for (const Wall& wall : walls) domain.boundaries.push_back(std::make_unique<MirroredWall>(wall));
}

/// Nothing moves, and displacements and flow count from here.
void come_to_rest(Domain& domain)
{
  Particles& p = domain.particles;
  p.reference_x = p.x;
  p.reference_y = p.y;
  for (auto* values : {&p.velocity_x, &p.velocity_y, &p.affine_xx, &p.affine_xy, &p.affine_yx, &p.affine_yy})
    std::fill(values->begin(), values->end(), 0.0);
  note_flow(domain);
}

/// Walls that stay, images for those that leave, and the compliant base, which is returned (null: there is
/// none).
///
/// A wall is a mirror: nodes near it feel the ground's own image beyond. When it goes, the image is frozen
/// with the stresses of that moment, so that the forces on those nodes do not change, and the switch leaves
/// no acceleration behind (test/stages/test_free_field.cpp).
CompliantBase* switch_boundaries(Domain& domain, const Case& case_file, std::span<const Wall> leaving,
                                 std::span<const Wall> staying,
                                 const std::shared_ptr<const IncomingWave>& wave, BaseSpring spring,
                                 bool restarting)
{
  Images images;
  if (!restarting) images = make_images(domain, leaving);
  domain.boundaries.clear();
  domain.boundaries.push_back(std::make_unique<FrozenImages>(std::move(images)));
  add_walls(domain, staying);
  if (case_file.seismic.base == BaseKind::fixed) return nullptr;
  std::vector<Face> faces;
  if (!restarting)
    faces = find_faces(domain, Edge::bottom, case_file.domain.bottom, case_file.grid.particle_spacing());
  auto base = std::make_unique<CompliantBase>(std::move(faces), wave, std::move(spring));
  CompliantBase* const result = base.get();
  domain.boundaries.push_back(std::move(base));
  return result;
}

/// A free-field side or, where the ground has no column, a quiet one.
void add_side(Model& model, const Case& case_file, Edge edge, const std::shared_ptr<const IncomingWave>& wave,
              bool restarting)
{
  auto side = std::make_unique<FreeFieldSide>(edge, model.column(edge), wave);
  const double position = edge == Edge::left ? case_file.domain.left : case_file.domain.right;
  if (!restarting)
    side->begin(*model.main, position, case_file.domain.bottom, case_file.grid.particle_spacing());
  model.sides.push_back(side.get());
  model.main->boundaries.push_back(std::move(side));
}
} // namespace

// T of `seismic.base.spring`: auto is no value of the case, but the ground's.
double spring_time(const Case& case_file)
{
  return case_file.seismic.spring.value_or(case_file.longest_period());
}

void add_static_boundaries(Model& model, const Case& case_file)
{
  for (const auto& [part, domain] : model.domains())
  {
    std::vector<Wall> walls{bottom_wall()};
    if (!is_column(part)) walls.insert(walls.end(), {left_wall(), right_wall(case_file)});
    add_walls(*domain, walls);
    domain->settings.local_damping = case_file.static_stage.damping;
    rebuild(*domain);
  }
}

void set_transfer(StepSettings& step, const SeismicSettings& seismic)
{
  step.flip = seismic.transfer == Transfer::flip;
  step.filter = {seismic.filter.time, seismic.filter.strain};
}

void add_seismic_boundaries(Model& model, const Case& case_file, std::shared_ptr<const IncomingWave> wave,
                            bool restarting)
{
  const bool fixed = case_file.seismic.base == BaseKind::fixed,
             roller = case_file.seismic.sides == SideKind::roller;
  for (const auto& [part, domain] : model.domains())
  {
    std::vector<Wall> leaving, staying;
    (fixed ? staying : leaving).push_back(bottom_wall());
    if (!is_column(part))
    {
      auto& walls = roller ? staying : leaving;
      walls.insert(walls.end(), {left_wall(), right_wall(case_file)});
    }
    domain->settings.local_damping = 0;
    set_transfer(domain->settings, case_file.seismic);
    domain->settings.consistent_inertia = case_file.seismic.inertia == Inertia::consistent;
    domain->settings.gravity_y = -case_file.static_stage.gravity;
    domain->settings.plastic = true; // from here on, in the columns too
    // A column goes where the input takes it, with nothing on one side of it that could push it away.
    const BaseSpring spring(is_column(part) ? 0 : spring_time(case_file));
    CompliantBase* const base =
        switch_boundaries(*domain, case_file, leaving, staying, wave, spring, restarting);
    if (part == Part::ground) model.base = base;
    if (part == Part::left_column) model.left->compliant_base = base;
    if (part == Part::right_column) model.right->compliant_base = base;
  }
  if (!roller)
    for (const Edge edge : both_sides) add_side(model, case_file, edge, wave, restarting);
  if (restarting) return; // particles, faces and images come from the checkpoint
  for (const auto& [part, domain] : model.domains())
  {
    come_to_rest(*domain);
    sort_particles(*domain);
  }
}
} // namespace mpm
