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
