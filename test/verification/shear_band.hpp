#pragma once

#include "materials/von_mises.hpp"

namespace mpm::verification
{
/// Where a shear band runs.
enum class BandPosition
{
  within_cells, ///< along the middle of a row of cells
  on_nodes,     ///< along a row of nodes
};

/// By what a band softens.
enum class Softening
{
  averaged, ///< its slip, over the width of the law (average_flow); the transfer is FLIP
  local     ///< each particle's own strain; the transfer is APIC
};

/// What a softening band in a shear box dissipates, per m2 of band.
struct BandEnergy
{
  double slip;      ///< plastic, m
  double softening; ///< dissipated above the residual strength, in the middle of the band, J/m2
  double dilation;  ///< greatest change of a particle's volume there, over its volume
};

/// A square box of the law, 24 cells or more wide, whose rim moves as two rigid halves that slide past each
/// other by `slip` (m) along a line through the middle, inclined to the grid by `degrees`. The law's
/// softening is by displacement.
BandEnergy shear_band(VonMises law, double degrees, BandPosition position, double spacing, double slip,
                      Softening softening);

/// (tau_p - tau_r) delta_r / 2 in J/m2, tau = q / sqrt(3) in plane strain: what the softening displacement
/// stands for.
double softening_energy(const VonMises& law);

/// The same band in closed form, in J/m2: velocity jumps from one row of nodes to the next (within cells) or
/// in equal parts over two (on nodes), so that the shear strain follows the cubic spline's derivative, a
/// quadratic spline, or the mean of two of them, and every row of particles, two a cell, softens by its own.
double spline_band_energy(VonMises law, BandPosition position, double spacing, double slip);
} // namespace mpm::verification
