#include "solver/stages/model.hpp"

#include "boundaries/frozen_images.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/mpm/step.hpp"
#include "solver/stages/interfaces.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
/// Puts seeds, grouped by material, into a domain whose grid is set up.
void plant(Domain& domain, const std::vector<Material>& materials, std::vector<Seed> seeds)
{
  std::stable_sort(seeds.begin(), seeds.end(),
                   [](const Seed& a, const Seed& b) { return a.material < b.material; });
  std::vector<int> counts(materials.size(), 0);
  for (const Seed& seed : seeds) ++counts[seed.material];
  set_materials(domain, materials, counts);
  Particles& p = domain.particles;
  for (std::size_t k = 0; k < seeds.size(); ++k)
  {
    p.x[k] = p.reference_x[k] = seeds[k].x;
    p.y[k] = p.reference_y[k] = seeds[k].y;
    p.volume[k] = seeds[k].volume;
    p.mass[k] = seeds[k].volume * materials[seeds[k].material].elastic().density;
  }
}

/// The column of a side: the model's outermost column of particles, in a grid one cell wide.
std::unique_ptr<FreeFieldColumn> make_column(const Case& case_file, const std::vector<Material>& materials,
                                             const std::vector<Seed>& seeds, Edge edge)
{
  const double size = case_file.grid.particle_spacing();
  const double side = edge == Edge::left ? case_file.domain.left : case_file.domain.right;
  std::vector<Seed> rows;
  for (const Seed& seed : seeds)
    if (in_outer_row(std::fabs(seed.x - side), size)) rows.push_back(seed);
  if (rows.empty()) return nullptr;
  auto domain = std::make_unique<Domain>();
  domain->name = edge == Edge::left ? "left column" : "right column";
  domain->grid.spacing = case_file.grid.spacing;
  domain->grid.origin_x = edge == Edge::left ? side : side - case_file.grid.spacing;
  domain->grid.origin_y = case_file.domain.bottom;
  domain->grid.wrapped = true;
  plant(*domain, materials, rows);
  sort_particles(*domain);
  return std::make_unique<FreeFieldColumn>(std::move(domain), side);
}

int cells_across(const Case& case_file)
{
  return static_cast<int>(std::lround(case_file.domain.width() / case_file.grid.spacing));
}

Wall bottom_wall()
{
  return {Direction::y, 0, 1, false};
}
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

/// Nothing moves, and displacements count from here.
void come_to_rest(Domain& domain)
{
  Particles& p = domain.particles;
  p.reference_x = p.x;
  p.reference_y = p.y;
  for (auto* values : {&p.velocity_x, &p.velocity_y, &p.affine_xx, &p.affine_xy, &p.affine_yx, &p.affine_yy})
    std::fill(values->begin(), values->end(), 0.0);
}

/// Walls that stay, images for those that leave, and the compliant base, which is returned (null: there is
/// none).
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
} // namespace

Model make_model(const Case& case_file)
{
  Model model;
  model.filling = fill(case_file);
  std::vector<Seed> seeds = std::move(model.filling.seeds);
  std::vector<Material> materials = case_file.materials;
  if (case_file.grid.interfaces == Interfaces::averaged) average_interfaces(case_file, seeds, materials);
  model.main = std::make_unique<Domain>();
  Domain& main = *model.main;
  main.name = case_file.name;
  main.grid.spacing = case_file.grid.spacing;
  main.grid.origin_x = case_file.domain.left;
  main.grid.origin_y = case_file.domain.bottom;
  plant(main, materials, seeds);
  model.reference_volume = main.particles.volume;
  sort_particles(main);
  if (case_file.seismic.sides == SideKind::free_field)
  {
    model.left = make_column(case_file, materials, seeds, Edge::left);
    model.right = make_column(case_file, materials, seeds, Edge::right);
  }
  model.for_each_domain([&](Domain& domain, const std::string&)
                        { domain.settings.average_volume = case_file.grid.average_volume; });
  return model;
}

void add_static_boundaries(Model& model, const Case& case_file)
{
  model.for_each_domain(
      [&](Domain& domain, const std::string& column)
      {
        std::vector<Wall> walls{bottom_wall()};
        if (column.empty()) walls.insert(walls.end(), {left_wall(), right_wall(case_file)});
        add_walls(domain, walls);
        domain.settings.local_damping = case_file.static_stage.damping;
        rebuild(domain);
      });
}

