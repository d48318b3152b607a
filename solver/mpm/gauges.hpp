#pragma once

#include "solver/mpm/domain.hpp"

namespace mpm
{
/// Moves the gauges over a step of dt s with the nodes' velocities v*. A gauge reads the field, corrected for
/// its kink; one that has left with its ground stays as it is.
void move_gauges(Domain& domain, double dt);
} // namespace mpm
