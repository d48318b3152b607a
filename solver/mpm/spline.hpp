#pragma once

#include "solver/mpm/simd.hpp"

#include <cmath>

namespace mpm
{
/// Cubic B-spline stencil of a point in one direction: nodes first .. first + 3, weights N, derivatives dN/dx
/// in 1/m and offsets x_i - x in m (METHODS section 1).
struct Stencil
{
  int first;
  Row weight, slope, offset;
};

/// Stencil of the point x on nodes at i * spacing (m); `inverse` is 1 / spacing.
inline Stencil cubic_stencil(double x, double spacing, double inverse)
{
  const double local = x * inverse, cell = std::floor(local);
  const double f = local - cell, g = 1 - f;
  // The outer splines are cubes, so that small weights keep their relative accuracy; the third is what the
  // others leave of one, so that no momentum is lost on average.
  const Row t{g, f, g, f};
  Row weight = Row{0, 2.0 / 3, 0, 0} + t * t * (t * Row{1.0 / 6, 0.5, 0, 1.0 / 6} - Row{0, 1, 0, 0});
  weight[2] = (1 - weight[1]) - (weight[0] + weight[3]);
  const Row slope = inverse * t * (t * Row{-0.5, 1.5, -1.5, 0.5} + Row{0, -2, 2, 0});
  const Row offset = spacing * (Row{-1, 0, 1, 2} - f);
  return {static_cast<int>(cell) - 1, weight, slope, offset};
}

inline Stencil cubic_stencil(double x, double spacing)
{
  return cubic_stencil(x, spacing, 1 / spacing);
}
} // namespace mpm
