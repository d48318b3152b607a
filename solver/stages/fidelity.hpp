#pragma once

#include "boundaries/ground_motion/incoming_wave.hpp"
#include "solver/mpm/dispersion.hpp"
#include "solver/stages/session.hpp"

namespace mpm
{
/// What decides how the case's seismic stage, in steps of `dt` (s), carries waves.
Resolution resolution_of(const Case& case_file, double dt);

/// Tells how far the case's grid and the step `dt` (s) carry the S and P waves of each material: wave speeds,
/// the frequencies up to which phase error and numerical damping stay below 1 %, and the share of the Arias
/// intensity of the motion, as the case lets it be applied, that lies above the lower of the two (S:
/// horizontal, P: vertical component; no shares without a `wave`). Goes to the log and, as `resolution`, to
/// the summary. Warns when more than 10 % of the intensity lies above, and when a small step costs fidelity.
void report_wave_fidelity(Session& session, double dt, const IncomingWave* wave);
} // namespace mpm
