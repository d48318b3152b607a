#pragma once

#include <cmath>
#include <string>

namespace mpm
{
/// Linear softening over a plastic strain, which a case gives as such or as a shear displacement delta and
/// the width l of the band that it is spread over: strain = delta / (sqrt(3) l) (paper eq. 8).
struct LinearSoftening
{
  double softening_displacement = NAN; ///< m
  double band_width = NAN;             ///< m, by default 1.45 grid spacings
  double softening_strain = NAN;       ///< plastic strain at which the residual strength is reached

  /// Fixes the softening strain. `least`: strain at which the strength falls as fast as the stress unloads;
  /// softening has to be slower. Returns what is wrong, as `key: what` (empty: nothing).
  std::string resolve_softening(double spacing, double least)
  {
    const bool by_displacement = !std::isnan(softening_displacement);
    const bool by_strain = !std::isnan(softening_strain);
    if (by_displacement == by_strain && !(by_displacement && resolved_))
      return "softening: give either 'displacement' (a length) or 'strain', since the residual strength is "
             "below the peak";
    if (by_displacement)
    {
      if (std::isnan(band_width)) band_width = 1.45 * spacing;
      softening_strain = softening_displacement / (std::sqrt(3.0) * band_width);
      resolved_ = true;
    }
    if (softening_strain > least) return {};
    return "softening: is so steep that the stress would snap back (residual strain " +
           std::to_string(softening_strain) + " <= " + std::to_string(least) +
           ", the elastic strain of the strength lost); use a longer displacement or a smaller band width";
  }

private:
  bool resolved_ = false;
};
} // namespace mpm
