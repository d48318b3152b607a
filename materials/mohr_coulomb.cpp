#include "materials/mohr_coulomb.hpp"

#include <cstdio>

namespace mpm
{
std::string MohrCoulomb::resolve(double spacing)
{
  if (std::isnan(friction_residual)) friction_residual = friction_peak;
  if (std::isnan(cohesion_residual)) cohesion_residual = cohesion_peak;
  if (friction_residual > friction_peak)
    return "friction_angle.residual: is above friction_angle.peak; give at most the peak";
  if (cohesion_residual > cohesion_peak)
    return "cohesion.residual: is above cohesion.peak; give at most the peak";
  if (dilation > friction_peak)
    return "dilation_angle: is above friction_angle.peak, which would create energy; give at most the peak";
  if (softens())
    return resolve_softening(spacing,
                             (cohesion_peak - cohesion_residual) / (std::sqrt(3.0) * shear_modulus()));
  softening_strain = 1; // never used
  return {};
}

std::string MohrCoulomb::note() const
{
  const auto line = [](double friction, double cohesion)
  {
    std::array<char, 80> text;
    std::snprintf(text.data(), text.size(), "%.3f sigma_n + %.4g kPa", std::sin(friction),
                  1e-3 * cohesion * std::cos(friction));
    return std::string(text.data());
  };
  std::string text =
      "at constant volume it slides in simple shear at tau = " + line(friction_peak, cohesion_peak);
  if (softens())
    text += ", from a plastic strain of " + std::to_string(softening_strain) + " on at " +
            line(friction_residual, cohesion_residual);
  return text;
}

MohrCoulomb::Surface MohrCoulomb::surface(double softened) const
{
  const double t = softens() ? std::min(softened, 1.0) : 0;
  const double friction = friction_peak + t * (friction_residual - friction_peak);
  const double cohesion = cohesion_peak + t * (cohesion_residual - cohesion_peak);
  const double sine = std::sin(friction), cosine = std::cos(friction);
  const double apex = sine > 0 ? cohesion * cosine / sine : unlimited;
  return {sine, 2 * cohesion * cosine, apex, std::min(apex, tension_cutoff)};
}

/// Return to the main plane, or to one of the two edges beside it (de Souza Neto, Peric & Owen 2008,
/// section 8.2). The result is not in order when the return leads beyond the apex.
std::array<double, 3> MohrCoulomb::return_to_planes(const std::array<double, 3>& trial,
                                                    const Surface& at) const
{
  const auto [s1, s2, s3] = trial;
  const double G = shear_modulus(), K = bulk_modulus();
  const double sf = at.sine, sp = std::min(std::sin(dilation), sf);
  const double a = 4 * G * (1 + sf * sp / 3) + 4 * K * sf * sp;
  const double A = 2 * G * (1 + sp / 3) + 2 * K * sp;
  const double B = (4 * G / 3 - 2 * K) * sp;
  const double E = 2 * G * (1 - sp / 3) - 2 * K * sp;
  const double main = at.excess(s1, s3), step = main / a;
  std::array<double, 3> s{s1 - A * step, s2 + B * step, s3 + E * step};
  if (s[0] >= s[1] && s[1] >= s[2]) return s;

  const bool right = (1 - sp) * s1 - 2 * s2 + (1 + sp) * s3 > 0;
  const double other = right ? at.excess(s1, s2) : at.excess(s2, s3);
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

MohrCoulomb::Returned MohrCoulomb::return_map(const std::array<double, 3>& trial, double before,
                                              const Surface& at) const
{
  Returned result{trial};
  std::array<double, 3>& s = result.value;
  const auto mean = [&] { return (s[0] + s[1] + s[2]) / 3; };
  if (at.excess(s[0], s[2]) > 0)
  {
    bool beyond = dilation == 0 && before >= at.apex;
    if (!beyond)
    {
      s = return_to_planes(trial, at);
      beyond = s[0] < s[1] || s[1] < s[2] || mean() >= at.apex;
    }
    if (beyond)
    {
      const double apex = at.apex < unlimited ? at.apex : before; // without friction or cohesion: round-off
      s = {apex, apex, apex};
      result.torn = std::max(0.0, before - apex);
    }
  }
  if (s[0] <= at.cutoff) return result;
  const double uncut = mean();
  for (double& value : s) value = std::min(value, at.cutoff);
  if (mean() >= 0) result.torn += uncut - mean();
  return result;
}

void MohrCoulomb::return_to_surface(const StressBatch& s, double* __restrict strain,
                                    double* __restrict opening, double* __restrict dissipation) const
{
  const Surface peak = surface(0), residual = surface(1);
  const double G = shear_modulus(), K = bulk_modulus(), end = softens() ? softening_strain : unlimited;
  // Points between peak and residual are always looked at closely: their strength costs a sine.
  const auto excess = [&](int k)
  {
    const double centre = 0.5 * (s.xx[k] + s.yy[k]), half = 0.5 * (s.xx[k] - s.yy[k]);
    const double radius = std::sqrt(half * half + s.xy[k] * s.xy[k]);
    const double high = std::max(centre + radius, s.zz[k]), low = std::min(centre - radius, s.zz[k]);
    const bool soft = strain[k] >= end;
    const double sine = soft ? residual.sine : peak.sine, cohesive = soft ? residual.cohesive : peak.cohesive;
    const double cutoff = soft ? residual.cutoff : peak.cutoff;
    const double over = std::max(high - low + (high + low) * sine - cohesive, high - cutoff);
    const bool between = (strain[k] > 0) & (strain[k] < end) & (end < unlimited);
    return between | (opening[k] > 0) ? 1.0 : over;
  };
  const auto settle = [&](int k)
  {
    const double share = strain[k] / end;
    const Surface at = share <= 0 ? peak : share >= 1 ? residual : surface(share);
    Principal p = principal_stresses(s.xx[k], s.yy[k], s.zz[k], s.xy[k]);
    const double elastic = p.mean(), closed = close_opening(elastic, K, opening[k]);
    if (closed != elastic)
      for (double& value : p.value) value += closed - elastic;
    else if (at.excess(p.value[0], p.value[2]) <= 0 && p.value[0] <= at.cutoff)
      return;

    const std::array<double, 3> trial = p.value;
    const Returned returned = return_map(trial, closed, at);
    p.value = returned.value;
    const double fall = closed - p.mean();
    double square = 0, work = 0;
    for (int i = 0; i < 3; ++i)
    {
      const double deviator = (trial[i] - p.value[i] - fall) / (2 * G);
      square += deviator * deviator;
      work += p.value[i] * (deviator + fall / (3 * K));
    }
    strain[k] += std::sqrt(2.0 / 3 * square);
    opening[k] += returned.torn / K;
    dissipation[k] += work * volume_ratio(s, k, density);
    const auto [xx, yy, zz, xy] = turn_back(p);
    s.xx[k] = xx;
    s.yy[k] = yy;
    s.zz[k] = zz;
    s.xy[k] = xy;
  };
  for_each_beyond(s.count, excess, settle);
}
} // namespace mpm
