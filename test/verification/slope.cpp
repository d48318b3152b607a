#include "test/verification/cases.hpp"
#include "test/verification/strength_reduction.hpp"

#include "io/case/units.hpp"

#include <cmath>
#include <numbers>

namespace mpm::verification
{
namespace
{
constexpr double height = 10; // m

/// Strengths divided by the trial.
void weaken_clay(Domain& domain, const VonMises& full, double factor)
{
  auto& clay = std::get<VonMises>(domain.materials[0].law);
  clay.peak = clay.residual = full.peak / factor;
}

void weaken_soil(Domain& domain, const MohrCoulomb& full, double factor)
{
  auto& soil = std::get<MohrCoulomb>(domain.materials[0].law);
  soil.friction_peak = soil.friction_residual = std::atan(std::tan(full.friction_peak) / factor);
  soil.cohesion_peak = soil.cohesion_residual = full.cohesion_peak / factor;
}

/// Factor of safety of one of the slopes of the folder.
Failure factor_of_safety(const std::filesystem::path& path, double spacing, const std::string& averaged)
{
  const Case case_file =
      load_case(path, {"grid.spacing=" + number_text(spacing) + " m", "grid.volume_average=" + averaged});
  const Law full = case_file.materials[0].law;
  const auto weaken = [&](Domain& domain, double factor)
  {
    if (const auto* clay = std::get_if<VonMises>(&full))
      weaken_clay(domain, *clay, factor);
    else
      weaken_soil(domain, std::get<MohrCoulomb>(full), factor);
  };
  Failure found = find_failure(case_file, {1.2, 1.8, 0.02, height, 0.01, 3, weaken});
  found.curve.name = path.stem().string() + ", volume change: " + averaged;
  found.curve.x_label = "factor on the strength";
  return found;
}
} // namespace

Findings run_slope(const std::filesystem::path& folder, double spacing)
{
  const auto table = read_table(folder / "reference.csv");
  Findings found;
  for (const std::string name : {"clay", "soil"})
    for (const std::string averaged : {"none", "cell"})
    {
      const Failure failure = factor_of_safety(folder / (name + ".yaml"), spacing, averaged);
      found.errors[name + (averaged == "cell" ? ", averaged" : "")] =
          std::fabs(failure.at / table.at(name)[0] - 1);
      found.curves.push_back(failure.curve);
    }
  return found;
}
} // namespace mpm::verification
