#pragma once

#include "io/case/case.hpp"
#include "io/results/frames.hpp"
#include "solver/mpm/domain.hpp"
#include "solver/stages/clock.hpp"

namespace mpm
{
/// Of the particle with index k, since the start of the stage, m.
std::array<double, 2> displacement_of(const Domain& domain, int k);
/// Of the particle with index k, m/s.
std::array<double, 2> velocity_of(const Domain& domain, int k);

/// The particles as they are now, with the fields that the case asks for, and position, material and volume
/// of each whatever it asks for: pictures draw particles as large as they are.
Frame frame_of(const Domain& domain, const Case& case_file, const Clock& clock);
} // namespace mpm
