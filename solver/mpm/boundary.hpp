#pragma once

#include "solver/mpm/energy_balance.hpp"

namespace mpm
{
struct Domain;
struct Grid;
struct Particles;

/// Which outer face of a model.
enum class Edge
{
  bottom,
  left,
  right,
};

/// What a boundary does to a step, in the order of the calls. The loops over its particles and nodes are
/// inside; each function is called once a step at most. A new boundary is a class of this kind that
/// solver/stages adds to Domain::boundaries.
struct Boundary
{
  virtual ~Boundary() = default;
  /// Its group below /boundary in a checkpoint; empty when it has nothing to remember.
  virtual std::string_view name() const { return {}; }
  /// Whether the boundary needs the grid's dashpot coefficients.
  virtual bool absorbs() const { return false; }
  /// The particles were sorted: what depends on their positions may be decided anew.
  virtual void sort(const Domain&) {}
  /// Finds its particles and nodes again after a sort or a restart; must not depend on positions, since a
  /// restart finds particles further on than the sort did.
  virtual void bind(const Domain&) {}
  /// Particles have left (their Particles::index_of is -1): forgets what belongs to them.
  virtual void release(const Particles&) {}
  /// Adds forces and dashpots to the grid, after the particles' own scatter. The step runs from domain.time
  /// to domain.time + dt.
  virtual void add_forces(Domain&, double /*dt*/) {}
  /// The last change of mass, momentum, forces and dashpots before the equation of motion, in the order of
  /// Domain::boundaries: mirrors nodes at a wall; shares out the base's dashpots, after the walls.
  virtual void constrain(Grid&) {}
  /// With consistent inertia, after the equation of motion node by node: forces that depend on several nodes'
  /// velocities.
  virtual void apply_dashpots(Grid&, double /*dt*/) {}
  /// After a correction of the velocities node by node: mirrors them at a wall again.
  virtual void mirror_velocities(Grid&) {}
  /// After the equation of motion: adds to `now` what its own forces did to the ground in the step, with the
  /// nodes' mean velocity (Grid::middle_velocity), J per m.
  virtual void measure_work(const Domain&, double /*dt*/, Energies& /*now*/) const {}
  /// What the ground remembers here, for checkpoints.
  virtual void visit_state(StateVisitor&) {}
  /// What makes the loaded state impossible, in words; empty: nothing. The particles are loaded.
  virtual std::string state_problem(const Domain&) const { return {}; }
};
} // namespace mpm
