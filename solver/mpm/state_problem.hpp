#pragma once

#include "solver/mpm/domain.hpp"

#include <string>

namespace mpm
{
/// What makes the state in a domain one that no run of its case can have left, in words; empty: nothing. For
/// states that come from a file, before `rebuild`: a step of what passes reads and writes nothing that is not
/// there. Looks at particles, material states, occupied blocks and boundaries; `masses` are the case's by
/// particle id, kg per m. Fills Particles::index_of.
std::string state_problem(Domain& domain, const std::vector<double>& masses);

/// Whether a point (m) stands where the tile of a block reaches it: no more than a cell beside the block.
bool within_tile(const Grid& grid, BlockIndex block, double x, double y);
} // namespace mpm
