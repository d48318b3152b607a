#include "test/verification/cases.hpp"
#include "test/verification/column.hpp"

#include "io/case/units.hpp"
#include "solver/mpm/spline.hpp"

#include <cmath>
#include <numbers>

namespace mpm::verification
{
namespace
{
constexpr double every = 0.002;  // s, of the histories
constexpr double frequency = 5;  // Hz: S waves of 43 m
constexpr double half_width = 4; // m: the load is spread as 1 + cos(pi x / half_width)
constexpr double force = 1;      // N per m

/// A vertical load on the ground surface around x = 0, a Ricker wavelet in time.
class SurfaceLoad final : public Boundary
{
public:
  explicit SurfaceLoad(double height) : height_(height) {}
  void add_forces(Domain& domain, double dt) override
  {
    Grid& g = domain.grid;
    const double a = std::pow(std::numbers::pi * (frequency * (domain.time + 0.5 * dt) - 1), 2);
    const double now = force * (1 - 2 * a) * std::exp(-a), step = 0.25 * g.spacing;
    const Stencil sy = cubic_stencil(height_ - g.origin_y, g.spacing);
    for (double x = -half_width + 0.5 * step; x < half_width; x += step)
    {
      const Stencil sx = cubic_stencil(x - g.origin_x, g.spacing);
      const double share = step / (2 * half_width) * (1 + std::cos(std::numbers::pi * x / half_width));
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          if (const int node = g.node(sx.first + i, sy.first + j); node >= 0)
            g.force_y[node] -= now * share * sx.weight[i] * sy.weight[j];
    }
  }

private:
  double height_;
};

/// Velocity of a gauge, m/s; entry k is at (k + 1) every.
struct History
{
  std::vector<double> x, y;
};

double greatest_difference(const History& a, const History& b)
{
  double greatest = 0;
  for (std::size_t k = 0; k < a.x.size(); ++k)
    greatest = std::max(greatest, std::hypot(a.x[k] - b.x.at(k), a.y[k] - b.y.at(k)));
  return greatest;
}

double peak(const History& a)
{
  double greatest = 0;
  for (std::size_t k = 0; k < a.x.size(); ++k) greatest = std::max(greatest, std::hypot(a.x[k], a.y[k]));
  return greatest;
}

std::vector<History> load_surface(const Case& case_file, const std::vector<GaugePoint>& gauges)
{
  Model model = make_model(case_file);
  for (const GaugePoint& gauge : gauges)
    model.main->gauges.push_back({gauge.x, gauge.y, gauge.x, gauge.y, 0, 0});
  add_seismic_boundaries(model, case_file, std::make_shared<IncomingWave>(), false);
  model.main->boundaries.push_back(std::make_unique<SurfaceLoad>(case_file.ground_height(0)));
  const double dt = step_dividing(every, case_file.courant_number, *model.main);
  const long stride = std::lround(every / dt), samples = std::lround(case_file.seismic.duration / every);
  std::vector<History> histories(gauges.size());
  for (long k = 0; k < samples * stride; ++k)
  {
    advance(model, k * dt, dt);
    if ((k + 1) % stride != 0) continue;
    for (std::size_t g = 0; g < gauges.size(); ++g)
    {
      histories[g].x.push_back(model.main->gauges[g].velocity_x);
      histories[g].y.push_back(model.main->gauges[g].velocity_y);
    }
  }
  return histories;
}
} // namespace

Findings run_line_load(const std::filesystem::path& folder, double spacing)
{
  const auto table = read_table(folder / "reference.csv");
  const Case small = case_at(folder, spacing);
  const Case large = load_case(folder / "case.yaml", {"grid.spacing=" + number_text(spacing) + " m",
                                                      "domain.x=[-80 m, 80 m]", "domain.bottom=-80 m"});
  const auto& gauges = small.output.gauges.points;
  const std::vector<History> near = load_surface(small, gauges), far = load_surface(large, gauges);
  Findings findings{{{"box", 0}, {"echo", 0}}, {}};
  for (std::size_t g = 0; g < gauges.size(); ++g)
  {
    const std::string& name = gauges[g].name;
    const History reference{table.at(name + "_small_x"), table.at(name + "_small_y")};
    const History open{table.at(name + "_large_x"), table.at(name + "_large_y")};
    const double echo = greatest_difference(near[g], far[g]) / peak(far[g]),
                 known = greatest_difference(reference, open) / peak(open);
    double &box = findings.errors["box"], &more = findings.errors["echo"];
    box = std::max(box, greatest_difference(near[g], reference) / peak(reference));
    more = std::max(more, std::fabs(echo - known));
    findings.curves.push_back(
        {name, "time (s)", "vertical velocity (m/s)", table.at("time"), near[g].y, reference.y});
  }
  return findings;
}
} // namespace mpm::verification
