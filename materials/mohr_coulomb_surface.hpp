#pragma once

#include <array>
#include <limits>

namespace mpm
{
/// The Mohr-Coulomb surface (s1 - s3) + (s1 + s3) sin(phi) = 2 c cos(phi) with a tension cut-off (Rankine's
/// planes s_i = limit) at one plastic strain, and the ways back to it in principal space. Stresses in Pa,
/// tension positive, in descending order.
struct MohrCoulombSurface
{
  static constexpr double unlimited = std::numeric_limits<double>::infinity();
  using Triple = std::array<double, 3>;

  double shear, bulk;    ///< moduli, Pa
  double sine, cohesive; ///< sin(phi), 2 c cos(phi)
  double dilation_sine;  ///< sin(psi), at most sin(phi)
  double apex, cutoff;   ///< mean stress at the apex; greatest principal stress, never above it

  /// Where a return ends: the stress, and what of the plastic strain is the width of cracks, which the
  /// cut-off opens in the principal directions.
  struct Returned
  {
    Triple stress;
    Triple crack{};

    double opening() const { return crack[0] + crack[1] + crack[2]; }
  };

  /// F: how far the stress is beyond the surface, Pa.
  double excess(double s1, double s3) const { return s1 - s3 + (s1 + s3) * sine - cohesive; }

  /// Return to the main plane, or to one of the two edges beside it (de Souza Neto, Peric & Owen,
  /// Computational Methods for Plasticity, Wiley 2008, section 8.2), without the cut-off. Not in order when
  /// the return leads beyond the apex.
  Triple return_to_planes(const Triple& trial) const;

  /// Return to the planes that flow at the dilation angle and to the cut-off at `limit`, whose flow is
  /// associated: a crack takes the tension across it, and leaves the other stresses what elasticity gives
  /// them. `trial` is the stress if no crack were open; the cracks returned are all that are.
  Returned return_map(const Triple& trial, double limit) const;

  /// The same for ground whose cracks have the width `opening` (sum of the three): they widen at the cut-off,
  /// close at no stress, and keep their width in between.
  Returned return_with_cracks(const Triple& trial, double opening) const;

  /// Strain whose elastic stress is `stress`.
  Triple elastic_strain(const Triple& stress) const;

private:
  Returned return_to_cutoff(const Triple& trial, double limit) const;
  Returned return_to_corner(const Triple& trial, double limit) const;
  Returned at_double_cutoff(const Triple& trial, double limit, double least) const;
  Returned at_lower_edge(const Triple& trial, double limit, double least) const;
};
} // namespace mpm
