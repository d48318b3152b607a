#pragma once

#include "solver/stages/clock.hpp"
#include "solver/stages/model.hpp"
#include "solver/stages/session.hpp"

namespace mpm
{
/// `--check`: logs particles, memory, time step, steps and wall time, after a short probe that changes the
/// model. Return the exit code.
int predict_shaking(Session& session, Model& model, const Clock& clock);
/// Likewise of the static stage, which takes its ramp and then as long as the ground needs to settle.
int predict_relaxation(Session& session, Model& model, const Clock& clock);
} // namespace mpm
