#include "solver/mpm/domain.hpp"
#include "solver/mpm/tile.hpp"

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
    if (block >= 0 && domain.blocks.occupied_in[block] >= 0)
      f(domain.blocks.occupied[domain.blocks.occupied_in[block]]);
}

void stand_still(Domain& domain, const OccupiedBlock& occupied)
{
  Particles& p = domain.particles;
  for (const ParticleRange& range : occupied.ranges)
    for (auto* field : {&p.velocity_x, &p.velocity_y, &p.affine_xx, &p.affine_xy, &p.affine_yx, &p.affine_yy})
      std::fill(field->begin() + range.begin, field->begin() + range.end, 0.0);
}

/// Wakes the blocks around one; whether any slept.
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

/// Lets fall asleep what has been slow, with all around it, in the window that has passed; then the next one
/// begins. Whether any did.
bool fall_asleep(Domain& domain)
{
  std::vector<OccupiedBlock*> tired;
  for (OccupiedBlock& occupied : domain.blocks.occupied)
  {
    double greatest = 0;
    for_each_around(domain, occupied,
                    [&](const OccupiedBlock& other) { greatest = std::max(greatest, other.greatest); });
    if (!occupied.asleep && greatest < domain.rest.below) tired.push_back(&occupied);
  }
  for (OccupiedBlock& occupied : domain.blocks.occupied) occupied.greatest = 0;
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
  domain.blocks.occupied_in.assign(domain.grid.blocks.size(), -1);
  domain.blocks.awake = {};
  domain.blocks.colours = {};
  for (int k = 0; k < static_cast<int>(domain.blocks.occupied.size()); ++k)
  {
    const OccupiedBlock& occupied = domain.blocks.occupied[k];
    domain.blocks.occupied_in[occupied.around[4]] = k;
    if (occupied.asleep) continue;
    domain.blocks.awake.add(k, occupied.particles());
    domain.blocks.colours[occupied.block.colour()].add(k, occupied.particles());
  }
  std::vector<int>& held = domain.rest.held;
  held.clear();
  for (const OccupiedBlock& occupied : domain.blocks.occupied)
  {
    if (!occupied.asleep || !domain.blocks.awake_around(occupied.around)) continue;
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
  for (OccupiedBlock& occupied : domain.blocks.occupied)
  {
    occupied.asleep = false;
    occupied.greatest = std::numeric_limits<double>::infinity();
  }
  bind_rest(domain);
}

void hold_nodes(Grid& g, std::span<const int> nodes)
{
  for (const int node : nodes)
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
  rest.skipped += domain.particles.size() - domain.blocks.awake.shares.cost();
  bool changed = false;
  for (const int k : domain.blocks.awake.items)
  {
    OccupiedBlock& occupied = domain.blocks.occupied[k];
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
  for (const OccupiedBlock& occupied : domain.blocks.occupied)
  {
    greatest.push_back(occupied.greatest);
    asleep.push_back(occupied.asleep);
  }
  visitor.doubles("settings", "m/s, s", settings);
  visitor.doubles("greatest_speed", "m/s", greatest);
  visitor.integers("asleep", asleep);
  visitor.integers("skipped", skipped);
  if (settings.size() != 2 || skipped.size() != 1 || skipped[0] < 0 ||
      greatest.size() != domain.blocks.occupied.size() || asleep.size() != domain.blocks.occupied.size())
    throw std::runtime_error("rest is that of other blocks");
  for (const double value : {settings[0], settings[1]})
    if (!(std::isfinite(value) && value >= 0)) throw std::runtime_error("rest/settings cannot be");
  for (const double value : greatest)
    if (!(value >= 0)) throw std::runtime_error("rest/greatest_speed cannot be");
  domain.rest.below = settings[0];
  domain.rest.watched = settings[1];
  domain.rest.skipped = skipped[0];
  for (std::size_t k = 0; k < domain.blocks.occupied.size(); ++k)
  {
    domain.blocks.occupied[k].greatest = greatest[k];
    domain.blocks.occupied[k].asleep = asleep[k] != 0;
  }
}
} // namespace mpm
