#include "solver/mpm/parallel.hpp"
#include "solver/mpm/step.hpp"

#include <cmath>

namespace mpm
{
namespace
{
struct Parameters
{
  double dt, smallest_mass, damping;
};

/// Newton's law with local damping (eq. 1) and the centred dashpot (METHODS section 4): never unstable.
inline double accelerate(const Parameters& a, double m, double momentum, double f, double c)
{
  const double v = momentum / m;
  const double damped = f - a.damping * std::fabs(f) * ((v > 0) - (v < 0));
  const double half = 0.5 * a.dt * c;
  return ((m - half) * v + a.dt * damped) / (m + half);
}

template <bool dashpots>
void solve_block(Grid& g, int block, const Parameters& a)
{
  for (int k = block * block_nodes; k < (block + 1) * block_nodes; ++k)
  {
    const double m = g.mass[k];
    const bool active = m > a.smallest_mass;
    const double safe = active ? m : 1;
    const double vx = accelerate(a, safe, g.momentum_x[k], g.force_x[k], dashpots ? g.dashpot_x[k] : 0);
    const double vy = accelerate(a, safe, g.momentum_y[k], g.force_y[k], dashpots ? g.dashpot_y[k] : 0);
    g.velocity_x[k] = active ? vx : 0;
    g.velocity_y[k] = active ? vy : 0;
  }
}

Balance balance_of(const Domain& domain, int block, double gate)
{
  const Grid& g = domain.grid;
  Balance b;
  for (int k = block * block_nodes; k < (block + 1) * block_nodes; ++k)
  {
    if (g.mass[k] < gate) continue;
    const double wx = g.mass[k] * domain.gravity_x, wy = g.mass[k] * domain.gravity_y;
    b.unbalanced += std::hypot(g.force_x[k], g.force_y[k]);
    b.total += std::hypot(g.force_x[k] - wx, g.force_y[k] - wy) + std::hypot(wx, wy);
  }
  return b;
}
} // namespace

void solve_grid(Domain& domain, double dt)
{
  for (const auto& boundary : domain.boundaries) boundary->constrain(domain);
  Grid& grid = domain.grid;
  const int blocks = static_cast<int>(grid.blocks.size());
  double density = 0;
  for (const Material& material : domain.materials) density = std::max(density, material.elastic().density);
  const double cell_mass = density * grid.spacing * grid.spacing;
  const Parameters a{dt, 1e-14 * cell_mass, domain.damping};
  parallel::for_each(blocks,
                     [&](int k)
                     {
                       if (grid.dashpot_x.empty())
                         solve_block<false>(grid, k, a);
                       else
                         solve_block<true>(grid, k, a);
                     });
  if (!domain.balance_wanted) return;
  std::vector<Balance> parts(blocks);
  parallel::for_each(blocks, [&](int k) { parts[k] = balance_of(domain, k, 0.01 * cell_mass); });
  domain.balance = {};
  for (const Balance& part : parts)
  {
    domain.balance.unbalanced += part.unbalanced;
    domain.balance.total += part.total;
  }
}
} // namespace mpm
