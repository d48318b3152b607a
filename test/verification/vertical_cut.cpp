#include "test/verification/cases.hpp"
#include "test/verification/strength_reduction.hpp"

#include "io/case/units.hpp"

#include <cmath>

namespace mpm::verification
{
namespace
{
constexpr double height = 5;  // m
constexpr double exact = 3.8; // middle of the bounds of limit analysis

/// rho g H / s_u at failure.
Failure stability_number(const std::filesystem::path& folder, double spacing, const std::string& averaged)
{
  const Case case_file = load_case(folder / "case.yaml", {"grid.spacing=" + number_text(spacing) + " m",
                                                          "grid.volume_average=" + averaged});
  const auto weaken = [&](Domain& domain, double number)
  {
    auto& clay = std::get<VonMises>(domain.materials[0].law);
    clay.peak = clay.residual =
        std::sqrt(3.0) * clay.density * case_file.static_stage.gravity * height / number;
  };
  Failure found = find_failure(case_file, {3.5, 4.5, 0.04, height, 0.005, 2, weaken});
  found.curve.name = "displacement, volume change: " + averaged;
  found.curve.x_label = "rho g H / s_u";
  return found;
}
} // namespace

Findings run_vertical_cut(const std::filesystem::path& folder, double spacing)
{
  const Failure each = stability_number(folder, spacing, "none"),
                cell = stability_number(folder, spacing, "cell");
  return {{{"number", std::fabs(each.at / exact - 1)}, {"number, averaged", std::fabs(cell.at / exact - 1)}},
          {each.curve, cell.curve}};
}
} // namespace mpm::verification
