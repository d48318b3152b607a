#include "solver/mpm/health.hpp"

#include "solver/mpm/spline.hpp"
#include "solver/mpm/state_problem.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm
{
namespace
{
constexpr double least_volume = 0.1;  // of the undeformed one
constexpr double covered_cells = 16;  // area that the spline of a particle covers, cells
constexpr double greatest_course = 1; // cells that a particle's velocity takes it in a step

/// What the particles of a range may be.
struct Bounds
{
  double density, largest_volume, greatest_speed;

  Bounds(const Domain& domain, int material)
      : density(domain.materials[material].elastic().density),
        largest_volume(covered_cells * domain.grid.spacing * domain.grid.spacing),
        greatest_speed(greatest_course * domain.grid.spacing /
                       domain.energy.step.dt) // infinite before any step
  {
  }
};

/// Whether values are finite numbers; without branches, so that it is done in vectors.
bool finite(const double* values, int count)
{
  constexpr double greatest = std::numeric_limits<double>::max();
  std::uint64_t wrong = 0;
#pragma GCC ivdep
  for (int k = 0; k < count; ++k) wrong |= std::uint64_t(!(std::fabs(values[k]) <= greatest));
  return wrong == 0;
}

/// Volume that counts: what is torn apart has the one that it will have when it has closed.
double closed_volume(const Domain& domain, int material, int k)
{
  const double volume = domain.particles.volume[k];
  const auto* opening = domain.materials[material].field("opening");
  const double torn = opening ? (*opening)[k - domain.material_begin[material]] : 0;
  return torn > 0 ? volume * std::exp(-torn) : volume;
}

/// Calls f(name, values) for each array of numbers of the particles of a range.
template <class Function>
void for_each_field(const Domain& domain, const ParticleRange& range, const Function& f)
{
  for (const ParticleField& field : particle_fields)
    for (int c = 0; c < field.components; ++c) f(field.name, &(domain.particles.*field.data[c])[range.begin]);
  const Material& material = domain.materials[range.material];
  for (std::size_t s = 0; s < material.state.size(); ++s)
    f(material.state_fields()[s].name,
      &material.state[s][range.begin - domain.material_begin[range.material]]);
}

/// Whether particles stand where the nodes of their block reach them.
bool at_home(const Domain& domain, const OccupiedBlock& block, const ParticleRange& range)
{
  const Particles& p = domain.particles;
  bool all = true;
  for (int k = range.begin; k < range.end; ++k) all &= within_tile(domain.grid, block.block, p.x[k], p.y[k]);
  return all;
}

/// Whether all particles of a range are well, in passes that vectors do; where it says no, ill() tells why,
/// or that it is well after all.
bool surely_well(const Domain& domain, const OccupiedBlock& block, const ParticleRange& range)
{
  bool well = true;
  const int count = range.end - range.begin;
  for_each_field(domain, range, [&](std::string_view, const double* v) { well = well && finite(v, count); });
  const Particles& p = domain.particles;
  const Bounds bounds(domain, range.material);
  const double least = least_volume / bounds.density, most = bounds.largest_volume;
  const double square = bounds.greatest_speed * bounds.greatest_speed;
  std::uint64_t wrong = 0;
#pragma GCC ivdep
  for (int k = range.begin; k < range.end; ++k)
    wrong |=
        std::uint64_t(!(p.volume[k] >= least * p.mass[k])) | std::uint64_t(!(p.volume[k] <= most)) |
        std::uint64_t(!(p.velocity_x[k] * p.velocity_x[k] + p.velocity_y[k] * p.velocity_y[k] <= square));
  return well && wrong == 0 && at_home(domain, block, range);
}

/// Whether places are looked at too: not in a step that has failed, which may have thrown particles anywhere.
enum class Places
{
  looked_at,
  passed_over
};

/// What is wrong with a particle and by how much; empty where it is well.
std::string ill(const Domain& domain, const OccupiedBlock& block, int material, int k, Places places)
{
  const Particles& p = domain.particles;
  const ParticleRange one{material, k, k + 1};
  const Bounds bounds(domain, material);
  std::string text;
  for_each_field(domain, one,
                 [&](std::string_view name, const double* value)
                 {
                   if (text.empty() && !std::isfinite(*value))
                     text = fmt::format("has a {} of {}", name, *value);
                 });
  if (!text.empty()) return text;
  const double undeformed = p.mass[k] / bounds.density, closed = closed_volume(domain, material, k);
  if (!(p.volume[k] >= least_volume * undeformed))
    return fmt::format("is squeezed to {:.3g} of its volume, below a tenth", p.volume[k] / undeformed);
  if (!(closed <= bounds.largest_volume))
    return fmt::format("has swollen to {:.3g} m2, more than the {:.3g} m2 of the cells that it reaches",
                       closed, bounds.largest_volume);
  if (const double speed = std::hypot(p.velocity_x[k], p.velocity_y[k]); !(speed <= bounds.greatest_speed))
    return fmt::format("moves at {:.3g} m/s, faster than a cell a step, {:.3g} m/s", speed,
                       bounds.greatest_speed);
  if (places == Places::looked_at && !within_tile(domain.grid, block.block, p.x[k], p.y[k]))
    return "stands out of reach of the nodes of its block";
  return {};
}

/// Names a particle, with its material, place and time.
std::string particle(const Domain& domain, int material, int k)
{
  const Particles& p = domain.particles;
  return fmt::format("{}: particle {} of {} at x = {:.6g} m, y = {:.6g} m, t = {:.6g} s", domain.name,
                     p.id[k], domain.materials[material].name, p.x[k], p.y[k], domain.time);
}

/// A particle and what is said of it.
struct Finding
{
  int index = -1, material = 0;
  std::string text;
  int others = 0; ///< of which something is to be said too

  void note(const Particles& p, int k, int of_material, std::string what)
  {
    if (index >= 0) ++others;
    if (index >= 0 && p.id[index] < p.id[k]) return;
    index = k;
    material = of_material;
    text = std::move(what);
  }
  std::string told(const Domain& domain) const
  {
    return fmt::format("{} {}{}", particle(domain, material, index), text,
                       others > 0 ? fmt::format(" (and {} more)", others) : "");
  }
};

/// The first particle (by id) of which f(block, material, k) has something to say.
template <class Function>
Finding first_of(const Domain& domain, const Function& f)
{
  Finding first;
  for (const OccupiedBlock& block : domain.blocks.occupied)
    for (const ParticleRange& range : block.ranges)
      for (int k = range.begin; k < range.end; ++k)
        if (std::string text = f(block, range.material, k); !text.empty())
          first.note(domain.particles, k, range.material, std::move(text));
  return first;
}

Finding first_ill(const Domain& domain, Places places)
{
  return first_of(domain, [&](const OccupiedBlock& block, int material, int k)
                  { return ill(domain, block, material, k, places); });
}

/// How much of the limits of a step the grid's velocities take at a place.
struct Shares
{
  double move = 0, gradient = 0;
};

Shares shares_of(const Grid& grid, NodeFinder& find, double x, double y, double dt)
{
  constexpr double reach = 1e8; // cells: what lies further is no index of a node
  const double column = (x - grid.origin_x) / grid.spacing, row = (y - grid.origin_y) / grid.spacing;
  if (!(std::fabs(column) < reach && std::fabs(row) < reach)) return {};
  const Stencil sx = cubic_stencil(x - grid.origin_x, grid.spacing);
  const Stencil sy = cubic_stencil(y - grid.origin_y, grid.spacing);
  find.move_to(sx.first, sy.first);
  std::array<double, 2> v{};
  std::array<double, 4> slope{};
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
    {
      const int node = find(sx.first + i, sy.first + j);
      if (node < 0) continue;
      const double w = sx.weight[i] * sy.weight[j];
      const double dx = sx.slope[i] * sy.weight[j], dy = sx.weight[i] * sy.slope[j];
      const double vx = grid.velocity_x[node], vy = grid.velocity_y[node];
      v[0] += w * vx;
      v[1] += w * vy;
      slope[0] += dx * vx;
      slope[1] += dy * vx;
      slope[2] += dx * vy;
      slope[3] += dy * vy;
    }
  const auto greatest = [](const auto& values)
  {
    double most = 0;
    for (const double value : values) most = std::max(most, std::fabs(value));
    return most;
  };
  return {greatest(v) * dt / grid.spacing / move_limit, greatest(slope) * dt / gradient_limit};
}

/// Throws Diverged when a range of a block is not as `well` wants it and has an ill particle.
template <class Test>
void check(const Domain& domain, const Test& well)
{
  const std::vector<OccupiedBlock>& blocks = domain.blocks.occupied;
  const int count = static_cast<int>(blocks.size());
  std::vector<char> suspect(count);
  parallel::for_each(count, 1 + domain.particles.size() / (10 * std::max(1, count)),
                     [&](int b)
                     {
                       for (const ParticleRange& range : blocks[b].ranges)
                         if (!well(domain, blocks[b], range)) suspect[b] = 1;
                     });
  if (std::find(suspect.begin(), suspect.end(), 1) == suspect.end()) return;
  if (const Finding first = first_ill(domain, Places::looked_at); first.index >= 0)
    throw Diverged(first.told(domain));
}
} // namespace

void check_particles(const Domain& domain)
{
  check(domain, surely_well);
}

void check_places(const Domain& domain)
{
  check(domain, at_home);
}

std::string fastest_particle(const Domain& domain)
{
  const Particles& p = domain.particles;
  const double greatest = greatest_speed(p);
  const auto as_fast = [&](const OccupiedBlock&, int, int k)
  {
    const double speed = std::hypot(p.velocity_x[k], p.velocity_y[k]);
    return speed >= greatest ? fmt::format("at {:.3g} m/s", speed) : std::string();
  };
  const Finding first = first_of(domain, as_fast);
  return first.index >= 0 ? first.told(domain) : "none";
}

std::string failed_step(const Domain& domain, double dt)
{
  const Particles& p = domain.particles;
  if (const Finding first = first_ill(domain, Places::passed_over); first.index >= 0)
    return first.told(domain);
  std::vector<Shares> shares;
  NodeFinder find(domain.grid);
  for (int k = 0; k < p.size(); ++k) shares.push_back(shares_of(domain.grid, find, p.x[k], p.y[k], dt));
  double greatest = 0;
  for (const Shares& of : shares) greatest = std::max({greatest, of.move, of.gradient});
  if (!(greatest > 0))
    return fmt::format("{}: the velocities on the grid are no numbers at t = {:.6g} s", domain.name,
                       domain.time);
  // Particles stand where the step has moved them, so that the limit may be passed nowhere any more.
  if (greatest < 1)
    if (const Finding lost = first_ill(domain, Places::looked_at); lost.index >= 0) return lost.told(domain);
  const auto told = [&](const OccupiedBlock&, int, int k) -> std::string
  {
    const Shares& of = shares[k];
    if (of.move < std::min(1.0, greatest) && of.gradient < std::min(1.0, greatest)) return {};
    if (greatest < 1)
      return fmt::format("is where the step failed, in which one moved by {} cells or was deformed by {}",
                         move_limit, gradient_limit);
    if (of.move >= 1)
      return fmt::format("moves by {:.3g} cells in the step, {:.3g} m/s, where {} are the most",
                         of.move * move_limit, of.move * move_limit * domain.grid.spacing / dt, move_limit);
    return fmt::format("is deformed by {:.3g} in the step, where {} is the most",
                       of.gradient * gradient_limit, gradient_limit);
  };
  return first_of(domain, told).told(domain);
}
} // namespace mpm