void add_seismic_boundaries(Model& model, const Case& case_file, std::shared_ptr<const IncomingWave> wave,
                            bool restarting)
{
  const bool fixed = case_file.seismic.base == BaseKind::fixed,
             roller = case_file.seismic.sides == SideKind::roller;
  model.for_each_domain(
      [&](Domain& domain, const std::string& column)
      {
        std::vector<Wall> leaving, staying;
        (fixed ? staying : leaving).push_back(bottom_wall());
        if (column.empty())
        {
          auto& walls = roller ? staying : leaving;
          walls.insert(walls.end(), {left_wall(), right_wall(case_file)});
        }
        domain.settings.local_damping = 0;
        domain.settings.consistent_inertia = case_file.seismic.inertia == Inertia::consistent;
        domain.settings.gravity_y = -case_file.static_stage.gravity;
        domain.settings.plastic = true;
        // A column goes where the input takes it, with nothing on one side of it that could push it away.
        const BaseSpring spring(column.empty() ? spring_time(case_file) : 0);
        CompliantBase* const base =
            switch_boundaries(domain, case_file, leaving, staying, wave, spring, restarting);
        if (column.empty())
          model.base = base;
        else
          (column == "left" ? model.left : model.right)->compliant_base = base;
      });
  if (!roller)
    for (const Edge edge : {Edge::left, Edge::right})
    {
      const FreeFieldColumn* column = (edge == Edge::left ? model.left : model.right).get();
      auto side = std::make_unique<FreeFieldSide>(edge, column, wave);
      const double position = edge == Edge::left ? case_file.domain.left : case_file.domain.right;
      if (!restarting)
        side->begin(*model.main, position, case_file.domain.bottom, case_file.grid.particle_spacing());
      model.sides.push_back(side.get());
      model.main->boundaries.push_back(std::move(side));
    }
  if (restarting) return;
  model.for_each_domain(
      [](Domain& domain, const std::string&)
      {
        come_to_rest(domain);
        sort_particles(domain);
      });
}

std::vector<FreeFieldBase> free_field_base(const Model& model)
{
  std::vector<FreeFieldBase> result;
  for (const FreeFieldColumn* column : {model.left.get(), model.right.get()})
    if (column) result.push_back(column->base());
  return result;
}

double spring_time(const Case& case_file)
{
  return case_file.seismic.spring.value_or(case_file.longest_period());
}

double side_stress_mismatch(const Model& model, const Case& case_file, Edge edge)
{
  const FreeFieldColumn* column = (edge == Edge::left ? model.left : model.right).get();
  if (!column) return 0;
  const Particles &p = model.main->particles, &q = column->domain->particles;
  const double side = edge == Edge::left ? case_file.domain.left : case_file.domain.right;
  double difference = 0, scale = 0;
  for (int k = 0; k < p.size(); ++k)
  {
    if (!in_outer_row(std::fabs(p.reference_x[k] - side), case_file.grid.particle_spacing())) continue;
    const double wanted = q.stress_xx[column->particle_of_row(column->row_near(p.reference_y[k]))];
    difference += std::fabs(p.stress_xx[k] - wanted);
    scale += std::fabs(wanted);
  }
  return scale > 0 ? difference / scale : 0;
}

void advance(Model& model, double time, double dt)
{
  if (model.base) model.base->follow(free_field_base(model));
  const auto column = [=](FreeFieldColumn* c)
  {
    if (c) c->advance(time, dt);
  };
  model.main->measures.times.start();
  if (model.left && model.right)
    parallel::together([&] { column(model.left.get()); }, [&] { column(model.right.get()); });
  else
  {
    column(model.left.get());
    column(model.right.get());
  }
  model.main->measures.times.end(Phase::columns);
  model.main->time = time;
  step(*model.main, dt);
}

void scale_masses(Model& model)
{
  const auto& materials = model.main->materials;
  const auto& begin = model.main->material_begin;
  double slowest = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < materials.size(); ++m)
    if (begin[m + 1] > begin[m]) slowest = std::min(slowest, materials[m].elastic().pressure_speed());
  model.for_each_domain(
      [&](Domain& domain, const std::string&)
      {
        for (Material& material : domain.materials)
          material.mass_scale = std::pow(material.elastic().pressure_speed() / slowest, 2);
      });
}

double greatest_wave_speed(const Domain& domain)
{
  const Particles& p = domain.particles;
  double greatest = 0;
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    const Material& material = domain.materials[m];
    const int begin = domain.material_begin[m];
    const auto* torn = material.field("opening");
    double lightest = std::numeric_limits<double>::infinity();
    for (int k = begin; k < domain.material_begin[m + 1]; ++k)
    {
      // The volume that a torn point will have when it has closed and carries pressure again.
      const double opening = torn != nullptr ? (*torn)[k - begin] : 0;
      const double closed = opening > 0 ? p.volume[k] * std::exp(-opening) : p.volume[k];
      lightest = std::min(lightest, material.mass_scale * p.mass[k] / closed);
    }
    greatest = std::max(greatest, std::sqrt(material.elastic().p_modulus() / lightest));
  }
  return greatest;
}
} // namespace mpm
