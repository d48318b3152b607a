#include "test/verification/cases.hpp"
#include "test/verification/column.hpp"

#include <cmath>
#include <numbers>

namespace mpm::verification
{
namespace
{
constexpr double speed = 1e-4; // m/s at the surface: strains of 1e-6, so that nothing is nonlinear
constexpr int periods = 60;    // so many that the decrement is told from the sampling of a period

/// First mode of a shear column of height H: sin(pi Y / 2 H).
double mode(double Y, double H)
{
  return std::sin(0.5 * std::numbers::pi * Y / H);
}

/// Starts the column in its first mode; amplitude of the mode's velocity.
void start(Domain& column, double H)
{
  Particles& p = column.particles;
  const double k = 0.5 * std::numbers::pi / H;
  for (int i = 0; i < p.size(); ++i)
  {
    p.velocity_x[i] = speed * mode(p.reference_y[i], H);
    p.affine_xy[i] = speed * k * std::cos(k * p.reference_y[i]);
  }
}

double amplitude(const Domain& column, double H)
{
  const Particles& p = column.particles;
  double sum = 0, norm = 0;
  for (int i = 0; i < p.size(); ++i)
  {
    const double shape = mode(p.reference_y[i], H);
    sum += p.mass[i] * p.velocity_x[i] * shape;
    norm += p.mass[i] * shape * shape;
  }
  return sum / norm;
}

/// Zero crossings of samples at k dt, as fractional k.
std::vector<double> crossings(const std::vector<double>& samples)
{
  std::vector<double> found;
  for (std::size_t k = 1; k < samples.size(); ++k)
    if (samples[k - 1] * samples[k] < 0)
      found.push_back(k - 1 + samples[k - 1] / (samples[k - 1] - samples[k]));
  return found;
}

/// Damping ratio by the logarithmic decrement between the mean squares of two stretches of whole periods.
double damping_ratio(const std::vector<double>& samples, const std::vector<double>& zeros)
{
  const auto energy = [&](std::size_t from, std::size_t to)
  {
    double sum = 0;
    const auto begin = static_cast<std::size_t>(zeros[from]), end = static_cast<std::size_t>(zeros[to]);
    for (std::size_t k = begin + 1; k <= end; ++k) sum += samples[k] * samples[k];
    return sum / static_cast<double>(end - begin);
  };
  const std::size_t last = zeros.size() - 1, length = 8;         // half periods
  const double apart = 0.5 * static_cast<double>(last - length); // periods
  return 0.5 * std::log(energy(0, length) / energy(last - length, last)) / (2 * std::numbers::pi * apart);
}
} // namespace

Findings run_free_vibration(const std::filesystem::path& folder, double spacing)
{
  const Case case_file = case_at(folder, spacing);
  const double H = case_file.ground_height(0),
               period = read_table(folder / "reference.csv").at("period").at(0);
  Model model = make_model(case_file);
  add_static_boundaries(model, case_file);
  Domain& column = *model.left->domain;
  start(column, H);
  const double dt = step_of(case_file.courant_number, column);
  std::vector<double> samples{amplitude(column, H)};
  Curve curve{"mode 1, last 4 periods", "time (s)", "surface velocity (m/s)", {}, {}, {}};
  for (int k = 0; k * dt < (periods + 0.3) * period; ++k)
  {
    model.left->advance(k * dt, dt);
    samples.push_back(amplitude(column, H));
    const double t = (k + 1) * dt;
    if (t < (periods - 4) * period) continue;
    curve.x.push_back(t);
    curve.model.push_back(samples.back());
    curve.reference.push_back(speed * std::cos(2 * std::numbers::pi * t / period));
  }
  const std::vector<double> zeros = crossings(samples);
  const double found = 2 * dt * (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
  // xi = a (k h)^3 / (2 C_w): affine transfers filter the velocity by sqrt(1 - a (k h)^4) a step.
  const Elastic law = case_file.materials[0].elastic();
  const double kh = 0.5 * std::numbers::pi * spacing / H, wave_courant = dt * law.shear_speed() / spacing;
  const double damping = 0.0471 * std::pow(kh, 3) / (2 * wave_courant);
  return {{{"period", std::fabs(found / period - 1)},
           {"damping", std::fabs(damping_ratio(samples, zeros) / damping - 1)}},
          {curve}};
}
} // namespace mpm::verification
