#include "test/verification/cases.hpp"

#include "io/case/units.hpp"
#include "solver/mpm/step.hpp"
#include "solver/stages/model.hpp"

#include <cmath>
#include <numbers>

namespace mpm::verification
{
namespace
{
constexpr double width = 2;               // m, of the whole footing
constexpr double final_settlement = 0.02; // m
constexpr double speed = 1e-4;            // of the footing over that of S waves
constexpr double exact = 2 + std::numbers::pi;

/// A rough rigid footing: nodes on and above the ground surface below x = width / 2 go down at `velocity`,
/// m/s. The plane x = 0 of symmetry is a mirror, where nodes carry twice their half; the images beyond it go
/// down as well.
class Footing final : public Boundary
{
public:
  void bind(const Domain& domain) override
  {
    nodes_.clear();
    const Grid& g = domain.grid;
    const int surface = static_cast<int>(std::lround(-g.origin_y / g.spacing));
    const int edge = static_cast<int>(std::lround(0.5 * width / g.spacing));
    for (int j = surface; j <= surface + 3; ++j)
      for (int i = -2; i <= edge; ++i)
        if (const int node = g.node(i, j); node >= 0)
          nodes_.push_back({node, i < 0 ? 0.0 : i == 0 ? 0.5 : 1.0});
  }
  void add_forces(Domain&, double dt) override { dt_ = dt; }
  void constrain(Grid& g) override
  {
    load = 0;
    for (const auto& [node, share] : nodes_)
    {
      load += share * ((g.mass[node] * velocity - g.momentum_y[node]) / dt_ - g.force_y[node]);
      g.momentum_x[node] = g.force_x[node] = g.force_y[node] = 0;
      g.momentum_y[node] = g.mass[node] * velocity;
    }
    load = -load;
  }

  double velocity = 0; ///< m/s
  double load = 0;     ///< on the half footing in the last step, N per m

private:
  double dt_ = 1;
  std::vector<std::pair<int, double>> nodes_;
};
/// Load over s_u B as the footing goes down, by settlement over B.
Curve press(const std::filesystem::path& folder, double h, const std::string& averaged)
{
  const Case case_file = load_case(
      folder / "case.yaml", {"grid.spacing=" + number_text(h) + " m", "grid.volume_average=" + averaged});
  Model model = make_model(case_file);
  add_static_boundaries(model, case_file);
  Domain& domain = *model.main;
  domain.settings.local_damping = 0; // it would carry load
  auto owned = std::make_unique<Footing>();
  Footing& footing = *owned;
  domain.boundaries.push_back(std::move(owned));
  rebuild(domain);
  const auto& clay = std::get<VonMises>(case_file.materials[0].law);
  const double dt = case_file.courant_number * h / clay.pressure_speed(),
               velocity = speed * clay.shear_speed();
  const double strength = clay.peak / std::sqrt(3.0), ramp = 0.05 * final_settlement / velocity;
  const long samples = 60, stride = std::lround(final_settlement / velocity / dt / samples);
  Curve curve{"load, volume change of " + std::string(averaged == "cell" ? "the cell" : "each particle"),
              "settlement / B",
              "load / (s_u B)",
              {},
              {},
              {}};
  double settlement = 0, mean = 0;
  for (long k = 0; k < samples * stride; ++k)
  {
    footing.velocity = -velocity * std::min(1.0, k * dt / ramp);
    domain.time = k * dt;
    step(domain, dt);
    settlement -= dt * footing.velocity;
    mean += footing.load / stride;
    if ((k + 1) % stride != 0) continue;
    curve.x.push_back(settlement / width);
    curve.model.push_back(2 * mean / (strength * width));
    curve.reference.push_back(exact);
    mean = 0;
  }
  return curve;
}
} // namespace

Findings run_strip_footing(const std::filesystem::path& folder, double h)
{
  const Curve each = press(folder, h, "none"), cell = press(folder, h, "cell");
  const auto excess = [](const Curve& curve) { return curve.model.back() / exact - 1; };
  // The width over which the spline of the last node carries the load.
  const double effective = (1 + excess(each)) * width / (width + h) - 1;
  return {{{"load", std::fabs(excess(each))},
           {"load, averaged", std::fabs(excess(cell))},
           {"load, effective width", std::fabs(effective)}},
          {each, cell}};
}
} // namespace mpm::verification
