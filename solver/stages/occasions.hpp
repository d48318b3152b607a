#pragma once

#include "boundaries/ground_motion/incoming_wave.hpp"
#include "io/case/case.hpp"
#include "solver/stages/cost.hpp"

#include <string>

namespace mpm
{
/// What a stage does in steps of `dt` (s) over `duration` s of model time; `wave`: null in the static stage.
/// Where ground may rest, all that cannot yield is taken to, from a second after the motion on.
Occasions occasions_of(const Case& case_file, const IncomingWave* wave, double dt, double duration);

/// A time for people: "3.4 s" where duration_text would say 3 s.
std::string time_text(double seconds);
} // namespace mpm
