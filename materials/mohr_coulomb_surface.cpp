#include "materials/mohr_coulomb_surface.hpp"

#include "materials/root.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace mpm
{
namespace
{
bool in_order(const std::array<double, 3>& s)
{
  return s[0] >= s[1] && s[1] >= s[2];
}
} // namespace

/// With sf = sin(phi), sp = sin(psi) and F the excess over a plane, flow x along the main plane (s1, s3)
/// changes the stress by x (-A, B, E) and F by -a x,
///
///   A = 2 G (1 + sp/3) + 2 K sp,   B = (4 G/3 - 2 K) sp,   E = 2 G (1 - sp/3) - 2 K sp,
///   a = 4 G (1 + sf sp/3) + 4 K sf sp.
///
/// If that leads out of order, two planes are active that share s1 (right edge, s2 = s3) or s3 (left edge, s1
/// = s2): [a b; b a] (x1, x2) = (F1, F2), b = 2 G (1 +- (sf + sp) - sf sp/3) + 4 K sf sp.
MohrCoulombSurface::Triple MohrCoulombSurface::return_to_planes(const Triple& trial) const
{
  const auto [s1, s2, s3] = trial;
  const double G = shear, K = bulk;
  const double sf = sine, sp = dilation_sine;
  const double a = 4 * G * (1 + sf * sp / 3) + 4 * K * sf * sp;
  const double A = 2 * G * (1 + sp / 3) + 2 * K * sp;
  const double B = (4 * G / 3 - 2 * K) * sp;
  const double E = 2 * G * (1 - sp / 3) - 2 * K * sp;
  const double main = excess(s1, s3), step = main / a;
  const Triple s{s1 - A * step, s2 + B * step, s3 + E * step};
  if (in_order(s)) return s;

  const bool right = (1 - sp) * s1 - 2 * s2 + (1 + sp) * s3 > 0;
  const double other = right ? excess(s1, s2) : excess(s2, s3);
  const double sign = right ? 1 : -1;
  const double b = 2 * G * (1 + sign * (sf + sp) - sf * sp / 3) + 4 * K * sf * sp;
  const double first = (a * main - b * other) / (a * a - b * b),
               second = (a * other - b * main) / (a * a - b * b);
  // On an edge two principal stresses are equal: the mean of both keeps them so to the last bit.
  if (right)
  {
    const double twin = 0.5 * (s2 + s3 + (B + E) * (first + second));
    return {s1 - A * (first + second), twin, twin};
  }
  const double twin = 0.5 * (s1 + s2 + (B - A) * (first + second));
  return {twin, twin, s3 + E * (first + second)};
}

/// s_dev / (2 G) + s_mean / (3 K).
MohrCoulombSurface::Triple MohrCoulombSurface::elastic_strain(const Triple& s) const
{
  const double mean = (s[0] + s[1] + s[2]) / 3, volumetric = mean / (3 * bulk);
  Triple strain;
  for (int i = 0; i < 3; ++i) strain[i] = (s[i] - mean) / (2 * shear) + volumetric;
  return strain;
}

/// Cracks alone: across the greatest stress, across two, or all round.
MohrCoulombSurface::Returned MohrCoulombSurface::return_to_cutoff(const Triple& s, double limit) const
{
  const double lame = bulk - 2 * shear / 3, stiff = lame + 2 * shear;
  const double over1 = s[0] - limit, over2 = s[1] - limit, single = over1 / stiff;
  Returned one{{limit, s[1] - lame * single, s[2] - lame * single}, {single, 0, 0}};
  if (one.stress[1] <= limit) return one;
  const double sum = (over1 + over2) / (stiff + lame), difference = (over1 - over2) / (2 * shear);
  Returned two{{limit, limit, s[2] - lame * sum}, {0.5 * (sum + difference), 0.5 * (sum - difference), 0}};
  if (two.stress[2] <= limit) return two;
  return {{limit, limit, limit}, elastic_strain({over1, over2, s[2] - limit})};
}

/// Where the cut-off meets the planes: s1 at the limit and s3 at the least that the planes allow beside it.
/// The plastic strain is that of the stress lost; what of it is shear is fixed by the direction of s3, which
/// does not crack.
MohrCoulombSurface::Returned MohrCoulombSurface::return_to_corner(const Triple& s, double limit) const
{
  const double lame = bulk - 2 * shear / 3, stiff = lame + 2 * shear;
  const double least = std::min(limit, (limit * (1 + sine) - cohesive) / (1 - sine));
  const double over1 = s[0] - limit, over3 = s[2] - least;
  const double sum = (over1 + over3) / (stiff + lame), difference = (over1 - over3) / (2 * shear);
  const double middle = s[1] - lame * sum;
  if (middle > limit) return at_double_cutoff(s, limit, least);
  if (middle < least) return at_lower_edge(s, limit, least);
  const double flow = -0.5 * (sum - difference) / (1 - dilation_sine);
  const double crack = 0.5 * (sum + difference) - (1 + dilation_sine) * flow;
  return {{limit, middle, least}, {std::max(0.0, crack), 0, 0}};
}

/// s1 and s2 at the limit. Shear flow spreads over the two directions such that the wider crack loses to it
/// first.
MohrCoulombSurface::Returned MohrCoulombSurface::at_double_cutoff(const Triple& s, double limit,
                                                                  double least) const
{
  const Triple lost = elastic_strain({s[0] - limit, s[1] - limit, s[2] - least});
  const double flow = std::max(0.0, -lost[2]) * (1 + dilation_sine) / (1 - dilation_sine);
  const double ahead = lost[0] - lost[1];
  const double first = ahead >= flow ? lost[0] - flow : 0.5 * (lost[0] + lost[1] - flow);
  const double second = ahead >= flow ? lost[1] : first;
  return {{limit, limit, least}, {std::max(0.0, first), std::max(0.0, second), std::max(0.0, lost[2])}};
}

/// s2 = s3, both at the least beside the limit.
MohrCoulombSurface::Returned MohrCoulombSurface::at_lower_edge(const Triple& s, double limit,
                                                               double least) const
{
  const Triple lost = elastic_strain({s[0] - limit, s[1] - least, s[2] - least});
  const double flow = -(lost[1] + lost[2]) * (1 + dilation_sine) / (1 - dilation_sine);
  return {{limit, least, least}, {std::max(0.0, lost[0] - flow), 0, 0}};
}

MohrCoulombSurface::Returned MohrCoulombSurface::return_map(const Triple& trial, double limit) const
{
  Triple planes = excess(trial[0], trial[2]) > 0 ? return_to_planes(trial) : trial;
  // Where all edges meet, as without strength everywhere, round-off alone may be out of order.
  const double rounding = 1e-14 * (std::fabs(trial[0]) + std::fabs(trial[2]));
  if (planes[0] >= planes[1] - rounding && planes[1] >= planes[2] - rounding)
    std::sort(planes.begin(), planes.end(), std::greater<>());
  if (in_order(planes) && planes[0] <= limit) return {planes};
  if (trial[0] > limit)
  {
    const Returned cracked = return_to_cutoff(trial, limit);
    if (excess(cracked.stress[0], cracked.stress[2]) <= 0) return cracked;
  }
  return return_to_corner(trial, limit);
}

MohrCoulombSurface::Returned MohrCoulombSurface::return_with_cracks(const Triple& trial, double opening) const
{
  if (opening <= 0) return return_map(trial, cutoff);
  const Returned closing = return_map(trial, 0);
  if (cutoff <= 0 || closing.opening() <= opening) return closing;
  const double most = std::min(cutoff, trial[0]);
  const Returned widening = return_map(trial, most);
  if (widening.opening() >= opening) return widening;
  // Falling with the tension: find that at which the cracks stay as they are.
  const auto change = [&](double tension) { return return_map(trial, tension).opening() - opening; };
  return return_map(trial, find_root({0, closing.opening() - opening}, {most, widening.opening() - opening},
                                     4e-15 * opening, change));
}
} // namespace mpm
