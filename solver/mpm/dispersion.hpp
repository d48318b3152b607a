#pragma once
// What the grid and the steps do to a plane wave: cubic B-splines, lumped or consistent inertia, affine
// transfer, two or more particles per cell and direction. All follow from the growth factor z of a mode of
// wave number k from step to step, for k h << 1. Symplectic Euler with a transfer that leaves G of the
// velocity says
//
//   v' = G v - dt w^2 u,   u' = u + dt v',   so that   z^2 - (G + 1 - dt^2 w^2) z + G = 0,
//
// where w(k) is the grid's frequency and sqrt(G) the loss of amplitude in a step.

#include <cmath>
#include <numbers>

namespace mpm
{
/// Cell size h in m, time step in s, and how velocities pass between particles and grid.
struct Resolution
{
  double spacing;
  double dt;
  bool flip = false;               ///< false: the affine transfer takes its part in every step
  double filter_time = 0;          ///< of filter_velocities, with FLIP, s; 0: no filter
  bool consistent_inertia = false; ///< see correct_inertia
};

/// a: the affine transfer leaves G = 1 - a (k h)^4 of a mode's velocity each step. Particles carry velocity
/// and gradient, so that the transfer is exact for linear fields and takes what curves within a cell.
inline constexpr double transfer_loss = 0.0471;

/// Wave number times cell size of a wave of `speed` (m/s) and `frequency` (Hz).
inline double wave_number_cells(const Resolution& r, double speed, double frequency)
{
  return 2 * std::numbers::pi * frequency * r.spacing / speed;
}

/// Lag of consistent inertia over (k h)^4: 31/720 of w = c k sinc^4(k h / 2) sqrt(1 + 2/3 (1 - cos k h)),
/// less what the affine transfer's loss hastens the step, (1 - G) / 4.
inline double consistent_lag(const Resolution& r)
{
  return 31.0 / 720 - 0.25 * (r.flip ? 0 : transfer_loss);
}

/// Share by which the wave is too slow: (k h)^2 (1/6 - C^2/24), C = dt speed / h. The first part is the
/// smoothing of the lumped mass and force, w = c k sinc^4(k h / 2), and 31/720 (k h)^4 where inertia is
/// consistent; the second is the lead of symplectic Euler.
inline double phase_error(const Resolution& r, double speed, double frequency)
{
  const double kh = wave_number_cells(r, speed, frequency), courant = r.dt * speed / r.spacing;
  return kh * kh * ((r.consistent_inertia ? consistent_lag(r) * kh * kh : 1.0 / 6) - courant * courant / 24);
}

/// Damping ratio that the affine transfer gives the wave: a (k h)^3 / (2 C), each step the same loss, so that
/// half the step damps twice as much. With FLIP the filter takes a^2 (k h)^8 of the velocity in its time T,
/// whatever the step: a^2 (k h)^7 h / (2 T speed).
inline double numerical_damping(const Resolution& r, double speed, double frequency)
{
  const double kh = wave_number_cells(r, speed, frequency), courant = r.dt * speed / r.spacing;
  if (!r.flip) return transfer_loss * kh * kh * kh / (2 * courant);
  if (r.filter_time == 0) return 0;
  return transfer_loss * transfer_loss * std::pow(kh, 7) * r.spacing / (2 * r.filter_time * speed);
}

/// Frequency in Hz up to which the phase error is at most `share`, at Courant numbers below 1 and shares
/// above 0.01.
inline double phase_limit(const Resolution& r, double speed, double share)
{
  if (r.consistent_inertia)
  {
    const double courant = r.dt * speed / r.spacing, lead = courant * courant / 24, lag = consistent_lag(r);
    const double square = (lead + std::sqrt(lead * lead + 4 * lag * share)) / (2 * lag);
    return std::sqrt(square) / wave_number_cells(r, speed, 1);
  }
  return std::sqrt(share / phase_error(r, speed, 1));
}

/// Frequency in Hz up to which the numerical damping is at most `ratio`; infinite with FLIP and no filter.
inline double damping_limit(const Resolution& r, double speed, double ratio)
{
  return std::pow(ratio / numerical_damping(r, speed, 1), 1.0 / (r.flip ? 7 : 3));
}
} // namespace mpm
