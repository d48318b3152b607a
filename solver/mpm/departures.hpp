#pragma once
// Ground that leaves a domain: it takes no further part in steps, and what it took along is kept.

#include "solver/mpm/boundary.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace mpm
{
/// A particle that has left.
struct Departed
{
  std::int64_t particle = 0;               ///< id
  int material = 0;                        ///< index in Domain::materials
  Edge edge = Edge::bottom;                ///< which it passed
  double time = 0;                         ///< when it was taken out, s
  double mass = 0;                         ///< kg per m
  double reference_x = 0, reference_y = 0; ///< where it was in the undeformed ground, m
};

/// A particle that is to leave: its index among the particles, and the edge that it has passed.
struct Leaving
{
  int index;
  Edge edge;
};

/// Takes particles, in growing order of their indices, out of the domain: notes them in Domain::departed,
/// books their energy, lets the boundaries forget them and sorts.
void remove_particles(Domain& domain, std::span<const Leaving> leaving);

/// Saves or loads what has left.
void visit_departed(StateVisitor& visitor, std::vector<Departed>& departed);
} // namespace mpm
