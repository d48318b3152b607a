#include "test/domains.hpp"
#include "test/verification/cases.hpp"
#include "test/verification/infinite_slope.hpp"

#include <cmath>

namespace mpm::verification
{
namespace
{
constexpr double thickness = 2; // m, of the layer

InfiniteSlope slope_at(double spacing, double flip_blend)
{
  InfiniteSlope slope{domains::slip_weakening(0.4, 0.1, 0.5, thickness)};
  slope.spacing = spacing;
  slope.zone_cells = static_cast<int>(std::lround(thickness / spacing));
  slope.flip_blend = flip_blend;
  return slope;
}

void compare(Findings& findings, const std::string& name, const InfiniteSlope& slope,
             Slide (&run)(const InfiniteSlope&))
{
  const Slide found = run(slope), wanted = rigid_block(slope);
  findings.errors["slip" + name] = std::fabs(found.slip / wanted.slip - 1);
  findings.errors["trigger" + name] = std::fabs(found.trigger - wanted.trigger);
}
} // namespace

Findings run_weakening_slope(const std::filesystem::path&, double spacing)
{
  Findings findings;
  compare(findings, "", slope_at(spacing, 0), slide);
  compare(findings, ", FLIP 0.9", slope_at(spacing, 0.9), slide);
  return findings;
}

Findings run_finite_block(const std::filesystem::path&, double spacing)
{
  Findings findings;
  compare(findings, ", FLIP 0.9", slope_at(spacing, 0.9), slide_finite);
  compare(findings, ", FLIP 0.99", slope_at(spacing, 0.99), slide_finite);
  return findings;
}
} // namespace mpm::verification
