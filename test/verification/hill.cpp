#include "test/verification/cases.hpp"
#include "test/verification/column.hpp"

#include "io/case/units.hpp"
#include "solver/stages/interfaces.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::verification
{
namespace
{
constexpr double every = 0.005; // s, of the reference

/// Velocities of a place, m/s; entry k is at (k + 1) every.
struct History
{
  std::vector<double> x, y;
};

/// Velocities of the case's gauges by name, from stress-free ground.
std::map<std::string, History> shake_gauges(const Case& case_file, long samples)
{
  Model model = make_model(case_file);
  const auto& gauges = case_file.output.gauges.points;
  for (const GaugePoint& gauge : gauges)
  {
    const double y = std::min(gauge.y, case_file.ground_height(gauge.x));
    model.main->gauges.push_back({gauge.x, y, gauge.x, gauge.y, 0, 0, kink_at(case_file, gauge.x, y)});
  }
  add_seismic_boundaries(model, case_file, wave_of(case_file), false);
  const double dt = step_dividing(every, case_file.courant_number, *model.main);
  const long stride = std::lround(every / dt);
  std::map<std::string, History> histories;
  for (long k = 0; k < samples * stride; ++k)
  {
    advance(model, k * dt, dt);
    if ((k + 1) % stride != 0) continue;
    for (std::size_t g = 0; g < gauges.size(); ++g)
    {
      histories[gauges[g].name].x.push_back(model.main->gauges[g].velocity_x);
      histories[gauges[g].name].y.push_back(model.main->gauges[g].velocity_y);
    }
  }
  return histories;
}

/// Root of the summed squares of the difference over that of the reference, both directions.
double difference(const History& found, const History& reference)
{
  double apart = 0, all = 0;
  for (std::size_t k = 0; k < reference.x.size(); ++k)
  {
    apart += std::pow(found.x[k] - reference.x[k], 2) + std::pow(found.y[k] - reference.y[k], 2);
    all += std::pow(reference.x[k], 2) + std::pow(reference.y[k], 2);
  }
  return std::sqrt(apart / all);
}

/// |v| at the crest over frequency; the finest that 26 cells a wave carry at h = 1 m is 3.5 Hz.
Curve crest_spectrum(const History& found, const History& reference)
{
  Curve curve{"spectrum of the crest", "frequency (Hz)", "velocity (m/s / Hz)", {}, {}, {}};
  for (double f = 0.5; f < 3.51; f += 0.1)
  {
    curve.x.push_back(f);
    curve.model.push_back(std::abs(transform(found.x, every, every, f)));
    curve.reference.push_back(std::abs(transform(reference.x, every, every, f)));
  }
  return curve;
}

double greatest_relative_difference(const Curve& curve)
{
  double greatest = 0;
  for (std::size_t k = 0; k < curve.x.size(); ++k)
    greatest = std::max(greatest, std::fabs(curve.model[k] / curve.reference[k] - 1));
  return greatest;
}

/// The case of a folder against its reference.
Findings compare(const Case& case_file, const std::filesystem::path& folder)
{
  const auto table = read_table(folder / "reference.csv");
  const std::vector<double>& time = table.at("time");
  const auto found = shake_gauges(case_file, static_cast<long>(time.size()));
  Findings findings;
  double surface = 0, within = 0;
  for (const auto& [name, history] : found)
  {
    const History reference{table.at(name + "_x"), table.at(name + "_y")};
    const double apart = difference(history, reference);
    double& worst = name == "interface" || name == "rock" ? within : surface;
    worst = std::max(worst, apart);
    findings.errors[name] = apart;
    findings.curves.push_back({name, "time (s)", "horizontal velocity (m/s)", time, history.x, reference.x});
    if (name == "crest") findings.curves.push_back(crest_spectrum(history, reference));
    if (name == "crest") findings.errors["spectrum"] = greatest_relative_difference(findings.curves.back());
  }
  findings.errors["surface"] = surface;
  findings.errors["within"] = within;
  return findings;
}
} // namespace

Findings run_hill(const std::filesystem::path& folder, double spacing)
{
  return compare(case_at(folder, spacing), folder);
}

Findings run_hill_paper(const std::filesystem::path& folder, double spacing)
{
  std::vector<std::string> settings = papers_method();
  settings.push_back("grid.spacing=" + number_text(spacing) + " m");
  return compare(load_case(folder / "../hill/case.yaml", settings), folder / "../hill");
}
} // namespace mpm::verification
