#pragma once

#include "materials/elastic.hpp"
#include "materials/mohr_coulomb_surface.hpp"
#include "materials/plastic.hpp"
#include "materials/principal.hpp"
#include "materials/softening.hpp"

#include <numbers>

namespace mpm
{
/// What Mohr-Coulomb ground remembers of a point. The tensor is the strain of its cracks; out of the plane it
/// is what the opening has more than xx and yy.
inline constexpr std::array<StateField, 6> flow_and_cracks{
    {flow_and_opening[0],
     flow_and_opening[1],
     flow_and_opening[2],
     {"opening_xx", "1", "strain by which the point is torn apart along x"},
     {"opening_yy", "1", "strain by which the point is torn apart along y"},
     {"opening_xy", "1", "shear strain of what is torn apart"}}};

/// Elasticity with the Mohr-Coulomb surface (s1 - s3) + (s1 + s3) sin(phi) = 2 c cos(phi), plastic flow at
/// the dilation angle and a tension cut-off. Cohesion and friction angle soften linearly from peak to
/// residual over the plastic strain delta / (sqrt(3) l), l the band width; the strength is that of the step's
/// end. A crack that the cut-off has opened carries no stress and closes at the strain at which it opened, in
/// its direction. Ground that opens at its apex only, since there is neither a lower cut-off nor softening,
/// opens all round and carries no pressure until its volume has closed. Angles in rad, stresses in Pa,
/// tension positive.
struct MohrCoulomb : Elastic, LinearSoftening
{
  static constexpr std::string_view model = "mohr_coulomb";
  double friction_peak = NAN, friction_residual = NAN; ///< angle; residual left out: the peak's
  double cohesion_peak = NAN, cohesion_residual = NAN;
  double dilation = 0;               ///< angle; the friction angle where that is less
  double tension_cutoff = unlimited; ///< greatest principal stress; never above c cot(phi at the peak)

  static constexpr auto parameters()
  {
    using P = Parameter<MohrCoulomb>;
    using D = Dimension;
    using L = MohrCoulomb;
    constexpr Interval acute{.lower = 0, .upper = 0.5 * std::numbers::pi, .upper_allowed = false};
    constexpr Interval not_negative = Interval::not_negative();
    const std::array strength{
        P{"friction_angle.peak", "phi in (s1 - s3) + (s1 + s3) sin(phi) = 2 c cos(phi), tension positive",
          D::angle, acute, &L::friction_peak},
        P{"friction_angle.residual", "friction angle after softening", D::angle, acute, &L::friction_residual,
          "friction_angle.peak: it stays"},
        P{"cohesion.peak", "cohesion c", D::stress, not_negative, &L::cohesion_peak},
        P{"cohesion.residual", "cohesion after softening", D::stress, not_negative, &L::cohesion_residual,
          "cohesion.peak: it stays"},
        P{"dilation_angle", "dilation angle of the plastic flow; the friction angle where that is less",
          D::angle, acute, &L::dilation, "0 deg"},
        P{"tension_cutoff", "greatest principal stress, beyond which the ground cracks across it", D::stress,
          not_negative, &L::tension_cutoff, "c cot(phi), the apex of the surface, and never more"},
    };
    return joined(elastic_parameters<L>(), strength, softening_parameters<L>());
  }
  static constexpr auto state_fields() { return flow_and_cracks; }

  double averaging_length() const { return band(); } ///< m
  std::string resolve(double spacing);
  std::string note() const;
  std::vector<std::string> warnings(double spacing) const;
  double snap_back_pressure() const;

  /// Elastic trial, and an exact return of the points beyond the surface.
  void update(const StressBatch& s, double* const* state, bool plastic) const
  {
    add_elastic_stress(s, lame(), shear_modulus());
    if (plastic) return_to_surface(s, state);
  }
  double dissipated(const double* const* state, int k) const { return state[2][k]; }

private:
  using Surface = MohrCoulombSurface;
  using Triple = Surface::Triple;
  static constexpr double unlimited = Surface::unlimited;
  /// The steepest fall of the strength tau = p sin(phi) + c cos(phi) from peak to residual, at pressure p.
  struct Fall
  {
    double cohesive, frictional; ///< Pa at no pressure, and per Pa of it

    double at(double pressure) const { return cohesive + frictional * pressure; }
  };
  Fall fall() const;
  /// The state of one point.
  struct PointState
  {
    double &strain, &opening, &dissipation, &opening_xx, &opening_yy, &opening_xy;
  };

  bool softens() const { return friction_peak != friction_residual || cohesion_peak != cohesion_residual; }
  /// `softened`: share of the way from peak (0) to residual (1 and more).
  Surface surface(double softened) const;
  /// The surface after a plastic strain.
  Surface surface_after(double strain) const { return surface(softens() ? strain / softening_strain : 0); }
  void return_to_surface(const StressBatch& s, double* const* state) const;
  void settle_whole(const StressBatch& s, int k, const PointState& at, const Surface& surface) const;
  void settle_cracked(const StressBatch& s, int k, const PointState& at) const;
  Surface::Returned soften(const Triple& trial, const Triple& cracks, const PointState& at,
                           double& strain) const;
};
} // namespace mpm
