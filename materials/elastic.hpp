#pragma once

#include "materials/parameter.hpp"
#include "materials/plane_strain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace mpm
{
/// Gravity where a case does not say otherwise, m/s2.
inline constexpr double usual_gravity = 9.81;

/// Isotropic linear elasticity in plane strain: density in kg/m3, Young's modulus in Pa.
struct Elastic
{
  static constexpr std::string_view model = "elastic";
  double density = NAN;
  double young = NAN;
  double poisson = NAN;

  /// The parameters that every law L has.
  template <class L>
  static constexpr std::array<Parameter<L>, 3> elastic_parameters()
  {
    return {{
        {"density", "mass per volume, pore water included", Dimension::density, Interval::positive(),
         &L::density},
        {"young_modulus", "Young's modulus E", Dimension::stress, Interval::positive(), &L::young},
        {"poisson_ratio",
         "Poisson's ratio; above 0.49 costs many more steps",
         Dimension::none,
         {.lower = -1, .lower_allowed = false, .upper = 0.5, .upper_allowed = false},
         &L::poisson},
    }};
  }
  static constexpr auto parameters() { return elastic_parameters<Elastic>(); }
  static constexpr std::array<StateField, 0> state_fields() { return {}; }
  /// Parameters that are words, by default none.
  static constexpr std::array<Choice<Elastic>, 0> choices() { return {}; }

  /// What is wrong with the parameters taken together, as `key: what` (empty: nothing); fixes derived values.
  /// `spacing` is the grid's, in m.
  std::string resolve(double /*spacing*/) { return {}; }
  /// Width in m over which a band softens by its slip, see average_flow; 0: by each point's own strain.
  double averaging_length() const { return 0; }

  /// What a user should know of the parameters before a run (empty: nothing), and what speaks against them,
  /// as `key: what`.
  std::string note() const { return {}; }
  std::vector<std::string> warnings(double /*spacing*/) const { return {}; }

  /// Pressure in Pa above which the strength falls faster than the stress unloads, so that it drops at once.
  double snap_back_pressure() const { return std::numeric_limits<double>::infinity(); }

  double shear_modulus() const { return young / (2 * (1 + poisson)); }
  double lame() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
  double bulk_modulus() const { return young / (3 * (1 - 2 * poisson)); }
  double p_modulus() const { return lame() + 2 * shear_modulus(); } ///< M = K + 4G/3
  double shear_speed() const { return std::sqrt(shear_modulus() / density); }
  double pressure_speed() const { return std::sqrt(p_modulus() / density); }

  /// Stress update of a chunk; the law has no state.
  void update(const StressBatch& s, double* const* /*state*/, bool /*plastic*/) const
  {
    add_elastic_stress(s, lame(), shear_modulus());
  }

  /// Energy in J per m3 of undeformed volume that plastic flow has dissipated at point k of the state.
  double dissipated(const double* const* /*state*/, int /*k*/) const { return 0; }
};
} // namespace mpm
