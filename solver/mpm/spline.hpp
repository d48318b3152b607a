#pragma once
// Cubic B-splines, the shape functions. With xi = (x - x_i) / h,
//
//   N = |xi|^3 / 2 - xi^2 + 2/3   for |xi| < 1,     N = (2 - |xi|)^3 / 6   for 1 <= |xi| < 2,
//
// so that a point in cell i touches the four nodes i - 1 to i + 2 of each direction. For any x, sum N = 1,
// sum N (x_i - x) = 0 and sum N (x_i - x)^2 = h^2 / 3: the D of APIC is h^2 / 3 times the unit tensor, the
// 3 / h^2 of the paper's eq. (3).

#include "solver/mpm/simd.hpp"

#include <cmath>

namespace mpm
{
/// Cubic B-splines of a node (double) or of the four around a point (Row), times what makes their
/// coefficients whole numbers: rounded thirds and sixths would take a little momentum in every step.
template <class Value>
struct Spline
{
  Value weight; ///< 6 N
  Value slope;  ///< 2 h dN/dx
  Value moment; ///< 6 N (x_i - x) / h
};
inline constexpr double spline_weight = 6, spline_slope = 2;

/// The splines of the nodes around a point at the fraction f of its cell. Nodes -1 to 2 stand at xi = f + 1,
/// f, f - 1 and f - 2; with g = f for the second and fourth and g = 1 - f for the first and third
///
///   6 N = g^3, 3 g^3 - 6 g^2 + 4 (outer and inner nodes),     2 h dN/dx = +-g^2, +-(3 g^2 - 4 g).
///
/// `of` picks one node's coefficient or the row of all four. The outer weights are cubes, so that small ones
/// keep their relative accuracy.
template <class Value, class Pick>
[[gnu::always_inline]] inline Spline<Value> cubic_spline(const Value& f, const Pick& of)
{
  using Four = const double[4];
  static constexpr Four side{-1, 1, -1, 1}, start{1, 0, 1, 0}, position{-1, 0, 1, 2};
  static constexpr Four cubic{1, 3, 3, 1}, square{0, -6, -6, 0}, constant{0, 4, 4, 0};
  static constexpr Four slope_square{-1, 3, -3, 1}, slope_linear{0, -4, 4, 0};
  const Value g = f * of(side) + of(start);
  const Value weight = g * g * (g * of(cubic) + of(square)) + of(constant);
  return {weight, g * (g * of(slope_square) + of(slope_linear)), weight * (of(position) - f)};
}

/// Of all four nodes.
[[gnu::always_inline]] inline Spline<Row> cubic_spline(double f)
{
  return cubic_spline(f - Row{}, [](const double* all) { return load_as<Row>(all); });
}

/// Of all four nodes around each of two points.
[[gnu::always_inline]] inline Spline<Pairs> cubic_spline(double f, double g)
{
  return cubic_spline(both(f, g), [](const double* all) { return both(all); });
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
  const Spline<Row> s = cubic_spline(f);
  return {static_cast<int>(cell) - 1, (1 / spline_weight) * s.weight,
          (1 / (spline_slope * spacing)) * s.slope, spacing * (Row{-1, 0, 1, 2} - f)};
}
} // namespace mpm
