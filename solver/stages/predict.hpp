#pragma once

#include "solver/stages/session.hpp"

namespace mpm
{
/// Logs each material's wave speeds and the frequency up to which its S waves travel within 1 % of their
/// speed (26 cells a wavelength; METHODS section 7).
void log_wave_fidelity(Session& session);

/// The same for summary.json: cells, and by material c_s (m/s) and that frequency (Hz).
nlohmann::json resolution(const Case& scene);

/// `--check`: logs particles, memory, time step, steps and wall time for `duration` s, after a short probe
/// that changes the model. Returns the exit code.
int predict(Session& session, Model& model, const Clock& clock, double duration);
} // namespace mpm
