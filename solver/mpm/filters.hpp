#pragma once
// What particles hold and the grid cannot carry: velocities, stresses and volumes that vary from particle to
// particle within a cell or two. No node feels them, so that no force corrects them; they grow with all that
// flows, and hold it back. Filters of the null space: Gritton & Berzins, Comput. Part. Mech. 4 (2017) 401; of
// order two as Hammerquist & Nairn, Comput. Methods Appl. Mech. Eng. 318 (2017) 724, build them for
// velocities.
//
// With A the way of a field to the nodes and back, which leaves affine fields as they are, (1 - A) f is what
// the way loses, and of a wave of wave number k it is about a (kh)^4, a = 0.047; (1 - A)^2 f, which is taken
// away here, is a^2 (kh)^8: a millionth of a wave of 16 cells, and all of what no node feels.

namespace mpm
{
struct Domain;

/// How fast the filters work; StepSettings holds them.
struct NullSpaceFilter
{
  double time = 0;   ///< s in which velocities lose all but 1/e of it; 0: they keep it
  double strain = 0; ///< plastic strain over which stresses and volumes do (filter_stresses); 0: they keep it
};

/// Takes (1 - exp(-T/time)) (1 - A)^2 (v, C) from the particles' velocities and affine matrices, A being APIC
/// (paper, eq. 2 and 3), when one of the intervals T, ten to filter.time, has passed with domain.time. Keeps
/// linear momentum to round-off and angular momentum as APIC does.
void filter_velocities(Domain& domain, double dt);
} // namespace mpm
