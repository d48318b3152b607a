#include "solver/mpm/inertia.hpp"
#include "solver/mpm/simd.hpp"
#include "solver/mpm/step.hpp"

#include <cmath>

namespace mpm
{
namespace
{
/// dt c / m of a dashpot that a node follows rather than its own mass.
constexpr double strong = 4;

struct Parameters
{
  double dt;            ///< s
  double smallest_mass; ///< of nodes that move, kg per m
  double damping;       ///< beta of eq. (1)
  bool corrected;       ///< whether correct_inertia follows
  bool flip;            ///< whether particles take what the nodes gained
};

/// Neighbouring nodes of a row, one a lane; those without mass count as 1 kg and are left out.
struct Nodes
{
  int first; ///< index of the first in the node fields
  Selection active;
  Lanes mass, inverse_mass;

  Nodes(const Grid& g, int node, double smallest_mass) : first(node)
  {
    const Lanes all = load_as<Lanes>(&g.mass[node]);
    active = above(all, Lanes{} + smallest_mass);
    mass = chosen(active, all, Lanes{} + 1);
    inverse_mass = 1 / mass;
  }
  bool empty() const { return bits(active) == 0; }
  Lanes of(const NodeField& field) const { return load_as<Lanes>(&field[first]); }
};

/// What local damping takes from a force, component by component: beta |f| sign(v), sign(0) = 0 (eq. 1). It
/// drains every mode at the same ratio, about beta / pi, and vanishes in equilibrium.
inline Lanes taken_by_damping(const Parameters& a, const Lanes& force, const Lanes& velocity)
{
  const Lanes most = a.damping * chosen(above(force, Lanes{}), force, -force);
  return chosen(above(velocity, Lanes{}), most, chosen(above(Lanes{}, velocity), -most, Lanes{}));
}

/// One component of the nodes' motion in the step.
struct Motion
{
  Lanes momentum, force, before, change, after;

  Motion(const Nodes& nodes, const NodeField& momenta, const NodeField& forces)
      : momentum(nodes.of(momenta)), force(nodes.of(forces)), before(nodes.inverse_mass * momentum)
  {
    before += nodes.inverse_mass * (momentum - nodes.mass * before); // as exact as a division
  }
  /// Newton's law with a dashpot c that acts on the mean of the velocities before and after,
  ///
  ///   m (v* - v) / dt = f - beta |f| sign(v) - c (v + v*) / 2
  ///   v* = v + dt (f - beta |f| sign(v) - c v) / (m + dt c / 2),
  ///
  /// which takes energy however large c is; an explicit dashpot would shorten the stable step.
  Lanes solve(const Parameters& a, const Nodes& nodes, const NodeField& dashpots)
  {
    Lanes pushed = force - taken_by_damping(a, force, before), inverse = nodes.inverse_mass;
    const Lanes dashpot = dashpots.empty() ? Lanes{} : nodes.of(dashpots);
    if (bits(above(dashpot, Lanes{})) != 0)
    {
      pushed -= dashpot * before;
      inverse = 1 / (nodes.mass + 0.5 * a.dt * dashpot);
    }
    change = chosen(nodes.active, a.dt * inverse * pushed, Lanes{});
    after = chosen(nodes.active, before, Lanes{}) + change;
    return after;
  }
};

/// What the forces did (StepWork), summed lane by lane, so that the sums have one order.
struct WorkSums
{
  Lanes work{}, damping{}, momentum[2]{};

