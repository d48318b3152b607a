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
  const Case scene = scene_at(folder, spacing);
  const auto reference = read_table(folder / "reference.csv");
  const std::vector<double>& time = reference.at("time");
  const Trace trace = shake_column(scene, wave_of(scene), time.at(0));
  const Arrival s = compare("S wave", time, trace.x, reference.at("velocity_x"));
  const Arrival p = compare("P wave", time, trace.y, reference.at("velocity_y"));
  return {{{"S", s.error}, {"S second arrival", s.second}, {"P", p.error}, {"P second arrival", p.second}},
          {s.curve, p.curve}};
}
} // namespace mpm::verification
