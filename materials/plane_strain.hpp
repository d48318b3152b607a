#pragma once

#include <cmath>
#include <string_view>

namespace mpm
{
/// Consecutive particles of one law: Cauchy stress (Pa, tension positive, updated in place), the
/// strain increment of the step (engineering shear is 2 exy), mass (kg/m) and volume after it (m3/m), and
/// cosine and sine of the step's rotation, which the stress has made already.
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
  const double* __restrict cosine;
  const double* __restrict sine;
};

/// sigma += lambda tr(de) 1 + 2 G de in plane strain (de_zz = 0), lambda and G in Pa. Not inlined, so that
/// every law that begins with it rounds alike.
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

/// A stress as its mean and deviator, Pa.
struct Deviator
{
  double mean, xx, yy, zz, xy;

  Deviator(double sxx, double syy, double szz, double sxy)
      : mean((sxx + syy + szz) * (1.0 / 3)), xx(sxx - mean), yy(syy - mean), zz(szz - mean), xy(sxy)
  {
  }
  /// Of point k of a batch.
  Deviator(const StressBatch& s, int k) : Deviator(s.xx[k], s.yy[k], s.zz[k], s.xy[k]) {}
  double j2() const { return 0.5 * (xx * xx + yy * yy + zz * zz) + xy * xy; }
  /// Mises stress q = sqrt(3 J2) in Pa.
  double mises() const { return std::sqrt(3 * j2()); }
};
} // namespace mpm
