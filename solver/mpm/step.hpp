#pragma once
// One explicit step. With the time step dt, w = N_i(x_p) and D = h^2 / 3 (paper Figure 1 and eqs. 1 to 3; the
// affine transfer is APIC: Jiang, Schroeder, Selle, Teran & Stomakhin, ACM Trans. Graph. 34 (2015) 51):
//
//   (a) m_i = sum w m,   P_i = sum w m (v + C (x_i - x)),   f_i = sum -V sigma grad w + w m g + boundaries
//   (b) v*_i = P_i / m_i + dt f_i / m_i, with local damping in the static stage and dashpots at boundaries
//   (c) v = sum w v*,   C = 1/D sum w v* (x_i - x)^T,   x += dt v
//   (d) V *= det(1 + dt L), L = sum v* grad w^T;   sigma by rotation and the law's stress update
//
// Stress and position of a step use the velocity of its end: symplectic Euler, which neither gains nor loses
// energy over a period. What steps are stable: stability.hpp; what they do to waves: dispersion.hpp.

#include "solver/mpm/domain.hpp"

namespace mpm
{
/// One step from domain.time over dt seconds; the caller moves domain.time on. Throws Diverged when a
/// particle moves more than a quarter of a cell, is deformed wholly or gets a velocity that is no number.
void step(Domain& domain, double dt);

/// (a): mass, momentum and forces of the particles, then the boundaries' forces.
void particles_to_grid(Domain& domain, double dt);

/// (b): the nodes' velocities at the end of the step, and what the forces did (EnergyBalance::step).
void solve_grid(Domain& domain, double dt);

/// (c) and (d), chunk by chunk. With StepSettings::flip particles keep their own velocity and take the
/// nodes' change, v = v_p + sum w (v* - P/m) (FLIP: Brackbill & Ruppel, J. Comput. Phys. 65 (1986) 314), so
/// that no step damps it and filter_velocities has to; C and the path are the same.
/// Gauges move with the grid.
void grid_to_particles(Domain& domain, double dt);

/// Before (c), where StepSettings::average_volume asks for it: gives the particles of each material that can
/// yield the mean volume change of those of them that stand in the same cell, weighted by mass, instead of
/// their own. Plastic flow keeps its volume, and asking that of every particle asks more than the nodes can
/// give (B-bar: Hughes, Int. J. Numer. Methods Eng. 15 (1980) 1413). The difference, dt (mean - tr L) in all
/// three directions, is an elastic pressure, so that it is added to the stress and the volume that the law is
/// about to start from.
void average_volume_changes(Domain& domain, double dt);

/// Particles that are worked on together; a whole number of vectors, and small enough for the first cache.
inline constexpr int chunk_size = 64;

/// Velocity gradients L_ab = dv_a/dx_b of a chunk of consecutive particles of one material, 1/s.
struct VelocityGradients
{
  alignas(64) std::array<double, chunk_size> xx, xy, yx, yy;
};

/// (d) of the particles [begin, begin + count) of a material, chunk_size at most.
void update_particles(Domain& domain, int material, int begin, int count, const VelocityGradients& gradients,
                      double dt);
} // namespace mpm