  /// Adds one component, 0 or 1, of nodes of which `part` is counted. Forces that gave the impulse j, N s per
  /// m, did the work j (v + v*) / 2, exactly the change of the kinetic energy.
  void add(int component, const Parameters& a, const Lanes& part, const Nodes& nodes, const Motion& m,
           const Lanes& impulse)
  {
    const Lanes middle = 0.5 * part * (m.before + m.after);
    work += impulse * middle;
    if (a.damping > 0) damping += a.dt * taken_by_damping(a, m.force, m.before) * middle;
    momentum[component] += 0.5 * part * (m.momentum + nodes.mass * m.after);
  }
  StepWork total() const
  {
    StepWork sum;
    for (int k = 0; k < lanes; ++k)
    {
      sum.work += work[k];
      sum.damping += damping[k];
      sum.momentum[0] += momentum[0][k];
      sum.momentum[1] += momentum[1][k];
    }
    return sum;
  }
};

/// Part of nodes that counts in sums.
Lanes counted(const Grid& g, const Nodes& nodes)
{
  return chosen(nodes.active, g.share.empty() ? Lanes{} + 1 : nodes.of(g.share), Lanes{});
}

/// The greatest of the dashpots at nodes, N s/m per m: not their sum, so that a corner is as a column's base
/// is.
Lanes greatest_dashpot(const Grid& g, const Nodes& nodes)
{
  Lanes greatest{};
  for (const auto* field : {&g.dashpot_x, &g.dashpot_y, &g.face_dashpot_x, &g.face_dashpot_y})
  {
    if (field->empty()) continue;
    const Lanes c = nodes.of(*field);
    greatest = chosen(above(c, greatest), c, greatest);
  }
  return greatest;
}

/// Finds a block's velocities v*, what correct_inertia or the particles need of their change, and, where
/// nothing corrects them after, what the forces did.
StepWork solve_block(Grid& g, int block, const Parameters& a)
{
  WorkSums sum;
  for (int k = block * block_nodes; k < (block + 1) * block_nodes; k += lanes)
  {
    const Nodes nodes(g, k, a.smallest_mass);
    Lanes vx{}, vy{}, change_x{}, change_y{}, linked{};
    if (!nodes.empty())
    {
      Motion x(nodes, g.momentum_x, g.force_x), y(nodes, g.momentum_y, g.force_y);
      vx = x.solve(a, nodes, g.dashpot_x);
      vy = y.solve(a, nodes, g.dashpot_y);
      change_x = x.change;
      change_y = y.change;
      if (a.corrected)
      {
        const Selection own = above(strong * nodes.mass, a.dt * greatest_dashpot(g, nodes));
        linked = chosen(own, chosen(nodes.active, nodes.mass, Lanes{}), Lanes{});
      }
      else
      {
        const Lanes part = counted(g, nodes);
        sum.add(0, a, part, nodes, x, nodes.mass * x.after - x.momentum);
        sum.add(1, a, part, nodes, y, nodes.mass * y.after - y.momentum);
      }
    }
    store(&g.velocity_x[k], vx);
    store(&g.velocity_y[k], vy);
    if (a.corrected) store(&g.linked_mass[k], linked);
    if (a.corrected || a.flip)
    {
      store(a.corrected ? &g.change_x[k] : &g.gained_x[k], change_x);
      store(a.corrected ? &g.change_y[k] : &g.gained_y[k], change_y);
    }
  }
  return sum.total();
}

/// What the forces did to nodes whose velocities were corrected, and what these gained. What neighbours
/// exchange is no work of a force: it counts as the transfers'.
StepWork finish_corrected(Grid& g, int block, const Parameters& a)
{
  WorkSums sum;
  for (int k = block * block_nodes; k < (block + 1) * block_nodes; k += lanes)
  {
    const Nodes nodes(g, k, a.smallest_mass);
    if (nodes.empty())
    {
      if (a.flip)
        for (auto* field : {&g.gained_x, &g.gained_y}) store(&(*field)[k], Lanes{});
      continue;
    }
    Motion x(nodes, g.momentum_x, g.force_x), y(nodes, g.momentum_y, g.force_y);
    x.after = nodes.of(g.velocity_x);
    y.after = nodes.of(g.velocity_y);
    if (a.flip)
    {
      store(&g.gained_x[k], chosen(nodes.active, x.after - x.before, Lanes{}));
      store(&g.gained_y[k], chosen(nodes.active, y.after - y.before, Lanes{}));
    }
    const Lanes part = counted(g, nodes);
    sum.add(0, a, part, nodes, x, nodes.mass * nodes.of(g.change_x));
    sum.add(1, a, part, nodes, y, nodes.mass * nodes.of(g.change_y));
  }
  return sum.total();
}

/// Sum in the order of the blocks, whatever thread did which.
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
ForceBalance balance_of(const Domain& domain, double cell_mass)
{
  const int blocks = static_cast<int>(domain.grid.blocks.size());
  std::vector<double> parts(blocks);
  domain.grid.for_each_block([&](int k) { parts[k] = unbalanced_of(domain.grid, k, 0.01 * cell_mass); });
  ForceBalance b;
  for (const double part : parts) b.unbalanced += part;
  for (const double mass : domain.particles.mass) b.total += 2 * mass;
  b.total *= std::hypot(domain.settings.gravity_x, domain.settings.gravity_y);
  return b;
}
} // namespace

void solve_grid(Domain& domain, double dt)
{
  Grid& grid = domain.grid;
  for (const auto& boundary : domain.boundaries) boundary->constrain(grid);
  hold_nodes(grid, domain.rest.held);
  const int blocks = static_cast<int>(grid.blocks.size());
  double density = 0;
  for (const Material& material : domain.materials) density = std::max(density, material.elastic().density);
  const double cell_mass = density * grid.spacing * grid.spacing;
  grid.smallest_mass = 1e-14 * cell_mass; // of a full cell of the densest ground
  const Parameters a{dt, grid.smallest_mass, domain.settings.local_damping,
                     domain.settings.consistent_inertia, domain.settings.flip};
  if (a.corrected)
    for (auto* field : {&grid.change_x, &grid.change_y, &grid.linked_mass}) field->resize(grid.nodes());
  if (a.flip)
    for (auto* field : {&grid.gained_x, &grid.gained_y}) field->resize(grid.nodes());
  std::vector<StepWork> works(blocks);
  grid.for_each_block([&](int k) { works[k] = solve_block(grid, k, a); });
  if (a.corrected)
  {
    for (const auto& boundary : domain.boundaries) boundary->apply_dashpots(grid, dt);
    correct_inertia(grid);
    for (const auto& boundary : domain.boundaries) boundary->mirror_velocities(grid);
    hold_nodes(grid, domain.rest.held);
    grid.for_each_block([&](int k) { works[k] = finish_corrected(grid, k, a); });
  }
  domain.energy.step = sum_of(works, dt);
  if (domain.settings.measure_force_balance) domain.measures.force_balance = balance_of(domain, cell_mass);
}
} // namespace mpm
