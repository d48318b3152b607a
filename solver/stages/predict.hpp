#pragma once

#include "boundaries/ground_motion/incoming_wave.hpp"
#include "solver/stages/clock.hpp"
#include "solver/stages/model.hpp"
#include "solver/stages/session.hpp"

namespace mpm
{
/// `--check`: logs particles, memory, time step, steps and wall time, and what other profiles would cost,
/// after a short probe with the stage's own boundaries, which changes the model. Return the exit code.
int predict_shaking(Session& session, Model& model, const Clock& clock,
                    std::shared_ptr<const IncomingWave> wave);
/// Likewise of the static stage, which is tried on a coarse grid to see when it settles.
int predict_relaxation(Session& session, Model& model, const Clock& clock);
} // namespace mpm
