#include "io/case/units.hpp"
#include "test/verification/cases.hpp"
#include "test/verification/column.hpp"

#include <cmath>

namespace mpm::verification
{
namespace
{
struct Arrival
{
  double error = 0, second = 0;
  Curve curve;
};

/// Greatest difference from the reference, and greatest velocity after the pulse has passed, over the peak.
Arrival compare(const std::string& name, const std::vector<double>& time, const std::vector<double>& model,
                const std::vector<double>& reference)
{
  Arrival result;
  result.curve = {name, "time (s)", "surface velocity (m/s)", time, model, reference};
  double peak = 0;
  for (const double v : reference) peak = std::max(peak, std::fabs(v));
  double passed = 0;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (reference[k] != 0) passed = time[k];
  for (std::size_t k = 0; k < time.size(); ++k)
  {
    result.error = std::max(result.error, std::fabs(model.at(k) - reference[k]) / peak);
    // Numerical dispersion leaves a tail of the pulse's length; what comes later was reflected by the base.
    if (time[k] > passed + 0.12) result.second = std::max(result.second, std::fabs(model[k]) / peak);
  }
  return result;
}
} // namespace

Findings run_uniform_column(const std::filesystem::path& folder, double spacing)
{
  const auto reference = read_table(folder / "reference.csv");
  const std::vector<double>& time = reference.at("time");
  Findings findings;
  for (const std::string inertia : {"lumped", "consistent"})
  {
    std::vector<std::string> settings = inertia == "lumped" ? papers_method() : std::vector<std::string>{};
    settings.push_back("grid.spacing=" + number_text(spacing) + " m");
    const Case case_file = load_case(folder / "case.yaml", settings);
    const Trace trace = shake_column(case_file, wave_of(case_file), time.at(0));
    const std::string which = inertia == "lumped" ? "" : ", " + inertia;
    const auto compared =
        [&](const std::string& wave, const std::vector<double>& model, const std::string& column)
    {
      const Arrival arrival = compare(wave + " wave" + which, time, model, reference.at(column));
      findings.errors[wave + which] = arrival.error;
      findings.errors[wave + " second arrival" + which] = arrival.second;
      findings.curves.push_back(arrival.curve);
    };
    compared("S", trace.x, "velocity_x");
    compared("P", trace.y, "velocity_y");
  }
  return findings;
}
} // namespace mpm::verification
