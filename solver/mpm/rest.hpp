#pragma once

#include "solver/mpm/state.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace mpm
{
struct Domain;
struct Grid;

/// Ground at rest, which steps leave alone until something moves beside it: after a slide most of a long
/// model stands still, and its particles are not computed.
///
/// A block falls asleep when for a second nothing in it and in the eight blocks around it has moved faster
/// than `below`; its particles then stand still. It wakes in the step in which anything in those eight moves
/// faster. Nodes that sleeping and waking ground share are held, so that sleeping ground is a wall, which
/// meets waves of no more than `below`. The error is as small: displacements of up to `below` times the time
/// asleep are not made, speeds of up to `below` are reflected. Forces from outside do not wake the ground:
/// rest is to be allowed when the input has ended.
struct Rest
{
  static constexpr double window = 1; ///< how long ground must have been slow to fall asleep, s
  double below = 0;                   ///< m/s; 0: nothing rests
  double watched = 0;                 ///< how much of the window has passed, s
  std::int64_t skipped = 0;           ///< particle-steps that were not computed
  std::vector<int> held;              ///< nodes that sleeping and waking ground share
};

/// Lets ground slower than `below` (m/s) fall asleep from now on; 0 wakes all and lets none.
void allow_rest(Domain& domain, double below);

/// Finds the nodes to be held and the occupied blocks that are awake; after a change of either.
void bind_rest(Domain& domain);

/// Takes momentum, forces and velocity from nodes (Rest::held): before the equation of motion, and after a
/// correction of the velocities node by node.
void hold_nodes(Grid& grid, std::span<const int> nodes);

/// After a step of dt s: wakes what has something moving beside it, lets fall asleep what has come to rest.
/// `moves` are the greatest displacements of each occupied block's particles in it, in cells.
void watch_rest(Domain& domain, std::span<const double> moves, double dt);

/// Saves or loads what rests; the occupied blocks are loaded.
void visit_rest(StateVisitor& visitor, Domain& domain);
} // namespace mpm
