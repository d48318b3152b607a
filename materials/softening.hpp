#pragma once

#include <cmath>
#include <string>

namespace mpm
{
/// Linear softening over a plastic strain, which a case gives as such or as a shear displacement delta and
/// the width l of the band that it is spread over: strain = delta / (sqrt(3) l) (paper eq. 8).
struct LinearSoftening
{
  /// Width in cells with which a band dissipates what the displacement stands for: the derivative of the
  /// cubic spline is three cells wide (cases/verification/shear_band).
  static constexpr double usual_band_cells = 3;

  double softening_displacement = NAN; ///< m
  double band_width = NAN;             ///< m
  double band_cells = NAN;             ///< the width in grid spacings, instead of band_width
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
    if (!std::isnan(band_width) && !std::isnan(band_cells))
      return "softening: give either 'band_width' (a length) or 'band_cells', not both";
    if (by_displacement)
    {
      const double cells = std::isnan(band_cells) ? usual_band_cells : band_cells;
      softening_strain =
          softening_displacement / (std::sqrt(3.0) * (std::isnan(band_width) ? cells * spacing : band_width));
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
