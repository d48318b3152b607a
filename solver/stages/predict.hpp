#pragma once

#include "solver/stages/session.hpp"

namespace mpm
{
/// `--check`: logs particles, memory, time step, steps and wall time for `duration` s, after a short probe
/// that changes the model. Returns the exit code.
int predict(Session& session, Model& model, const Clock& clock, double duration);
} // namespace mpm
