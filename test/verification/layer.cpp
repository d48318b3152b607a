#include "test/verification/cases.hpp"
#include "test/verification/column.hpp"

#include "io/case/units.hpp"

#include <cmath>

namespace mpm::verification
{
namespace
{
constexpr double every = 0.01; // s; what the pulse holds above 90 Hz folds back below 10 Hz, and is nothing

/// Amplification |surface / outcrop| of the case's column in one direction at the reference's frequencies;
/// the error is the greatest difference over the greatest value.
Findings amplify(const Case& case_file, const std::filesystem::path& folder)
{
  const auto reference = read_table(folder / "reference.csv");
  const auto wave = wave_of(case_file);
  const Trace trace = shake_column(case_file, wave, every);
  const bool shear = wave->horizontal.has_value();
  const std::vector<double>& surface = shear ? trace.x : trace.y;
  std::vector<double> outcrop;
  for (std::size_t k = 0; k < surface.size(); ++k)
    outcrop.push_back(2 * wave->velocity((k + 1) * every)[shear ? 0 : 1]);
  Curve curve{"amplification",
              "frequency (Hz)",
              "surface / outcrop",
              reference.at("frequency"),
              {},
              reference.at("amplification")};
  double error = 0, greatest = 0;
  for (std::size_t k = 0; k < curve.x.size(); ++k)
  {
    curve.model.push_back(std::abs(transform(surface, every, every, curve.x[k]) /
                                   transform(outcrop, every, every, curve.x[k])));
    error = std::max(error, std::fabs(curve.model[k] - curve.reference[k]));
    greatest = std::max(greatest, curve.reference[k]);
  }
  return {{{"amplification", error / greatest}}, {curve}};
}
} // namespace

Findings run_site(const std::filesystem::path& folder, double spacing)
{
  return amplify(case_at(folder, spacing), folder);
}

Findings run_layer_paper(const std::filesystem::path& folder, double spacing)
{
  const auto error = [&](const std::string& site)
  {
    std::vector<std::string> settings = papers_method();
    settings.push_back("grid.spacing=" + number_text(spacing) + " m");
    return amplify(load_case(folder / site / "case.yaml", settings), folder / site)
        .errors.at("amplification");
  };
  return {{{"one layer", error("../layer")}, {"two layers", error("../two_layers")}}, {}};
}

Findings run_layer_courant(const std::filesystem::path& folder, double courant)
{
  const Case case_file =
      load_case(folder / "../layer/case.yaml", {"time_step.courant_number=" + number_text(courant)});
  return amplify(case_file, folder / "../layer");
}
} // namespace mpm::verification
