#pragma once
// Von Mises plasticity integrated another way than the law does it.

#include "test/materials/point.hpp"

namespace point
{
inline double mises(const Point& p)
{
  return Deviator(p.stress[0], p.stress[1], p.stress[2], p.stress[3]).mises();
}

inline double strength(const VonMises& law, double strain)
{
  return std::max(law.peak + (law.residual - law.peak) * strain / law.softening_strain, law.residual);
}

inline std::array<double, 4> elastic_rate(const VonMises& law, const Increment& e)
{
  const double volumetric = law.lame() * (e.xx + e.yy), G = law.shear_modulus();
  return {volumetric + 2 * G * e.xx, volumetric + 2 * G * e.yy, volumetric, 2 * G * e.xy};
}

/// The rate equations of J2 plasticity with linear softening, integrated by the midpoint rule in many small
/// steps: dsigma = D : (de - 3/2 s/q dlambda), dlambda = s : D : de 3/2 / q / (3 G + H) while q is at the
/// strength.
struct RateEquations
{
  const VonMises& law;

  struct Slope
  {
    std::array<double, 4> stress;
    double strain;
  };

  Slope slope(const Point& s, const Increment& e) const
  {
    Slope result{elastic_rate(law, e), 0};
    const double q = mises(s);
    if (q < strength(law, s.strain()) * (1 - 1e-14)) return result;
    const double mean = s.mean(), G = law.shear_modulus();
    const double n[] = {1.5 * (s.stress[0] - mean) / q, 1.5 * (s.stress[1] - mean) / q,
                        1.5 * (s.stress[2] - mean) / q, 1.5 * s.stress[3] / q};
    const double loading = n[0] * result.stress[0] + n[1] * result.stress[1] + n[2] * result.stress[2] +
                           2 * n[3] * result.stress[3];
    if (loading <= 0) return result;
    const double H = s.strain() < law.softening_strain ? (law.residual - law.peak) / law.softening_strain : 0;
    result.strain = loading / (3 * G + H);
    for (int c = 0; c < 4; ++c) result.stress[c] -= 2 * G * n[c] * result.strain;
    return result;
  }

  Point move(const Point& s, const Slope& by, double share) const
  {
    Point result = s;
    for (int c = 0; c < 4; ++c) result.stress[c] += share * by.stress[c];
    result.state[0] += share * by.strain;
    return result;
  }

  /// The share in (0, 1] of the increment after which the law changes: it yields, or reaches the residual.
  double next_kink(const Point& s, const Increment& e, double left) const
  {
    const Slope now = slope(s, e);
    const bool yielding = now.strain > 0;
    if (yielding && s.strain() < law.softening_strain)
      return std::min(left, (law.softening_strain - s.strain()) / now.strain * (1 + 1e-15));
    if (yielding) return left;
    double low = 0, high = left;
    const auto above = [&](double share) { return mises(move(s, now, share)) >= strength(law, s.strain()); };
    if (!above(high)) return left;
    for (int k = 0; k < 200; ++k) (above(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
    return high;
  }

  Point operator()(Point s, const Increment& e, int steps) const
  {
    double done = 0;
    while (done < 1)
    {
      double share = std::min(1.0 / steps, 1 - done);
      if (1 - done - share < 1e-12) share = 1 - done;
      share = next_kink(s, e, share);
      const Slope first = slope(s, e);
      const Slope middle = first.strain > 0 ? slope(move(s, first, 0.5 * share), e) : first;
      s = move(s, middle.strain > 0 || first.strain == 0 ? middle : first, share);
      done += share;
      if (done > 1 - 1e-14) break;
    }
    return s;
  }
};
} // namespace point
