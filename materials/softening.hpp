#pragma once

#include "materials/parameter.hpp"

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

  /// The parameters of softening of a law L.
  template <class L>
  static constexpr std::array<Parameter<L>, 4> softening_parameters()
  {
    using D = Dimension;
    constexpr Interval positive = Interval::positive();
    return {{
        {"softening.displacement",
         "shear displacement across a band over which the strength falls to the residual one; ground that "
         "softens needs this or softening.strain",
         D::length, positive, &L::softening_displacement, "none"},
        {"softening.band_width",
         "width l of the band that turns the displacement d into a plastic strain, d / (sqrt(3) l)",
         D::length, positive, &L::band_width, "band_cells times the cell size"},
        {"softening.band_cells", "the width of the band in cells", D::none, positive, &L::band_cells, "3"},
        {"softening.strain",
         "plastic strain over which the strength falls to the residual one, without a band", D::none,
         positive, &L::softening_strain, "none"},
    }};
  }

  /// Refuses what would not be used, as `key: what` (empty: nothing). `residual`: whether a residual strength
  /// is given, `residual_key` its key.
  std::string refuse_unused(bool residual, const std::string& residual_key)
  {
    if (resolved_) return {};
    const bool by_displacement = !std::isnan(softening_displacement),
               by_strain = !std::isnan(softening_strain);
    const bool banded = !std::isnan(band_width) || !std::isnan(band_cells);
    const std::string band = std::isnan(band_width) ? "softening.band_cells" : "softening.band_width";
    if ((by_displacement || by_strain || banded) && !residual)
      return "softening: has no residual strength to soften to; give " + residual_key +
             ", or leave softening away";
    if (by_strain && banded)
      return band +
             ": turns a displacement into a strain, and 'softening.strain' is one already; leave one of "
             "them away, or give 'softening.displacement'";
    if (banded && !by_displacement)
      return band + ": turns a displacement into a strain; give 'softening.displacement' with it";
    if (by_displacement && by_strain)
      return "softening: give either 'displacement' (a length) or 'strain', not both";
    return {};
  }

  /// For a law whose residual strength is its peak.
  void resolve_no_softening()
  {
    idle_ = idle_ || (!resolved_ && !(std::isnan(softening_displacement) && std::isnan(softening_strain)));
    softening_strain = 1; // never used
    resolved_ = true;
  }

  /// Says that softening is given and has no effect (empty: it has).
  std::string idle_warning() const
  {
    return idle_ ? "softening: has no effect, since the residual strength is that of the peak" : "";
  }

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
    }
    resolved_ = true;
    if (softening_strain > least) return {};
    return "softening: is so steep that the stress would snap back (residual strain " +
           std::to_string(softening_strain) + " <= " + std::to_string(least) +
           ", the elastic strain of the strength lost); use a longer displacement, a smaller band width "
           "or a larger strain";
  }

  /// Width of the band that softens by a displacement, m; 0: a strain is given, or there is no softening.
  double band() const
  {
    return idle_ || std::isnan(softening_displacement)
               ? 0
               : softening_displacement / (std::sqrt(3.0) * softening_strain);
  }

private:
  bool resolved_ = false, idle_ = false;
};
} // namespace mpm
