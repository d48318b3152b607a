#pragma once
// Whether the motion is still one that ground can have. A step looks at what it touches anyway (step.hpp): no
// velocity on the grid may be other than a finite number, and no particle may move more than a quarter of a
// cell or be deformed wholly. What that cannot see is looked at every so many steps, and before anything is
// written.

#include "solver/mpm/domain.hpp"

namespace mpm
{
/// Greatest move of a particle in a step, cells. Stable steps move it by dt v / h = C v / c_p, far less:
/// ground moves slower than half of its own pressure waves at the usual Courant number C of 0.5.
inline constexpr double move_limit = 0.25;

/// dt |L| beyond which a step has lost the motion: the particle would be turned inside out.
inline constexpr double gradient_limit = 1;

/// Throws Diverged, which names the first ill particle (the lowest id), when one has a value that is no
/// finite number, a volume below a tenth of the undeformed one or, but for what is torn apart, beyond the 4 h
/// x 4 h that its spline covers, a velocity of more than a cell a step, or a place outside the nodes of its
/// block. The same on any number of threads.
void check_particles(const Domain& domain);

/// The same for places alone: before a sort, after which a particle that was somewhere else would be at home.
void check_places(const Domain& domain);

/// Why a step of dt (s) that has just failed did so, as text: the first particle that is ill or too fast, or
/// where there is none the fastest.
std::string failed_step(const Domain& domain, double dt);

/// Names the particle that moves fastest, the first of several, with its place and speed.
std::string fastest_particle(const Domain& domain);
} // namespace mpm
