#include "test/verification/cases.hpp"

#include "boundaries/mirrored_wall.hpp"
#include "io/case/units.hpp"
#include "solver/mpm/step.hpp"
#include "solver/stages/model.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::verification
{
namespace
{
constexpr std::array wide{0.6, 1.0, 1.6}, tall{3.0, 5.0, 9.0}; // aspect ratios, height over width
constexpr double width = 1;                                    // m
constexpr double duration = 6;                                 // in sqrt(height / g), and one second

/// Deposit over the first width: run-out beyond it, height at the wall.
struct Deposit
{
  double run_out, height;
};

constexpr double reach = 0.1, layer = 0.02; // m: sand is one deposit as far as a layer so thick goes on

/// The front of the sand that lies together, and the depth of the sand in the cell at the wall. Single
/// particles that have flown on are no deposit: it ends where the next `reach` holds less than the layer, or
/// one particle at the most.
Deposit deposit_of(const Domain& domain)
{
  const Particles& p = domain.particles;
  const double volume = p.mass[0] / domain.materials[0].elastic().density; // undeformed, the same for all
  const auto least =
      std::max<std::ptrdiff_t>(2, static_cast<std::ptrdiff_t>(std::ceil(layer * reach / volume)));
  std::vector<double> x = p.x;
  std::sort(x.begin(), x.end());
  auto front = x.begin();
  while (std::lower_bound(front, x.end(), *front + reach) - front >= least) ++front;
  const double h = domain.grid.spacing;
  const auto at_wall = std::lower_bound(x.begin(), x.end(), h) - x.begin();
  return {*front - width, static_cast<double>(at_wall) * volume / h};
}

Deposit collapse(const std::filesystem::path& folder, double h, double aspect)
{
  const Case case_file =
      load_case(folder / "case.yaml", {"grid.spacing=" + number_text(h) + " m",
                                       "surfaces.top.points[0][1]=" + number_text(aspect) + " m"});
  Model model = make_model(case_file);
  Domain& domain = *model.main;
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 0, 1, false}));
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::x, 0, 1, true}));
  rebuild(domain);
  const Elastic& sand = case_file.materials[0].elastic();
  const double gravity = case_file.static_stage.gravity, lateral = sand.poisson / (1 - sand.poisson);
  domain.settings.gravity_y = -gravity;
  set_transfer(domain.settings, case_file.seismic);
  Particles& p = domain.particles;
  for (int k = 0; k < p.size(); ++k)
  {
    p.stress_yy[k] = -sand.density * gravity * (aspect - p.y[k]);
    p.stress_xx[k] = p.stress_zz[k] = lateral * p.stress_yy[k];
  }
  const double dt = case_file.courant_number * h / sand.pressure_speed(),
               end = 1 + duration * std::sqrt(aspect / gravity);
  for (long k = 0; k * dt < end; ++k)
  {
    domain.time = k * dt;
    step(domain, dt);
  }
  return deposit_of(domain);
}

/// y = prefactor x^exponent by least squares of the logarithms.
struct PowerLaw
{
  double prefactor, exponent;
};

PowerLaw fit(std::span<const double> x, std::span<const double> y)
{
  const auto n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    const double u = std::log(x[k]), v = std::log(y[k]);
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  const double exponent = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {std::exp((sy - exponent * sx) / n), exponent};
}
} // namespace

Findings run_column_collapse(const std::filesystem::path& folder, double h)
{
  Findings found;
  Curve run_out{"run-out", "height / width", "run-out / width", {}, {}, {}};
  Curve height{"height", "height / width", "height of the deposit / width", {}, {}, {}};
  // Lube et al. 2005; prefactors are compared where the data are, at the middle aspect ratio.
  const auto group =
      [&](const std::string& name, std::span<const double> aspects, double prefactor, double exponent)
  {
    std::vector<double> distance;
    for (const double a : aspects)
    {
      const Deposit deposit = collapse(folder, h, a);
      distance.push_back(deposit.run_out);
      run_out.x.push_back(a);
      run_out.model.push_back(deposit.run_out);
      run_out.reference.push_back(prefactor * std::pow(a, exponent));
      height.x.push_back(a);
      height.model.push_back(deposit.height);
      height.reference.push_back(a < 1.15 ? a : std::pow(a, 0.4));
    }
    const PowerLaw law = fit(aspects, distance);
    const double middle = aspects[1];
    found.errors[name + " exponent"] = std::fabs(law.exponent - exponent);
    found.errors[name + " prefactor"] = std::fabs(
        law.prefactor * std::pow(middle, law.exponent) / (prefactor * std::pow(middle, exponent)) - 1);
  };
  group("wide", wide, 1.2, 1);
  group("tall", tall, 1.9, 2.0 / 3);
  double worst = 0;
  for (std::size_t k = 0; k < height.x.size(); ++k)
    worst = std::max(worst, std::fabs(height.model[k] / height.reference[k] - 1));
  found.errors["height"] = worst;
  found.curves = {run_out, height};
  return found;
}
} // namespace mpm::verification
