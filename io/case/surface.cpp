// Heights, and areas below them. A column of cells is filled to the mean height over its width, so that the
// ground has the volume that the case draws whatever the cells.

#include "io/case/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mpm
{
// Between two points y = y_0 + (y_1 - y_0) s with s from 0 to 1; beyond the ends the last height.
double Polyline::height(double at) const
{
  const auto next = std::upper_bound(x.begin(), x.end(), at) - x.begin();
  if (next == 0) return y.front();
  if (next == static_cast<std::ptrdiff_t>(x.size())) return y.back();
  const double s = (at - x[next - 1]) / (x[next] - x[next - 1]);
  return y[next - 1] + s * (y[next] - y[next - 1]);
}

// Trapezoids from kink to kink, which is exact.
double Polyline::area(double from, double to) const
{
  double sum = 0, left = from;
  for (auto kink = std::upper_bound(x.begin(), x.end(), from); left < to; ++kink)
  {
    const double right = kink == x.end() ? to : std::min(*kink, to);
    sum += (right - left) * (height(left) + height(right)) / 2;
    if (kink == x.end()) break;
    left = right;
  }
  return sum;
}

double GaussianHill::height(double at) const
{
  const double s = (at - centre) / width;
  const bool level = (side == Side::right && s < 0) || (side == Side::left && s > 0);
  return base + (level ? rise : rise * std::exp(-s * s));
}

// int exp(-s^2) ds = sqrt(pi)/2 erf(s); the level side is a rectangle.
double GaussianHill::area(double from, double to) const
{
  // Split at the centre, where a one-sided hill changes.
  const double middle = std::clamp(centre, from, to);
  const auto bell = [&](double a, double b)
  {
    return rise * width * std::sqrt(std::numbers::pi) / 2 *
           (std::erf((b - centre) / width) - std::erf((a - centre) / width));
  };
  const double left = side == Side::right ? rise * (middle - from) : bell(from, middle);
  const double right = side == Side::left ? rise * (to - middle) : bell(middle, to);
  return base * (to - from) + left + right;
}

double Surface::height(double x) const
{
  return up + std::visit([&](const auto& s) { return s.height(x); }, shape);
}

double Surface::mean_height(double from, double to) const
{
  return up + std::visit([&](const auto& s) { return s.area(from, to); }, shape) / (to - from);
}
} // namespace mpm
