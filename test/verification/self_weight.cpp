#include "test/verification/cases.hpp"
#include "test/verification/column.hpp"

#include <cmath>

namespace mpm::verification
{
namespace
{
/// Gravity grows smoothly, then the column settles under local damping.
void settle(Model& model, const Case& case_file)
{
  add_static_boundaries(model, case_file);
  Domain& column = *model.left->domain;
  const double dt = step_of(case_file.courant_number, column);
  for (int k = 0; k * dt < case_file.static_stage.until.at_most; ++k)
  {
    const double s = std::min(1.0, k * dt / case_file.static_stage.ramp);
    column.settings.gravity_y = -case_file.static_stage.gravity * s * s * s * (10 + s * (6 * s - 15));
    model.left->advance(k * dt, dt);
  }
}

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at)
{
  const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
  const std::size_t k = above - x.begin();
  return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1]);
}
} // namespace

Findings run_self_weight(const std::filesystem::path& folder, double spacing)
{
  const Case case_file = case_at(folder, spacing);
  const auto reference = read_table(folder / "reference.csv");
  const std::vector<double>&height = reference.at("height"), &stress = reference.at("stress_yy"),
        &settlement = reference.at("settlement");
  Model model = make_model(case_file);
  settle(model, case_file);
  const Particles& p = model.left->domain->particles;
  const double poisson = case_file.materials[0].elastic().poisson;
  Curve vertical{"vertical stress", "height (m)", "stress (Pa)", {}, {}, {}};
  Curve sunk{"settlement", "height (m)", "settlement (m)", {}, {}, {}};
  double stress_error = 0, settlement_error = 0, lateral_error = 0;
  for (int row = 0; row < model.left->rows(); ++row)
  {
    const int k = model.left->particle_of_row(row);
    const double y = p.reference_y[k];
    // The reference is tabulated finely enough (5 cm) that its chords err by 1e-7 of the greatest value.
    for (Curve* curve : {&vertical, &sunk}) curve->x.push_back(y);
    vertical.model.push_back(p.stress_yy[k]);
    vertical.reference.push_back(interpolate(height, stress, y));
    sunk.model.push_back(y - p.y[k]);
    sunk.reference.push_back(interpolate(height, settlement, y));
    settlement_error = std::max(settlement_error, std::fabs(sunk.model.back() - sunk.reference.back()));
    lateral_error =
        std::max(lateral_error, std::fabs(p.stress_xx[k] - poisson / (1 - poisson) * p.stress_yy[k]));
    if (row + 1 < model.left->rows())
      stress_error = std::max(stress_error, std::fabs(vertical.model.back() - vertical.reference.back()));
  }
  const double weight = std::fabs(stress.front()); // at height 0
  return {{{"stress", stress_error / weight},
           {"settlement", settlement_error / settlement.back()},
           {"lateral stress", lateral_error / weight}},
          {vertical, sunk}};
}
} // namespace mpm::verification
