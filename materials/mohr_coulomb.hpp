#pragma once

#include "materials/elastic.hpp"
#include "materials/plastic.hpp"
#include "materials/principal.hpp"
#include "materials/softening.hpp"

#include <limits>
#include <numbers>

namespace mpm
{
/// Elasticity with the Mohr-Coulomb surface (s1 - s3) + (s1 + s3) sin(phi) = 2 c cos(phi), plastic flow at
/// the dilation angle and a tension cut-off. Cohesion and friction angle soften linearly from peak to
/// residual over the plastic strain delta / (sqrt(3) l), l the band width. A point torn apart carries no
/// pressure until it has closed. Angles in rad, stresses in Pa, tension positive.
struct MohrCoulomb : Elastic, LinearSoftening
{
  static constexpr std::string_view model = "mohr_coulomb";
  double friction_peak = NAN, friction_residual = NAN; ///< angle; residual left out: the peak's
  double cohesion_peak = NAN, cohesion_residual = NAN;
  double dilation = 0;               ///< angle; the friction angle where that is less
  double tension_cutoff = unlimited; ///< greatest principal stress; never above c cot(phi)

  static constexpr auto parameters()
  {
    using P = Parameter<MohrCoulomb>;
    using D = Dimension;
    using L = MohrCoulomb;
    constexpr double right_angle = 0.5 * std::numbers::pi;
    return std::array{
        P{"density", D::density, &L::density, 0, false},
        P{"young_modulus", D::stress, &L::young, 0, false},
        P{"poisson_ratio", D::none, &L::poisson, -1, false, 0.5, false},
        P{"friction_angle.peak", D::angle, &L::friction_peak, 0, true, right_angle, false},
        P{"friction_angle.residual", D::angle, &L::friction_residual, 0, true, right_angle, false, false},
        P{"cohesion.peak", D::stress, &L::cohesion_peak, 0, true},
        P{"cohesion.residual", D::stress, &L::cohesion_residual, 0, true, unlimited, true, false},
        P{"dilation_angle", D::angle, &L::dilation, 0, true, right_angle, false, false},
        P{"tension_cutoff", D::stress, &L::tension_cutoff, 0, true, unlimited, true, false},
        P{"softening.displacement", D::length, &L::softening_displacement, 0, false, unlimited, true, false},
        P{"softening.band_width", D::length, &L::band_width, 0, false, unlimited, true, false},
        P{"softening.band_cells", D::none, &L::band_cells, 0, false, unlimited, true, false},
        P{"softening.strain", D::none, &L::softening_strain, 0, false, unlimited, true, false},
    };
  }
  static constexpr auto state_fields() { return flow_and_opening; }

  std::string resolve(double spacing);
  std::string note() const;

  /// Elastic trial, and an exact return of the points beyond the surface; the strengths are those of the
  /// step's beginning.
  void update(const StressBatch& s, double* const* state, bool plastic) const
  {
    add_elastic_stress(s, lame(), shear_modulus());
    if (plastic) return_to_surface(s, state[0], state[1], state[2]);
  }
  double dissipated(const double* const* state, int k) const { return state[2][k]; }

private:
  static constexpr double unlimited = std::numeric_limits<double>::infinity();
  /// The surface at one plastic strain.
  struct Surface
  {
    double sine, cohesive; ///< sin(phi), 2 c cos(phi)
    double apex, cutoff;   ///< mean stress at the apex, greatest principal stress

    double excess(double s1, double s3) const { return s1 - s3 + (s1 + s3) * sine - cohesive; }
  };
  /// Returned principal stresses, and by how much the mean stress fell at the apex or the cut-off.
  struct Returned
  {
    std::array<double, 3> value;
    double torn = 0;
  };

  bool softens() const { return friction_peak != friction_residual || cohesion_peak != cohesion_residual; }
  /// `softened`: share of the way from peak (0) to residual (1 and more).
  Surface surface(double softened) const;
  /// `before`: mean of the trial stress.
  Returned return_map(const std::array<double, 3>& trial, double before, const Surface& at) const;
  std::array<double, 3> return_to_planes(const std::array<double, 3>& trial, const Surface& at) const;
  void return_to_surface(const StressBatch& s, double* strain, double* opening, double* dissipation) const;
};
} // namespace mpm
