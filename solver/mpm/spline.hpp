#pragma once

#include "solver/mpm/simd.hpp"

#include <cmath>

namespace mpm
{
/// Cubic B-splines of the four nodes around a point at the fraction f of its cell, and their derivatives over
/// the cell's width (METHODS section 1).
struct CubicWeights
{
  double weight[4], slope[4];
};

[[gnu::always_inline]] inline CubicWeights cubic_weights(double f)
{
  const double g = 1 - f;
  // The outer splines are cubes, so that small weights keep their relative accuracy; the third is what the
  // others leave of one, so that no momentum is lost on average.
  const double first = g * g * (g * (1.0 / 6)), last = f * f * (f * (1.0 / 6));
  const double second = 2.0 / 3 + f * f * (0.5 * f - 1);
  return {{first, second, (1 - second) - (first + last), last},
          {-0.5 * g * g, f * (1.5 * f - 2), g * (2 - 1.5 * g), 0.5 * f * f}};
}

/// Stencil of a point in one direction: nodes first .. first + 3, weights N, derivatives dN/dx in 1/m and
/// offsets x_i - x in m.
struct Stencil
{
  int first;
  Row weight, slope, offset;
};

/// Stencil of the point x on nodes at i * spacing (m).
inline Stencil cubic_stencil(double x, double spacing)
{
  const double local = x / spacing, cell = std::floor(local), f = local - cell;
  const CubicWeights w = cubic_weights(f);
  return {static_cast<int>(cell) - 1, load_row(w.weight), load_row(w.slope) / spacing,
          spacing * (Row{-1, 0, 1, 2} - f)};
}
} // namespace mpm
