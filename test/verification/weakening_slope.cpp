#include "test/domains.hpp"
#include "test/verification/cases.hpp"
#include "test/verification/infinite_slope.hpp"

#include <cmath>

namespace mpm::verification
{
namespace
{
constexpr double thickness = 2; // m, of the layer

InfiniteSlope slope_at(double spacing, bool flip)
{
  InfiniteSlope slope{domains::slip_weakening(0.4, 0.1, 0.5, thickness)};
  slope.spacing = spacing;
  slope.zone_cells = static_cast<int>(std::lround(thickness / spacing));
  slope.flip = flip;
  if (flip) slope.filter = usual_filter;
  return slope;
}

void compare(Findings& findings, const std::string& name, const InfiniteSlope& slope,
             Slide (&run)(const InfiniteSlope&), Slide (&reference)(const InfiniteSlope&))
{
  const Slide found = run(slope), wanted = reference(slope);
  findings.errors["slip" + name] = std::fabs(found.slip / wanted.slip - 1);
  findings.errors["trigger" + name] = std::fabs(found.trigger - wanted.trigger);
}
} // namespace

Findings run_weakening_slope(const std::filesystem::path&, double spacing)
{
  Findings findings;
  compare(findings, "", slope_at(spacing, true), slide, elastic_block);
  compare(findings, ", APIC", slope_at(spacing, false), slide, elastic_block);
  return findings;
}

Findings run_finite_block(const std::filesystem::path&, double spacing)
{
  Findings findings;
  compare(findings, "", slope_at(spacing, true), slide_finite, rigid_block);
  compare(findings, ", APIC", slope_at(spacing, false), slide_finite, rigid_block);
  return findings;
}
} // namespace mpm::verification
