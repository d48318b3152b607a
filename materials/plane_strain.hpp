#pragma once

#include <cmath>
#include <string_view>

namespace mpm
{
/// A stretch of consecutive particles of one law: Cauchy stress (Pa, tension positive, updated in place), the
/// strain increment of the step (engineering shear is 2 exy), and mass (kg/m) and volume after it (m3/m).
struct StressBatch
{
  int count;
  double* __restrict xx;
  double* __restrict yy;
  double* __restrict zz;
  double* __restrict xy;
  const double* __restrict exx;
  const double* __restrict eyy;
  const double* __restrict exy;
  const double* __restrict mass;
  const double* __restrict volume;
};

/// sigma += D : de in plane strain (ezz = 0), lame and shear modulus in Pa. Not inlined, so that every law
/// that begins with it rounds alike.
[[gnu::noinline]] inline void add_elastic_stress(const StressBatch& s, double lame, double shear)
{
#pragma GCC ivdep
  for (int i = 0; i < s.count; ++i)
  {
    const double volumetric = lame * (s.exx[i] + s.eyy[i]);
    s.xx[i] += volumetric + 2 * shear * s.exx[i];
    s.yy[i] += volumetric + 2 * shear * s.eyy[i];
    s.zz[i] += volumetric;
    s.xy[i] += 2 * shear * s.exy[i];
  }
}

/// Mises stress q = sqrt(3 J2) in Pa.
inline double mises_stress(double xx, double yy, double zz, double xy)
{
  const double p = (xx + yy + zz) / 3;
  const double a = xx - p, b = yy - p, c = zz - p;
  return std::sqrt(1.5 * (a * a + b * b + c * c + 2 * xy * xy));
}
} // namespace mpm
