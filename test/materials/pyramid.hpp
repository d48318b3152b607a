#pragma once
// The return to the Mohr-Coulomb surface found by geometry: what the tests of the law compare it with.

#include "materials/elastic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace point
{
using namespace mpm;

/// sigma = D strain of an isotropic solid, principal values.
inline std::array<double, 3> stiffness_times(const Elastic& law, const std::array<double, 3>& strain)
{
  const double volumetric = law.lame() * (strain[0] + strain[1] + strain[2]);
  std::array<double, 3> s;
  for (int i = 0; i < 3; ++i) s[i] = volumetric + 2 * law.shear_modulus() * strain[i];
  return s;
}

/// The return by geometry: all six planes of the pyramid in principal space with their flow vectors; the
/// multipliers that fulfil sigma = trial - D sum m_k l_k, l_k >= 0, F_k <= 0, F_k l_k = 0 found by projected
/// relaxation (one plane at a time), without any order of stresses, regions, edges or apex.
inline std::array<double, 3> relax_onto_pyramid(const Elastic& law, std::array<double, 3> s, double friction,
                                                double cohesion, double dilation)
{
  struct Plane
  {
    std::array<double, 3> normal, change;
    double rate, multiplier = 0;
  };
  std::vector<Plane> planes;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
    {
      if (i == j) continue;
      Plane plane{};
      std::array<double, 3> flow{};
      plane.normal[i] = 1 + std::sin(friction);
      plane.normal[j] = -(1 - std::sin(friction));
      flow[i] = 1 + std::sin(dilation);
      flow[j] = -(1 - std::sin(dilation));
      plane.change = stiffness_times(law, flow);
      for (int c = 0; c < 3; ++c) plane.rate += plane.normal[c] * plane.change[c];
      planes.push_back(plane);
    }
  double change = 1;
  for (int sweep = 0; sweep < 20000 && change > 1e-17; ++sweep)
  {
    change = 0;
    for (Plane& plane : planes)
    {
      double over = -2 * cohesion * std::cos(friction);
      for (int c = 0; c < 3; ++c) over += plane.normal[c] * s[c];
      const double next = std::max(0.0, plane.multiplier + over / plane.rate);
      for (int c = 0; c < 3; ++c) s[c] -= plane.change[c] * (next - plane.multiplier);
      change = std::max(change, std::fabs(next - plane.multiplier));
      plane.multiplier = next;
    }
  }
  return s;
}
} // namespace point
