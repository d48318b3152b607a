#include "solver/mpm/domain.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mpm
{
namespace
{
/// Calls f(occupied block) for the occupied blocks around one, itself included.
template <class Function>
void for_each_around(Domain& domain, const OccupiedBlock& occupied, const Function& f)
{
  for (const int block : occupied.around)
    if (block >= 0 && domain.occupied_in[block] >= 0) f(domain.occupied_blocks[domain.occupied_in[block]]);
}

void stand_still(Domain& domain, const OccupiedBlock& occupied)
{
  Particles& p = domain.particles;
  for (const Range& range : occupied.ranges)
    for (auto* field : {&p.velocity_x, &p.velocity_y, &p.affine_xx, &p.affine_xy, &p.affine_yx, &p.affine_yy})
      std::fill(field->begin() + range.begin, field->begin() + range.end, 0.0);
}

/// Whether a occupied block woke.
bool wake_beside(Domain& domain, const OccupiedBlock& occupied)
{
  bool woke = false;
  for_each_around(domain, occupied,
                  [&](OccupiedBlock& other)
                  {
                    if (!other.asleep) return;
                    other.asleep = false;
                    other.greatest = std::numeric_limits<double>::infinity();
                    woke = true;
                  });
  return woke;
}

/// Whether a occupied block fell asleep. All are judged by the second that has passed, then the next one
/// begins.
bool fall_asleep(Domain& domain)
{
  std::vector<OccupiedBlock*> tired;
  for (OccupiedBlock& occupied : domain.occupied_blocks)
  {
    double greatest = 0;
    for_each_around(domain, occupied,
                    [&](const OccupiedBlock& other) { greatest = std::max(greatest, other.greatest); });
    if (!occupied.asleep && greatest < domain.rest.below) tired.push_back(&occupied);
  }
  for (OccupiedBlock& occupied : domain.occupied_blocks) occupied.greatest = 0;
  for (OccupiedBlock* occupied : tired)
  {
    occupied->asleep = true;
    stand_still(domain, *occupied);
  }
  return !tired.empty();
}
} // namespace

void bind_rest(Domain& domain)
{
  domain.occupied_in.assign(domain.grid.blocks.size(), -1);
  domain.awake = {};
  domain.colours = {};
  for (int k = 0; k < static_cast<int>(domain.occupied_blocks.size()); ++k)
  {
    const OccupiedBlock& occupied = domain.occupied_blocks[k];
    domain.occupied_in[occupied.around[4]] = k;
    if (occupied.asleep) continue;
    domain.awake.add(k, occupied.particles());
    domain.colours[occupied.block.colour()].add(k, occupied.particles());
  }
  std::vector<int>& held = domain.rest.held;
  held.clear();
  for (const OccupiedBlock& occupied : domain.occupied_blocks)
  {
    if (!occupied.asleep || !domain.awake_around(occupied.around)) continue;
    for_each_run(domain.grid, occupied.around,
                 [&](int node, int, int count)
                 {
                   for (int k = 0; k < count; ++k) held.push_back(node + k);
                 });
  }
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
}

void allow_rest(Domain& domain, double below)
{
  Rest& rest = domain.rest;
  if (rest.below == below) return;
  rest.below = below;
  rest.watched = 0;
  for (OccupiedBlock& occupied : domain.occupied_blocks)
  {
    occupied.asleep = false;
    occupied.greatest = std::numeric_limits<double>::infinity();
  }
  bind_rest(domain);
}

void hold_resting_nodes(Domain& domain)
{
  Grid& g = domain.grid;
  for (const int node : domain.rest.held)
  {
    g.momentum_x[node] = g.momentum_y[node] = 0;
    g.force_x[node] = g.force_y[node] = 0;
    g.velocity_x[node] = g.velocity_y[node] = 0;
  }
}

void watch_rest(Domain& domain, std::span<const double> moves, double dt)
{
  Rest& rest = domain.rest;
  if (rest.below <= 0) return;
  rest.skipped += domain.particles.size() - domain.awake.shares.cost();
  bool changed = false;
  for (const int k : domain.awake.items)
  {
    OccupiedBlock& occupied = domain.occupied_blocks[k];
    const double speed = moves[k] * domain.grid.spacing / dt;
    occupied.greatest = std::max(occupied.greatest, speed);
    if (speed >= rest.below) changed |= wake_beside(domain, occupied);
  }
  rest.watched += dt;
  if (rest.watched >= Rest::window)
  {
    rest.watched = 0;
    changed |= fall_asleep(domain);
  }
  if (changed) bind_rest(domain);
}

void visit_rest(StateVisitor& visitor, Domain& domain)
{
  std::vector<double> settings{domain.rest.below, domain.rest.watched}, greatest;
  std::vector<std::int64_t> asleep, skipped{domain.rest.skipped};
  for (const OccupiedBlock& occupied : domain.occupied_blocks)
  {
    greatest.push_back(occupied.greatest);
    asleep.push_back(occupied.asleep);
  }
  visitor.doubles("settings", "m/s, s", settings);
  visitor.doubles("greatest_speed", "m/s", greatest);
  visitor.integers("asleep", asleep);
  visitor.integers("skipped", skipped);
  if (settings.size() != 2 || skipped.size() != 1 || skipped[0] < 0 ||
      greatest.size() != domain.occupied_blocks.size() || asleep.size() != domain.occupied_blocks.size())
    throw std::runtime_error("rest is that of other occupied_blocks");
  for (const double value : {settings[0], settings[1]})
    if (!(std::isfinite(value) && value >= 0)) throw std::runtime_error("rest/settings cannot be");
  for (const double value : greatest)
    if (!(value >= 0)) throw std::runtime_error("rest/greatest_speed cannot be");
  domain.rest.below = settings[0];
  domain.rest.watched = settings[1];
  domain.rest.skipped = skipped[0];
  for (std::size_t k = 0; k < domain.occupied_blocks.size(); ++k)
  {
    domain.occupied_blocks[k].greatest = greatest[k];
    domain.occupied_blocks[k].asleep = asleep[k] != 0;
  }
}
} // namespace mpm
