#pragma once

#include <array>
#include <cmath>

namespace mpm
{
/// Principal stresses of a plane-strain stress, s1 >= s2 >= s3 (Pa, tension positive), one of which is zz,
/// and what it takes to turn them back.
struct Principal
{
  std::array<double, 3> value;
  int out_of_plane;    ///< which of the three is zz
  double cosine, sine; ///< of twice the angle from x to the direction of the greater in-plane stress

  double mean() const { return (value[0] + value[1] + value[2]) / 3; }
};

inline Principal principal_stresses(double xx, double yy, double zz, double xy)
{
  const double centre = 0.5 * (xx + yy), half = 0.5 * (xx - yy), radius = std::sqrt(half * half + xy * xy);
  const double high = centre + radius, low = centre - radius;
  // Below round-off of the stress there is no direction; any will do.
  const bool round = radius <= 1e-15 * (std::fabs(xx) + std::fabs(yy));
  Principal p{{}, zz >= high ? 0 : zz >= low ? 1 : 2, round ? 1 : half / radius, round ? 0 : xy / radius};
  if (p.out_of_plane == 0)
    p.value = {zz, high, low};
  else if (p.out_of_plane == 1)
    p.value = {high, zz, low};
  else
    p.value = {high, low, zz};
  return p;
}

/// Stress (xx, yy, zz, xy) with these principal values in the directions they came from.
inline std::array<double, 4> turn_back(const Principal& p)
{
  const double high = p.value[p.out_of_plane == 0 ? 1 : 0], low = p.value[p.out_of_plane == 2 ? 1 : 2];
  const double centre = 0.5 * (high + low), radius = 0.5 * (high - low);
  return {centre + radius * p.cosine, centre - radius * p.cosine, p.value[p.out_of_plane], radius * p.sine};
}

/// Normal components of a tensor (xx, yy, zz, xy) along the principal directions of another.
inline std::array<double, 3> components_along(const Principal& p, double xx, double yy, double zz, double xy)
{
  const double centre = 0.5 * (xx + yy), turned = 0.5 * (xx - yy) * p.cosine + xy * p.sine;
  const double high = centre + turned, low = centre - turned;
  if (p.out_of_plane == 0) return {zz, high, low};
  if (p.out_of_plane == 1) return {high, zz, low};
  return {high, low, zz};
}
} // namespace mpm
