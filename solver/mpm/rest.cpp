#include "solver/mpm/domain.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mpm
{
namespace
{
/// Calls f(home) for the homes around one, itself included.
template <class Function>
void for_each_around(Domain& domain, const Home& home, const Function& f)
{
  for (const int block : home.around)
    if (block >= 0 && domain.home_in[block] >= 0) f(domain.homes[domain.home_in[block]]);
}

void stand_still(Domain& domain, const Home& home)
{
  Particles& p = domain.particles;
  for (const Range& range : home.ranges)
    for (auto* field : {&p.velocity_x, &p.velocity_y, &p.affine_xx, &p.affine_xy, &p.affine_yx, &p.affine_yy})
      std::fill(field->begin() + range.begin, field->begin() + range.end, 0.0);
}

/// Whether a home woke.
bool wake_beside(Domain& domain, const Home& home)
{
  bool woke = false;
  for_each_around(domain, home,
                  [&](Home& other)
                  {
                    if (!other.asleep) return;
                    other.asleep = false;
                    other.greatest = std::numeric_limits<double>::infinity();
                    woke = true;
                  });
  return woke;
}

/// Whether a home fell asleep. All are judged by the second that has passed, then the next one begins.
bool fall_asleep(Domain& domain)
{
  std::vector<Home*> tired;
  for (Home& home : domain.homes)
  {
    double greatest = 0;
    for_each_around(domain, home, [&](const Home& other) { greatest = std::max(greatest, other.greatest); });
    if (!home.asleep && greatest < domain.rest.below) tired.push_back(&home);
  }
  for (Home& home : domain.homes) home.greatest = 0;
  for (Home* home : tired)
  {
    home->asleep = true;
    stand_still(domain, *home);
  }
  return !tired.empty();
}
} // namespace

void bind_rest(Domain& domain)
{
  domain.home_in.assign(domain.grid.blocks.size(), -1);
  domain.awake = {};
  domain.colours = {};
  for (int k = 0; k < static_cast<int>(domain.homes.size()); ++k)
  {
    const Home& home = domain.homes[k];
    domain.home_in[home.around[4]] = k;
    if (home.asleep) continue;
    domain.awake.add(k, home.particles());
    domain.colours[home.block.colour()].add(k, home.particles());
  }
  std::vector<int>& held = domain.rest.held;
  held.clear();
  for (const Home& home : domain.homes)
  {
    if (!home.asleep || !domain.awake_around(home.around)) continue;
    for_each_run(domain.grid, home.around,
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
  for (Home& home : domain.homes)
  {
    home.asleep = false;
    home.greatest = std::numeric_limits<double>::infinity();
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
    Home& home = domain.homes[k];
    const double speed = moves[k] * domain.grid.spacing / dt;
    home.greatest = std::max(home.greatest, speed);
    if (speed >= rest.below) changed |= wake_beside(domain, home);
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
  for (const Home& home : domain.homes)
  {
    greatest.push_back(home.greatest);
    asleep.push_back(home.asleep);
  }
  visitor.doubles("settings", "m/s, s", settings);
  visitor.doubles("greatest_speed", "m/s", greatest);
  visitor.integers("asleep", asleep);
  visitor.integers("skipped", skipped);
  if (settings.size() != 2 || skipped.size() != 1 || skipped[0] < 0 ||
      greatest.size() != domain.homes.size() || asleep.size() != domain.homes.size())
    throw std::runtime_error("rest is that of other homes");
  for (const double value : {settings[0], settings[1]})
    if (!(std::isfinite(value) && value >= 0)) throw std::runtime_error("rest/settings cannot be");
  for (const double value : greatest)
    if (!(value >= 0)) throw std::runtime_error("rest/greatest_speed cannot be");
  domain.rest.below = settings[0];
  domain.rest.watched = settings[1];
  domain.rest.skipped = skipped[0];
  for (std::size_t k = 0; k < domain.homes.size(); ++k)
  {
    domain.homes[k].greatest = greatest[k];
    domain.homes[k].asleep = asleep[k] != 0;
  }
}
} // namespace mpm
