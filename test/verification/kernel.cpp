#include "test/verification/cases.hpp"

#include "solver/mpm/spline.hpp"
#include "test/domains.hpp"

namespace mpm::verification
{
namespace
{
constexpr int trials = 10000;

/// Greatest h |dN/dx - difference quotient|; the five-point formula is exact for a cubic, so it stays within
/// the cell.
double slope_error(double h)
{
  domains::Random random(12);
  const double d = 0.02;
  double worst = 0;
  for (int trial = 0; trial < trials; ++trial)
  {
    const double f = random(0.05, 0.95);
    const auto weight = [&](double at, int k) { return cubic_stencil((3 + at) * h, h).weight[k]; };
    const Stencil s = cubic_stencil((3 + f) * h, h);
    for (int k = 0; k < 4; ++k)
    {
      const double difference =
          (weight(f - 2 * d, k) - 8 * weight(f - d, k) + 8 * weight(f + d, k) - weight(f + 2 * d, k)) /
          (12 * d * h);
      worst = std::max(worst, std::fabs(difference - s.slope[k]) * h);
    }
  }
  return worst;
}

/// The four weights of the spline over the place in the cell, against its closed form.
Curve shape(double h)
{
  Curve curve{"N of one node", "distance from the node (cells)", "weight", {}, {}, {}};
  for (int step = -200; step <= 200; ++step)
  {
    const double r = 0.01 * step, a = std::fabs(r);
    const Stencil s = cubic_stencil((5 + r) * h, h);
    const int k = 5 - s.first;
    curve.x.push_back(r);
    curve.model.push_back(k >= 0 && k < 4 ? s.weight[k] : 0);
    curve.reference.push_back(a < 1 ? 0.5 * a * a * a - a * a + 2.0 / 3 : std::pow(2 - a, 3) / 6);
  }
  return curve;
}
} // namespace

Findings run_kernel(const std::filesystem::path&, double h)
{
  domains::Random random(11);
  Findings found;
  double unity = 0, place = 0, moment = 0, no_slope = 0, slope_place = 0;
  for (int trial = 0; trial < trials; ++trial)
  {
    const Stencil s = cubic_stencil(random(-100, 100) * h, h);
    double w = 0, wx = 0, wxx = 0, d = 0, dx = 0;
    for (int k = 0; k < 4; ++k)
    {
      w += s.weight[k];
      wx += s.weight[k] * s.offset[k];
      wxx += s.weight[k] * s.offset[k] * s.offset[k];
      d += s.slope[k];
      dx += s.slope[k] * s.offset[k];
    }
    unity = std::max(unity, std::fabs(w - 1));
    place = std::max(place, std::fabs(wx) / h);
    moment = std::max(moment, std::fabs(wxx / (h * h / 3) - 1));
    no_slope = std::max(no_slope, std::fabs(d) * h);
    slope_place = std::max(slope_place, std::fabs(dx - 1));
  }
  found.curves.push_back(shape(h));
  double closed_form = 0;
  for (std::size_t k = 0; k < found.curves[0].x.size(); ++k)
    closed_form = std::max(closed_form, std::fabs(found.curves[0].model[k] - found.curves[0].reference[k]));
  found.errors = {{"weights", closed_form},
                  {"unity", unity},
                  {"place", place},
                  {"moment", moment},
                  {"slopes add to 0", no_slope},
                  {"slopes of the place", slope_place},
                  {"slopes", slope_error(h)}};
  return found;
}
} // namespace mpm::verification
