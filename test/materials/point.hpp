#pragma once
// A material point on its own, led along strain paths.

#include "materials/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace point
{
using namespace mpm;

struct Increment
{
  double xx = 0, yy = 0, xy = 0;
};

/// Stress (xx, yy, zz, xy in Pa), history variables and volume over the undeformed one.
struct Point
{
  std::array<double, 4> stress{};
  std::array<double, 6> state{}; ///< plastic strain, opening, dissipation in J/m3, tensor of the opening
  double ratio = 1;

  double strain() const { return state[0]; }
  double opening() const { return state[1]; }
  double dissipation() const { return state[2]; }
  double mean() const { return (stress[0] + stress[1] + stress[2]) / 3; }
  double shear() const { return std::sqrt(Deviator(stress[0], stress[1], stress[2], stress[3]).j2()); }
  /// In descending order.
  std::array<double, 3> principal() const
  {
    const double centre = 0.5 * (stress[0] + stress[1]);
    const double radius = std::hypot(0.5 * (stress[0] - stress[1]), stress[3]);
    std::array<double, 3> s{centre + radius, centre - radius, stress[2]};
    std::sort(s.begin(), s.end(), std::greater<>());
    return s;
  }
};

/// One step, of which the stress has made the rotation. The volume follows the logarithm of the strain.
template <class L>
Point update(const L& law, Point p, const Increment& e, bool plastic = true, double cosine = 1,
             double sine = 0)
{
  double* state[] = {&p.state[0], &p.state[1], &p.state[2], &p.state[3], &p.state[4], &p.state[5]};
  p.ratio *= std::exp(e.xx + e.yy);
  const double mass = law.density;
  const StressBatch batch{1,     &p.stress[0], &p.stress[1], &p.stress[2], &p.stress[3], &e.xx,
                          &e.yy, &e.xy,        &mass,        &p.ratio,     &cosine,      &sine};
  law.update(batch, state, plastic);
  return p;
}

inline double distance(const Point& a, const Point& b)
{
  double result = 0;
  for (int c = 0; c < 4; ++c) result = std::max(result, std::fabs(a.stress[c] - b.stress[c]));
  return result;
}

/// Leads a point along exx(t), eyy given by keeping sigma_yy at `held` (bisection on eyy in each step), or
/// eyy too.
template <class L>
Point hold_yy(const L& law, const Point& from, double exx, double exy, double held)
{
  double low = -1e-2, high = 1e-2;
  for (int k = 0; k < 100; ++k)
  {
    const double middle = 0.5 * (low + high);
    (update(law, from, {exx, middle, exy}).stress[1] > held ? high : low) = middle;
  }
  return update(law, from, {exx, 0.5 * (low + high), exy});
}
} // namespace point
