#include "solver/mpm/inertia.hpp"
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
  const int from = block * block_nodes;
  const auto solve = [&, a](const std::vector<double>& momentum, const std::vector<double>& force,
                            const std::vector<double>& dashpot, std::vector<double>& velocity)
  {
    const double *m = &g.mass[from], *p = &momentum[from], *f = &force[from];
    const double* c = dashpots ? &dashpot[from] : m;
    double* __restrict v = &velocity[from];
#pragma GCC ivdep
    for (int k = 0; k < block_nodes; ++k)
    {
      const bool active = m[k] > a.smallest_mass;
      const double solved = accelerate(a, active ? m[k] : 1, p[k], f[k], dashpots ? c[k] : 0);
      v[k] = active ? solved : 0;
    }
  };
  solve(g.momentum_x, g.force_x, g.dashpot_x, g.velocity_x);
  solve(g.momentum_y, g.force_y, g.dashpot_y, g.velocity_y);
}

/// Sums over the nodes of a block, lane by lane so that they vectorise with one order of summation.
struct Lanes
{
  alignas(64) std::array<double, block_cells> work{}, damping{}, momentum_x{}, momentum_y{};
};

/// One component of one node, of which `part` is counted.
inline void add_work(Lanes& sum, int lane, const Parameters& a, double part, double m, double momentum,
                     double f, double v, double impulse)
{
  const double before = momentum / m, middle = 0.5 * (before + v);
  sum.work[lane] += part * impulse * middle;
  sum.damping[lane] += part * a.dt * a.damping * std::fabs(f) * ((before > 0) - (before < 0)) * middle;
}

/// What the forces did to the nodes of a block in the step (StepWork).
StepWork work_of_block(const Grid& g, int block, const Parameters& a, bool corrected)
{
  static constexpr auto whole = []
  {
    std::array<double, block_nodes> ones{};
    ones.fill(1);
    return ones;
  }();
  const double* share = g.share.empty() ? whole.data() : &g.share[block * block_nodes];
  Lanes sum;
  for (int row = 0; row < block_cells; ++row)
    for (int lane = 0; lane < block_cells; ++lane)
    {
      const int place = row * block_cells + lane, k = block * block_nodes + place;
      const bool active = g.mass[k] > a.smallest_mass;
      const double part = active ? share[place] : 0, m = active ? g.mass[k] : 1;
      const double px = g.momentum_x[k], py = g.momentum_y[k], vx = g.velocity_x[k], vy = g.velocity_y[k];
      // What neighbours exchange is no work of a force: the transfer between particles and grid holds it.
      add_work(sum, lane, a, part, m, px, g.force_x[k], vx, corrected ? m * g.change_x[k] : m * vx - px);
      add_work(sum, lane, a, part, m, py, g.force_y[k], vy, corrected ? m * g.change_y[k] : m * vy - py);
      sum.momentum_x[lane] += 0.5 * part * (px + m * vx);
      sum.momentum_y[lane] += 0.5 * part * (py + m * vy);
    }
  StepWork total;
  for (int lane = 0; lane < block_cells; ++lane)
  {
    total.work += sum.work[lane];
    total.damping += sum.damping[lane];
    total.momentum[0] += sum.momentum_x[lane];
    total.momentum[1] += sum.momentum_y[lane];
  }
  return total;
}

/// In the order of the blocks, whatever thread did which.
StepWork sum_of(const std::vector<StepWork>& parts, double dt)
{
  StepWork sum;
  sum.dt = dt;
  for (const StepWork& part : parts)
  {
    sum.work += part.work;
    sum.damping += part.damping;
    sum.momentum[0] += part.momentum[0];
    sum.momentum[1] += part.momentum[1];
  }
  return sum;
}

/// Sum of the forces on a block's nodes with more mass than `gate`, N per m.
double unbalanced_of(const Grid& g, int block, double gate)
{
  double sum = 0;
  for (int k = block * block_nodes; k < (block + 1) * block_nodes; ++k)
    if (g.mass[k] >= gate) sum += std::hypot(g.force_x[k], g.force_y[k]);
  return sum;
}

/// In equilibrium internal forces are the opposite of weight, node by node, so that together they are twice
/// the weight; masses may be scaled, weights are not.
Balance balance_of(const Domain& domain, double cell_mass)
{
  const int blocks = static_cast<int>(domain.grid.blocks.size());
  std::vector<double> parts(blocks);
  domain.grid.for_each_block([&](int k) { parts[k] = unbalanced_of(domain.grid, k, 0.01 * cell_mass); });
  Balance b;
  for (const double part : parts) b.unbalanced += part;
  for (const double mass : domain.particles.mass) b.total += 2 * mass;
  b.total *= std::hypot(domain.gravity_x, domain.gravity_y);
  return b;
}
} // namespace

void solve_grid(Domain& domain, double dt)
{
  for (const auto& boundary : domain.boundaries) boundary->constrain(domain);
  hold_resting_nodes(domain);
  Grid& grid = domain.grid;
  const int blocks = static_cast<int>(grid.blocks.size());
  double density = 0;
  for (const Material& material : domain.materials) density = std::max(density, material.elastic().density);
  const double cell_mass = density * grid.spacing * grid.spacing;
  grid.smallest_mass = 1e-14 * cell_mass;
  const Parameters a{dt, grid.smallest_mass, domain.damping};
  std::vector<StepWork> works(blocks);
  grid.for_each_block(
      [&](int k)
      {
        if (grid.dashpot_x.empty())
          solve_block<false>(grid, k, a);
        else
          solve_block<true>(grid, k, a);
        if (!domain.consistent_inertia) works[k] = work_of_block(grid, k, a, false);
      });
  if (domain.consistent_inertia)
  {
    for (const auto& boundary : domain.boundaries) boundary->apply_dashpots(domain, dt);
    correct_inertia(domain, dt);
    hold_resting_nodes(domain);
    grid.for_each_block([&](int k) { works[k] = work_of_block(grid, k, a, true); });
  }
  domain.ledger.step = sum_of(works, dt);
  if (domain.balance_wanted) domain.balance = balance_of(domain, cell_mass);
}
} // namespace mpm
