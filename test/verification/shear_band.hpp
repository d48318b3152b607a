#pragma once

#include "materials/von_mises.hpp"

namespace mpm::verification
{
/// What a softening band in a shear box dissipates, per m2 of band.
struct BandEnergy
{
  double slip;       ///< imposed, m
  double dissipated; ///< J/m2, measured over the middle half of the band
  double softening;  ///< of it, what is above the residual strength's: dissipated - tau_r (slip - elastic
                     ///< slip), J/m2
  double expected;   ///< of that, (tau_p - tau_r) delta_r / 2, J/m2
};

/// A square box of the law, 12 m wide, whose rim moves as two rigid halves that slide past each other along a
/// line through the middle, inclined to the grid by `degrees`. The law's softening is by displacement.
/// Plane-strain shear strengths are q / sqrt(3).
BandEnergy shear_band(VonMises law, double degrees, double spacing, double slip);
} // namespace mpm::verification
