#include "solver/stages/model.hpp"

#include "solver/mpm/health.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/mpm/step.hpp"
#include "solver/stages/interfaces.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

namespace mpm
{
namespace
{
/// Puts seeds, grouped by material, into a domain whose grid is set up. The order within a material is that
/// of the seeds, and with it the ids.
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
  domain->name = std::string(side_name(edge)) + " column";
  domain->grid.spacing = case_file.grid.spacing;
  domain->grid.origin_x = edge == Edge::left ? side : side - case_file.grid.spacing;
  domain->grid.origin_y = case_file.domain.bottom;
  domain->grid.wrapped = true; // the column goes on sideways for ever
  plant(*domain, materials, rows);
  sort_particles(*domain);
  return std::make_unique<FreeFieldColumn>(std::move(domain), side);
}

} // namespace

std::vector<Model::Member> Model::domains() const
{
  std::vector<Member> all{{Part::ground, main.get()}};
  if (left) all.push_back({Part::left_column, left->domain.get()});
  if (right) all.push_back({Part::right_column, right->domain.get()});
  return all;
}

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
  for (const auto& [part, domain] : model.domains())
  {
    domain->settings.average_volume = case_file.grid.average_volume;
    domain->settings.average_flow = case_file.grid.average_flow;
  }
  return model;
}

std::vector<FreeFieldBase> free_field_base(const Model& model)
{
  std::vector<FreeFieldBase> result;
  for (const Edge side : both_sides)
    if (const FreeFieldColumn* column = model.column(side)) result.push_back(column->base());
  return result;
}

// sum |sigma_xx - sigma_xx,column| / sum |sigma_xx,column| over the outermost column of particles.
double side_stress_mismatch(const Model& model, const Case& case_file, Edge side)
{
  const FreeFieldColumn* column = model.column(side);
  if (!column) return 0;
  const Particles &p = model.main->particles, &q = column->domain->particles;
  const double position = side == Edge::left ? case_file.domain.left : case_file.domain.right;
  double difference = 0, scale = 0;
  for (int k = 0; k < p.size(); ++k)
  {
    if (!in_outer_row(std::fabs(p.reference_x[k] - position), case_file.grid.particle_spacing())) continue;
    const double wanted = q.stress_xx[column->particle_of_row(column->row_near(p.reference_y[k]))];
    difference += std::fabs(p.stress_xx[k] - wanted);
    scale += std::fabs(wanted);
  }
  return scale > 0 ? difference / scale : 0;
}

void check_health(const Model& model)
{
  for (const auto& [part, domain] : model.domains()) check_particles(*domain);
}

// The base's spring pulls towards where the free field stands at the start of the step, and the sides need
// the columns' stress of the start and their motion over the step: both before the ground takes its own step.
void advance(Model& model, double time, double dt)
{
  if (model.base) model.base->follow(free_field_base(model));
  // No exception may leave a thread: that of the left column is told first.
  std::exception_ptr left, right;
  const auto column = [=](FreeFieldColumn* c, std::exception_ptr& failure)
  {
    try
    {
      if (c) c->advance(time, dt);
    }
    catch (...)
    {
      failure = std::current_exception();
    }
  };
  model.main->measures.times.start();
  const auto advance_left = [&] { column(model.left.get(), left); };
  const auto advance_right = [&] { column(model.right.get(), right); };
  if (model.left && model.right)
    parallel::together(advance_left, advance_right);
  else
  {
    advance_left();
    advance_right();
  }
  for (const std::exception_ptr& failure : {left, right})
    if (failure) std::rethrow_exception(failure);
  model.main->measures.times.end(Phase::columns);
  model.main->time = time;
  step(*model.main, dt);
}
} // namespace mpm
