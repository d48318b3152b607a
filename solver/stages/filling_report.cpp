#include "solver/stages/filling_report.hpp"

#include "io/common/error.hpp"

#include <fmt/format.h>

namespace mpm
{
namespace
{
constexpr double area_off = 0.05;  // share of a region's area that may be lost or gained unsaid
constexpr double length_off = 0.1; // share of its length over which it may be lost unsaid

std::string name_of(const Case& case_file, std::size_t region)
{
  const Region& r = case_file.regions[region];
  const std::string& material = case_file.materials[r.material].name;
  return r.location.empty() ? fmt::format("regions[{}] ({})", region, material)
                            : fmt::format("{} ({})", r.location, material);
}

/// Cell size with which a layer has a particle, rounded down to two digits.
double spacing_for(const Case& case_file, double thickness)
{
  const double h = 2 * thickness * case_file.grid.particles_per_cell;
  const double unit = std::pow(10, std::floor(std::log10(h)) - 1);
  return std::floor(h / unit * (1 + 1e-9)) * unit;
}

/// The refusal of a region that is drawn and has no particle, with cells that would give it one.
std::string lost_wholly(const Case& case_file, std::size_t region, const Drawn& drawn)
{
  const double thickness = drawn.area / drawn.length;
  return fmt::format("{}: {:.4g} m2 are drawn, {:.3g} m thick and {:.4g} m long, and no particle stands for "
                     "them: a layer needs "
                     "half a particle spacing, {:.3g} m, in x and in y; make it thicker, leave it out, or "
                     "take grid.spacing {:.2g} m",
                     name_of(case_file, region), drawn.area, thickness, drawn.length,
                     0.5 * case_file.grid.particle_spacing(),
                     spacing_for(case_file, std::min(thickness, drawn.length)));
}

/// Particles come in whole columns and layers in whole particles, so that small regions differ from their
/// drawing, and thin ones vanish over a part of their length.
void warn_of_differences(Log& log, const Case& case_file, std::size_t region, const Drawn& drawn,
                         const RegionFilling& got)
{
  const double off = got.area / drawn.area - 1;
  std::string lost;
  if (got.lost.length > 0)
    lost = fmt::format(
        "; over {:.4g} m of its {:.4g} m, between x = {:.4g} m and {:.4g} m, it is thinner than half a "
        "particle spacing and has none",
        got.lost.length, got.lost.length + got.filled.length, got.lost.from, got.lost.to);
  const bool interrupted = got.lost.length > length_off * (got.lost.length + got.filled.length);
  if (std::fabs(off) <= area_off && !interrupted) return;
  log.warn("{}: its particles have {:.4g} m2 where {:.4g} m2 are drawn ({:+.1f} %){}; use smaller cells",
           name_of(case_file, region), got.area, drawn.area, 100 * off, lost);
}

/// The spline of a particle reaches two cells, so that the two sides of a thin layer share nodes and hold
/// each other (cases/verification/sliding_block measures by how much).
void warn_of_thinness(Log& log, const Case& case_file, std::size_t region, const RegionFilling& got)
{
  // Across a layer: cases/verification, sliding_block and weakening_slope.
  const double least = case_file.seismic.transfer == Transfer::flip ? 3 : 4;
  const Material& material = case_file.materials[case_file.regions[region].material];
  const double cells = got.thickness / case_file.grid.spacing;
  if (material.state_fields().empty() || cells >= least * (1 - 1e-9)) return;
  log.warn("{}: can yield, and its layer is {:.2g} cells thick in the mean: across less than {:.0f} the "
           "sides of a "
           "layer reach and hold each other, so that it slips too late and too little; use smaller cells or "
           "a thicker "
           "layer",
           name_of(case_file, region), cells, least);
}

/// A compliant base carries the ground above it by the faces of its lowest particles: where there are none,
/// ground that comes there has nothing to lie on.
void warn_of_bare_base(Log& log, const Case& case_file, const Span& bare)
{
  if (bare.length == 0 || case_file.seismic.duration == 0 || case_file.seismic.base == BaseKind::fixed)
    return;
  log.warn("regions: no ground lies on the base over {:.4g} m, between x = {:.4g} m and {:.4g} m: ground "
           "that comes "
           "there falls out of the model; let a layer cover the base, or take seismic.base.kind fixed",
           bare.length, bare.from, bare.to);
}
} // namespace

void report_filling(Log& log, const Case& case_file, const Filling& filling)
{
  const std::vector<Drawn> drawn = drawn_regions(case_file);
  const double particle = case_file.grid.particle_spacing() * case_file.grid.particle_spacing();
  std::string lost;
  for (std::size_t k = 0; k < drawn.size(); ++k)
  {
    const RegionFilling& got = filling.regions[k];
    if (got.area > 0 && drawn[k].area > 0)
    {
      warn_of_differences(log, case_file, k, drawn[k], got);
      warn_of_thinness(log, case_file, k, got);
    }
    else if (drawn[k].area >= particle / 2)
      lost += (lost.empty() ? "" : "\n") + lost_wholly(case_file, k, drawn[k]);
    else if (drawn[k].area > 0)
      log.warn("{}: is smaller than half a particle, {:.2g} m2, and has none", name_of(case_file, k),
               drawn[k].area);
  }
  if (!lost.empty()) throw Error(exit_code::bad_input, lost);
  warn_of_bare_base(log, case_file, filling.bare);
}
} // namespace mpm
