#include "test/verification/cases.hpp"
#include "test/verification/column.hpp"

#include "solver/mpm/step.hpp"

#include <cmath>
#include <numbers>

namespace mpm::verification
{
namespace
{
constexpr double slope = 14 * std::numbers::pi / 180;
constexpr double sole = 2;        // m, upper face of the clay
constexpr double every = 0.02;    // s, of the reference
constexpr double noticed = 0.005; // m: slip at which a block has been triggered

/// Acceleration of the base along the slope, m/s2: five cycles of 1 Hz from 1 s on, under a smooth envelope.
double shaking(double t)
{
  if (t < 1 || t > 6) return 0;
  return 5 * std::pow(std::sin(std::numbers::pi * (t - 1) / 5), 2) * std::sin(2 * std::numbers::pi * (t - 1));
}

/// Displacement along the slope of the block's sole: the row above the clay.
double displacement(const FreeFieldColumn& column)
{
  const Particles& p = column.domain->particles;
  const int k = column.particle_of_row(column.row_near(sole + 0.25 * column.domain->grid.spacing));
  return p.x[k] - p.reference_x[k];
}

/// First time at which the slip passes `noticed`, by straight lines.
double trigger(const std::vector<double>& time, const std::vector<double>& slip)
{
  for (std::size_t k = 1; k < slip.size(); ++k)
    if (slip[k] > noticed) return time[k] - every * (slip[k] - noticed) / (slip[k] - slip[k - 1]);
  return NAN;
}
} // namespace

Findings run_sliding_block(const std::filesystem::path& folder, double spacing)
{
  const auto table = read_table(folder / "reference.csv");
  const Case case_file = case_at(folder, spacing);
  Model model = make_model(case_file);
  add_static_boundaries(model, case_file);
  FreeFieldColumn& column = *model.left;
  Domain& domain = *column.domain;
  const double dt = step_dividing(every, case_file.courant_number, domain);
  const long stride = std::lround(every / dt);
  const double gravity = case_file.static_stage.gravity;
  // The slope at rest: stress along it from its weight, and no stress across, which the clay's strength does
  // not feel.
  long k = 0;
  for (; k * dt < 1.5; ++k)
  {
    const double s = std::min(1.0, k * dt / 1.0);
    domain.settings.gravity_x = gravity * std::sin(slope) * s * s * s * (10 + s * (6 * s - 15));
    column.advance(k * dt, dt);
  }
  domain.settings.local_damping = 0;
  set_transfer(domain.settings, case_file.seismic);
  const double rest = displacement(column);
  Curve curve{"slip", "time (s)", "slip (m)", table.at("time"), {}, table.at("slip")};
  for (long n = 0; n < static_cast<long>(curve.x.size()) * stride; ++n)
  {
    domain.settings.gravity_x = gravity * std::sin(slope) + shaking((n + 0.5) * dt);
    column.advance((k + n) * dt, dt);
    if ((n + 1) % stride == 0) curve.model.push_back(displacement(column) - rest);
  }
  const double slip = curve.reference.back();
  return {{{"slip", std::fabs(curve.model.back() / slip - 1)},
           {"trigger", std::fabs(trigger(curve.x, curve.model) - trigger(curve.x, curve.reference))}},
          {curve}};
}
} // namespace mpm::verification
