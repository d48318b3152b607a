#include "solver/mpm/state_problem.hpp"

#include <cmath>
#include <cstdlib>

namespace mpm
{
namespace
{
constexpr int farthest_block = 1 << 24; // nodes are counted in int
constexpr double rounding_of_mass = 1e-6;

std::string particle(std::int64_t k)
{
  return "particle " + std::to_string(k) + " ";
}

bool finite(const std::vector<double>& values)
{
  double sum = 0; // stays finite only if all of them are
  for (const double value : values) sum += value * 0;
  return sum == 0;
}

/// Finds Particles::index_of; there are as many ids as the case makes particles, `total`.
std::string index_particles(Domain& domain, std::size_t total)
{
  const Particles& p = domain.particles;
  domain.particles.index_of.assign(total, -1);
  for (std::size_t k = 0; k < p.id.size(); ++k)
  {
    const std::int64_t id = p.id[k];
    if (id < 0 || id >= std::int64_t(total)) return "there is no particle with the id " + std::to_string(id);
    if (domain.particles.index_of[id] >= 0) return particle(id) + "is there twice";
    domain.particles.index_of[id] = static_cast<int>(k);
  }
  return {};
}

/// A gauge has position and velocity, or has left with its ground and has neither.
std::string gauges_problem(const Domain& domain)
{
  for (const Gauge& t : domain.gauges)
  {
    const bool here = std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.velocity_x) &&
                      std::isfinite(t.velocity_y);
    const bool gone =
        std::isnan(t.x) && std::isnan(t.y) && std::isnan(t.velocity_x) && std::isnan(t.velocity_y);
    if (!(here || gone) || !std::isfinite(t.reference_x) || !std::isfinite(t.reference_y))
      return "a gauge has no position";
    const Kink& k = t.kink;
    for (const double value : {k.normal_x, k.normal_y, k.normal, k.lateral, k.shear, k.stretch, k.slip})
      if (!std::isfinite(value)) return "a gauge's kink is not finite";
  }
  return {};
}

/// Particles have left once, and are not there any more.
std::string departed_problem(const Domain& domain)
{
  if (domain.departed.size() + domain.particles.id.size() != domain.particles.index_of.size())
    return "those that are there and those that have left are not all particles";
  std::vector<bool> left(domain.particles.index_of.size(), false);
  for (const Departed& one : domain.departed)
  {
    if (one.particle < 0 || std::size_t(one.particle) >= left.size() ||
        domain.particles.index_of[one.particle] >= 0 || left[one.particle])
      return particle(one.particle) + "cannot have left";
    left[one.particle] = true;
    if (one.material < 0 || std::size_t(one.material) >= domain.materials.size())
      return "a particle that has left is of no material";
    if (one.edge < Edge::bottom || one.edge > Edge::right) return "a particle has left by no edge";
  }
  return {};
}

std::string fields_problem(const Domain& domain, const std::vector<double>& masses)
{
  const Particles& p = domain.particles;
  for (const ParticleField& field : particle_fields)
    for (int c = 0; c < field.components; ++c)
      if (!finite(p.*field.data[c])) return std::string(field.name) + " is not finite everywhere";
  for (int k = 0; k < p.size(); ++k)
  {
    const double wanted = masses[p.id[k]];
    if (!(std::fabs(p.mass[k] - wanted) <= rounding_of_mass * wanted))
      return particle(p.id[k]) + "has a mass of " + std::to_string(p.mass[k]) +
             " kg/m where the case gives it " + std::to_string(wanted);
    if (!(p.volume[k] > 0)) return particle(p.id[k]) + "has no volume";
  }
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    const Material& material = domain.materials[m];
    const std::size_t count = domain.material_begin[m + 1] - domain.material_begin[m];
    for (std::size_t f = 0; f < material.state.size(); ++f)
    {
      const std::string name = material.name + "/" + std::string(material.state_fields()[f].name);
      if (material.state[f].size() != count)
        return name + " has " + std::to_string(material.state[f].size()) + " values for " +
               std::to_string(count) + " particles";
      if (!finite(material.state[f])) return name + " is not finite everywhere";
    }
    if (const auto* strain = material.field("plastic_strain"))
      for (const double value : *strain)
        if (value < 0) return material.name + "/plastic_strain is negative somewhere";
  }
  return {};
}

/// The occupied blocks hold each particle once, in ranges of its material, and each near its block.
std::string blocks_problem(const Domain& domain)
{
  const Particles& p = domain.particles;
  std::vector<bool> held(p.size(), false);
  for (std::size_t h = 0; h < domain.blocks.occupied.size(); ++h)
  {
    const OccupiedBlock& occupied = domain.blocks.occupied[h];
    if (std::abs(occupied.block.x) > farthest_block || std::abs(occupied.block.y) > farthest_block ||
        (domain.grid.wrapped && occupied.block.x != 0))
      return "an occupied block is far off";
    if (h > 0 && !(domain.blocks.occupied[h - 1].block < occupied.block))
      return "the occupied blocks are not in order";
    for (const ParticleRange& range : occupied.ranges)
    {
      if (range.material < 0 || range.material >= static_cast<int>(domain.materials.size()) ||
          range.begin < domain.material_begin[range.material] ||
          range.end > domain.material_begin[range.material + 1] || range.begin >= range.end)
        return "an occupied block holds particles that its material does not have";
      for (int k = range.begin; k < range.end; ++k)
      {
        if (held[k]) return particle(p.id[k]) + "is in two ranges of the occupied blocks";
        held[k] = true;
        if (!within_tile(domain.grid, occupied.block, p.x[k], p.y[k]))
          return particle(p.id[k]) + "does not stand in its block";
      }
    }
  }
  for (int k = 0; k < p.size(); ++k)
    if (!held[k]) return particle(p.id[k]) + "is in no occupied block";
  if (!(domain.blocks.drift >= 0 && domain.blocks.drift <= drift_cells))
    return "drift is " + std::to_string(domain.blocks.drift);
  return {};
}
} // namespace

bool within_tile(const Grid& grid, BlockIndex block, double x, double y)
{
  const auto inside = [&](double at, double origin, int first)
  {
    const double cells = (at - origin) / grid.spacing - block_cells * double(first);
    return cells >= -drift_cells && cells <= block_cells + drift_cells;
  };
  return inside(x, grid.origin_x, block.x) && inside(y, grid.origin_y, block.y);
}

std::string state_problem(Domain& domain, const std::vector<double>& masses)
{
  if (std::string problem = index_particles(domain, masses.size()); !problem.empty()) return problem;
  if (std::string problem = departed_problem(domain); !problem.empty()) return problem;
  if (std::string problem = gauges_problem(domain); !problem.empty()) return problem;
  if (std::string problem = fields_problem(domain, masses); !problem.empty()) return problem;
  if (std::string problem = blocks_problem(domain); !problem.empty()) return problem;
  for (const auto& boundary : domain.boundaries)
    if (std::string problem = boundary->state_problem(domain); !problem.empty())
      return "boundary/" + std::string(boundary->name()) + ": " + problem;
  return {};
}
} // namespace mpm
