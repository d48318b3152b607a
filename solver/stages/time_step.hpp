#pragma once
// How long a time step is.
//
// An explicit step is stable while waves cross less than a fraction of a cell in it, the Courant number
// C = dt c_p / h (solver/mpm/stability.hpp). Stages step at the number that the case gives: 0.7 in the static
// stage, where nothing but stability counts, 0.5 in the seismic one, where a larger one delays waves and a
// smaller one damps them.

#include "solver/stages/clock.hpp"
#include "solver/stages/model.hpp"

namespace mpm
{
class Session;

/// Greatest pressure-wave speed of the ground as it is now, m/s: sqrt(M V / m) of the particles, with M the
/// P-wave modulus. V of what is torn apart is the volume that it will have when it has closed, since it
/// carries no stress before.
double greatest_wave_speed(const Domain& domain);

/// dt = C h / c_p with the greatest wave speed as it is now, s.
double step_of(double courant_number, const Domain& domain);

/// Likewise of undeformed ground without scaled masses.
double unscaled_step(double courant_number, const Domain& domain);

/// The longest such step that divides an interval (s), so that samples at that interval are evenly spaced.
double step_dividing(double interval, double courant_number, const Domain& domain);

/// Makes inertial masses so large that pressure waves are as slow in every material as in the slowest one: a
/// static stage then settles in fewer steps, to the same equilibrium, since weights stay as they are.
void scale_masses(Model& model);

/// Halves the step and warns when the ground has become so loose that waves outrun it: a particle whose
/// volume has grown carries the same modulus on less mass.
void halve_step_if_outrun(Session& session, const Model& model, double courant_number, Clock& clock);
} // namespace mpm
