#pragma once
// Lines y(x) of a case, which bound its ground.

#include <string>
#include <variant>
#include <vector>

namespace mpm
{
/// Straight lines between points of growing x, level beyond the first and the last; m.
struct Polyline
{
  std::vector<double> x, y; ///< as many of each; x grows

  double height(double at) const;
  double area(double from, double to) const; ///< integral of the height in m2
};

/// base + rise exp(-((x - centre) / width)^2), on one side if asked, level at full height on the other; m.
struct GaussianHill
{
  /// The side of the centre on which the hill falls.
  enum class Side
  {
    both,
    right,
    left,
  };
  double base = 0, rise = 0;    ///< heights of the lower level, and of the top above it
  double centre = 0, width = 1; ///< x of the top, and the distance over which e^-1 of the rise is left
  Side side = Side::both;

  double height(double at) const;
  double area(double from, double to) const; ///< integral of the height in m2
};

/// A named line y(x) of a case. An offset surface is the shape it is measured from, and `up`.
struct Surface
{
  std::string name; ///< its key in the case
  std::variant<Polyline, GaussianHill> shape;
  double up = 0; ///< m

  double height(double x) const; ///< m
  /// Exact mean over [from, to], in m.
  double mean_height(double from, double to) const;
};
} // namespace mpm
