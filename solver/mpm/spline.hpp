#pragma once

#include <array>
#include <cmath>

namespace mpm
{
/// Cubic B-spline stencil of a point in one direction: nodes first .. first+3, weights N, derivatives
/// dN/dx in 1/m and offsets x_i - x in m (METHODS section 1).
struct Stencil
{
  int first;
  std::array<double, 4> weight;
  std::array<double, 4> slope;
  std::array<double, 4> offset;
};

/// Values of the four cubic B-splines over a cell at the local coordinate f in [0, 1), nodes -1 .. 2. The
/// outer ones are written as cubes, so that small weights keep their relative accuracy.
inline void cubic_weights(double f, double& w0, double& w1, double& w2, double& w3)
{
  const double g = 1 - f;
  w0 = g * g * g * (1.0 / 6);
  w1 = (2.0 / 3) + f * f * (0.5 * f - 1);
  w3 = f * f * f * (1.0 / 6);
  w2 = (1 - w1) - (w0 + w3); // 2/3 - g^2 + g^3/2, rounded so that no momentum is lost on average
}

/// Derivatives of the four cubic B-splines with respect to f.
inline void cubic_slopes(double f, double& s0, double& s1, double& s2, double& s3)
{
  const double g = 1 - f;
  s0 = -0.5 * g * g;
  s1 = f * (1.5 * f - 2);
  s2 = -g * (1.5 * g - 2);
  s3 = 0.5 * f * f;
}

/// Stencil of the point x on nodes at i * spacing.
inline Stencil cubic_stencil(double x, double spacing)
{
  const double inverse = 1 / spacing;
  const double cell = std::floor(x * inverse);
  const double f = x * inverse - cell;
  Stencil s;
  s.first = static_cast<int>(cell) - 1;
  cubic_weights(f, s.weight[0], s.weight[1], s.weight[2], s.weight[3]);
  cubic_slopes(f, s.slope[0], s.slope[1], s.slope[2], s.slope[3]);
  for (int k = 0; k < 4; ++k)
  {
    s.slope[k] *= inverse;
    s.offset[k] = (k - 1 - f) * spacing;
  }
  return s;
}
} // namespace mpm
