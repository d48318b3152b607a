#include "solver/stages/boundary_reports.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
constexpr double base_drift_limit = 0.1; // cells that the base may end away from the free field
constexpr double apart_limit = 0.5;      // cells that a side and its column may end apart

/// Where the base has gone that the input did not take it, and a warning when that is more than a tenth of a
/// cell.
void report_base(Session& session, const Model& model)
{
  if (!model.base) return;
  const BaseDrift drift = model.base->drift(model.main->particles, free_field_base(model));
  const auto& [left, right] = drift.corner;
  session.log.info(
      "base at the end, relative to the free field: left end {:+.4f} m across and {:+.4f} m up, right "
      "end {:+.4f} m and {:+.4f} m, up to {:.4f} m in between; turned by {:+.2e} rad",
      left[0], left[1], right[0], right[1], drift.greatest, drift.rotation);
  const double bound = base_drift_limit * session.case_file.grid.spacing;
  const double edge = std::fabs(drift.rotation) * drift.half_length;
  if (drift.greatest <= bound && edge <= bound) return;
  session.log.warn(
      "the base has drifted: it stands up to {:.3f} m from where the input takes it ({:.3f} m at its ends "
      "by rotation), more than {} cells; give seismic.base.spring a shorter time or deepen the rock",
      drift.greatest, edge, base_drift_limit);
}
} // namespace

/// A column stands for level ground that goes on for ever. Where the side cuts a slope, the static stresses
/// of the two differ, and the side would push from the first step on.
void warn_of_unlike_columns(Session& session, const Model& model)
{
  constexpr double most = 0.1; // of the column's stress; level layers agree within a few hundredths
  for (const Edge side : both_sides)
  {
    const double mismatch = side_stress_mismatch(model, session.case_file, side);
    const std::string_view name = side_name(side);
    session.log.detail("{} side: sigma_xx differs from that of its free-field column by {:.1f} %", name,
                       100 * mismatch);
    if (mismatch > most)
      session.log.warn(
          "{} side: sigma_xx differs from that of its free-field column by {:.0f} % before the shaking; the "
          "ground is not level there: widen the domain",
          name, 100 * mismatch);
  }
}

void report_sides(Session& session, const Model& model)
{
  for (const FreeFieldSide* side : model.sides)
  {
    const double apart = side->separation(model.main->particles);
    session.log.info("{} side: ends up to {:.3f} m apart from its column", side->name(), apart);
    if (apart > apart_limit * session.case_file.grid.spacing)
      session.log.warn(
          "the {} side and its free-field column have moved {:.2f} m apart, more than half a cell: the "
          "model yields or sinks near its side; widen the domain or deepen the rock",
          side->name(), apart);
  }
}

void report_boundaries(Session& session, const Model& model)
{
  report_base(session, model);
  report_sides(session, model);
  // Ground that yields in its column yields everywhere beyond: no failure of the slope, and worth knowing.
  for (const Edge side : both_sides)
  {
    const FreeFieldColumn* column = model.column(side);
    if (!column) continue;
    double greatest = 0;
    for (const Material& material : column->domain->materials)
      if (!material.state.empty())
        for (const double strain : material.state[0]) greatest = std::max(greatest, strain);
    if (greatest > 0)
      session.log.info("{} yields: plastic strain up to {:.2e}", column->domain->name, greatest);
  }
}
} // namespace mpm
