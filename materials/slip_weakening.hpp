#pragma once

#include "materials/elastic.hpp"
#include "materials/plastic.hpp"

#include <limits>

namespace mpm
{
/// Elasticity with the Drucker-Prager surface sqrt(J2) = sin(phi) p, flow at constant volume, and friction
/// that weakens with the slip d (paper eqs. 7 and 8; Mizoguchi, Hirose, Shimamoto & Fukuyama, Geophys. Res.
/// Lett. 34 (2007) L01308),
///
///   mu = mu_r + (mu_p - mu_r) exp(ln(0.05) d / d_c),   d = sqrt(3) eps_s delta_s,
///
/// delta_s being the thickness of the shear zone: at d_c 5 % of the drop are left. (Eq. 7 is printed with
/// another sign in the exponent, with which friction would grow.) No cohesion; a point torn apart carries no
/// pressure until it has closed.
///
/// At constant volume in plane strain sqrt(J2) = (s1 - s3) / 2 and p = -(s1 + s3) / 2, so that a band in
/// simple shear mobilises tau / sigma_n = sin(phi), not tan(phi) (Davis, in: Lee (ed.), Soil Mechanics:
/// Selected Topics, 1968, 341-380).
struct SlipWeakening : Elastic
{
  /// How the friction coefficient becomes the angle: mc as that of a Mohr-Coulomb surface, tan(phi) = mu;
  /// plane so that the band mobilises it, sin(phi) = mu.
  enum Match : int
  {
    mc,
    plane,
  };

  static constexpr std::string_view model = "slip_weakening";
  double friction_peak = NAN, friction_residual = NAN; ///< coefficient; residual left out: no weakening
  double critical_slip = NAN;                          ///< d_c in m, after which 5 % of the drop are left
  double thickness = NAN;                              ///< delta_s in m
  int match = mc;

  static constexpr auto parameters()
  {
    using P = Parameter<SlipWeakening>;
    using D = Dimension;
    using L = SlipWeakening;
    const std::array friction{
        P{"friction.peak", "friction coefficient mu_p before any slip", D::none, Interval::not_negative(),
          &L::friction_peak},
        P{"friction.residual", "mu_r in mu = mu_r + (mu_p - mu_r) exp(ln(0.05) d / d_c) after a slip d",
          D::none, Interval::not_negative(), &L::friction_residual, "friction.peak: no weakening"},
        P{"critical_slip", "slip d_c after which 5 % of the drop in friction are left", D::length,
          Interval::positive(), &L::critical_slip, "none; required if the friction weakens"},
        P{"thickness",
          "thickness t of the shear zone, which turns plastic strain into slip, d = sqrt(3) eps t", D::length,
          Interval::positive(), &L::thickness},
    };
    return joined(elastic_parameters<L>(), friction);
  }
  static constexpr std::array<std::string_view, 2> match_names{"mc", "plane"};
  static constexpr auto choices()
  {
    return std::array{Choice<SlipWeakening>{
        "match",
        "how the coefficient becomes an angle: tan(phi) = mu (mc), of which a band in "
        "simple shear mobilises sin(phi), or sin(phi) = mu (plane), so that it mobilises mu",
        match_names, &SlipWeakening::match}};
  }
  static constexpr auto state_fields() { return flow_and_opening; }

  std::string resolve(double spacing);
  std::string note() const;
  std::vector<std::string> warnings(double spacing) const;
  double snap_back_pressure() const;
  double averaging_length() const { return weakens() ? thickness : 0; } ///< m

  /// Friction coefficient after a plastic strain, eqs. (7) and (8).
  double friction(double plastic_strain) const
  {
    if (!weakens() || plastic_strain <= 0) return friction_peak;
    return friction_residual + (friction_peak - friction_residual) * std::exp(-decay() * plastic_strain);
  }
  /// sin(phi) = tau / sigma_n on a band in simple shear, at a friction coefficient.
  double mobilised(double friction) const
  {
    return match == plane ? friction : friction / std::sqrt(1 + friction * friction);
  }

  /// Elastic trial, and a return at constant pressure to the strength of the step's end.
  void update(const StressBatch& s, double* const* state, bool plastic) const
  {
    add_elastic_stress(s, lame(), shear_modulus());
    if (plastic) return_to_surface(s, state[0], state[1], state[2]);
  }
  double dissipated(const double* const* state, int k) const { return state[2][k]; }

private:
  bool idle_ = false; ///< a critical slip is given, and the friction does not fall

  bool weakens() const { return friction_residual < friction_peak; }
  /// -d ln(mu - mu_r) / d eps_s = -ln(0.05) sqrt(3) delta_s / d_c
  double decay() const { return -std::log(0.05) * std::sqrt(3.0) * thickness / critical_slip; }
  double plastic_step(double excess_shear, double pressure, double strain) const;
  void return_to_surface(const StressBatch& s, double* strain, double* opening, double* dissipation) const;
};
} // namespace mpm
