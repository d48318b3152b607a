#pragma once
// Mohr-Coulomb ground that cracks, computed without the law's own return: what the tests of cracks compare it
// with.

#include "materials/mohr_coulomb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace point
{
using namespace mpm;
using Triple = std::array<double, 3>;

/// The law along x, y and z without any order of stresses, regions, edges or apex: six planes that shear and
/// three that crack, with the multipliers that fulfil stress = trial - D sum m_k l_k, l_k >= 0, F_k <= 0,
/// F_k l_k = 0 found one plane at a time. The trial is the stress if no crack were open, so that the
/// multipliers of the cracks are their widths.
struct NinePlanes
{
  const MohrCoulomb& law;
  double cutoff;
  Triple elastic{}, crack{}; ///< strain that is not plastic, of it what is crack

  struct Plane
  {
    Triple normal{}, flow{};
    double limit = 0, multiplier = 0;
  };

  Triple stress_of(const Triple& strain) const
  {
    const double volumetric = law.lame() * (strain[0] + strain[1] + strain[2]);
    Triple s;
    for (int i = 0; i < 3; ++i) s[i] = volumetric + 2 * law.shear_modulus() * strain[i];
    return s;
  }
  Triple stress() const
  {
    return stress_of({elastic[0] - crack[0], elastic[1] - crack[1], elastic[2] - crack[2]});
  }

  std::vector<Plane> planes() const
  {
    std::vector<Plane> result;
    const double sf = std::sin(law.friction_peak), sp = std::sin(law.dilation);
    for (int i = 0; i < 3; ++i)
    {
      Plane tension;
      tension.normal[i] = tension.flow[i] = 1;
      tension.limit = cutoff;
      result.push_back(tension);
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
      {
        if (i == j) continue;
        Plane shear;
        shear.normal[i] = 1 + sf;
        shear.normal[j] = -(1 - sf);
        shear.flow[i] = 1 + sp;
        shear.flow[j] = -(1 - sp);
        shear.limit = 2 * law.cohesion_peak * std::cos(law.friction_peak);
        result.push_back(shear);
      }
    return result;
  }

  void move(const Triple& strain)
  {
    for (int i = 0; i < 3; ++i) elastic[i] += strain[i];
    Triple s = stress_of(elastic);
    std::vector<Plane> all = planes();
    double change = 1;
    for (int sweep = 0; sweep < 100000 && change > 1e-19; ++sweep)
    {
      change = 0;
      for (Plane& plane : all)
      {
        const Triple by = stress_of(plane.flow);
        double over = -plane.limit, rate = 0;
        for (int c = 0; c < 3; ++c) over += plane.normal[c] * s[c], rate += plane.normal[c] * by[c];
        const double next = std::max(0.0, plane.multiplier + over / rate);
        for (int c = 0; c < 3; ++c) s[c] -= by[c] * (next - plane.multiplier);
        change = std::max(change, std::fabs(next - plane.multiplier));
        plane.multiplier = next;
      }
    }
    for (int i = 0; i < 3; ++i) crack[i] = all[i].multiplier;
    for (std::size_t k = 3; k < all.size(); ++k)
      for (int i = 0; i < 3; ++i) elastic[i] -= all[k].multiplier * all[k].flow[i];
  }
};
} // namespace point
