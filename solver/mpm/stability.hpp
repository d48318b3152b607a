#pragma once
// Stable steps, as Courant numbers C = dt c_p / h of the fastest pressure wave. From the growth factor z of a
// mode of frequency w, z^2 - (G + 1 - dt^2 w^2) z + G = 0, steps are stable for dt^2 w^2 <= 2 (1 + G), G
// being what the affine transfer leaves of the mode's velocity. In the bulk of the ground, with two particles
// or more per cell and direction, that is C = 1.77 for every Poisson's ratio; with consistent inertia 1.19.
// The first to go is a particle that flies alone: its mass is all that its nodes have, and its own stress
// drives them. It is stable up to C = 0.93 at a Poisson's ratio of 0.3
// (test/mpm/test_stability tries 0.9 and 1.3), and up to 0.79 at 0.49.

namespace mpm
{
/// Greatest Courant number of a case: what a lone particle of nearly incompressible ground stands.
inline constexpr double stable_courant_number = 0.78;

/// Of steps that are as long as is advisable: loosened ground has faster waves, for which the rest is left.
/// The static stage's default, since it has no waves to carry.
inline constexpr double fast_courant_number = 0.7;

/// Of steps that carry waves well: the default of the seismic stage.
inline constexpr double usual_courant_number = 0.5;
} // namespace mpm
