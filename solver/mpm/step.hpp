#pragma once

#include "solver/mpm/domain.hpp"

namespace mpm
{
/// One explicit step of symplectic Euler (paper Figure 1; METHODS section 1) from domain.time over dt
/// seconds. The caller sets domain.time. Throws Diverged when a particle moves more than a quarter of a cell.
void step(Domain& domain, double dt);

void particles_to_grid(Domain& domain, double dt); ///< (a) mass, momentum and forces to the grid
void solve_grid(Domain& domain, double dt);        ///< (b) equation of motion
void grid_to_particles(Domain& domain, double dt); ///< (c) and (d), chunk by chunk

/// Before (c), where Domain::average_volume asks for it: gives the particles of each material that can yield
/// the mean volume change of those of them that stand in the same cell, weighted by mass, instead of their
/// own. Plastic flow keeps its volume, and asking that of every particle asks more than the nodes can give
/// (B-bar: Hughes 1980). The difference, dt (mean - tr L) in all three directions, is an elastic pressure, so
/// that it is added to the stress and the volume that the law is about to start from.
void average_volume_changes(Domain& domain, double dt);

inline constexpr int chunk_size = 64;

/// Velocity gradients of a chunk of consecutive particles of one material, 1/s.
struct VelocityGradients
{
  alignas(64) std::array<double, chunk_size> xx, xy, yx, yy;
};

/// (d) deformation and stress of the particles [begin, begin + count) of a material.
void update_particles(Domain& domain, int material, int begin, int count, const VelocityGradients& gradients,
                      double dt);
} // namespace mpm
