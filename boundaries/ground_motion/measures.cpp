#include "boundaries/ground_motion/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace mpm
{
namespace
{
using Series = std::vector<double>;
constexpr double pi = std::numbers::pi;
constexpr int steps_a_period = 20;
constexpr double shortest = 0.05, longest = 4; // s, the periods of ground and buildings
constexpr int period_count = 60;

std::size_t index_of_peak(const Series& x)
{
  const auto magnitude = [](double value) { return std::abs(value); };
  return static_cast<std::size_t>(std::ranges::max_element(x, {}, magnitude) - x.begin());
}

/// Integral of v, exact for the cubic through v with the slopes a.
Series displacement(const Series& v, const Series& a, double dt)
{
  Series u(v.size());
  for (std::size_t i = 1; i < v.size(); ++i)
    u[i] = u[i - 1] + 0.5 * dt * (v[i - 1] + v[i]) + dt * dt / 12 * (a[i - 1] - a[i]);
  return u;
}

/// Integral of a^2 by the trapezoidal rule.
Series squares(const Series& a, double dt)
{
  Series sum(a.size());
  for (std::size_t i = 1; i < a.size(); ++i)
    sum[i] = sum[i - 1] + 0.5 * dt * (a[i - 1] * a[i - 1] + a[i] * a[i]);
  return sum;
}

/// Where a sum that only grows reaches a value, in steps.
double reached(const Series& sum, double value)
{
  const auto next = std::ranges::lower_bound(sum, value);
  if (next == sum.begin() || next == sum.end()) return 0;
  const double before = *(next - 1);
  return double(next - 1 - sum.begin()) + (value - before) / (*next - before);
}

/// An oscillator of 1 rad/s in the phase w t: its displacement times w^2 and its velocity times w, both m/s2.
class Oscillator
{
public:
  /// For steps of `angle` rad.
  Oscillator(double angle, double damping) : angle_(angle), damping_(damping)
  {
    const double frequency = std::sqrt(1 - damping * damping), decay = std::exp(-damping * angle),
                 sine = decay * std::sin(frequency * angle) / frequency,
                 cosine = decay * std::cos(frequency * angle);
    from_ = {{{cosine + damping * sine, sine}, {-sine, cosine - damping * sine}}};
  }
  /// One step with the ground's acceleration going linearly from `before` to `after`; returns w^2 u.
  double step(double before, double after)
  {
    const double slope = (after - before) / angle_, lag = 2 * damping_ * slope;
    const double d = displacement_ + before - lag, s = velocity_ + slope; // beside the ramp's own solution
    displacement_ = from_[0][0] * d + from_[0][1] * s - after + lag;
    velocity_ = from_[1][0] * d + from_[1][1] * s - slope;
    return displacement_;
  }

private:
  double angle_, damping_;
  std::array<std::array<double, 2>, 2> from_;
  double displacement_ = 0, velocity_ = 0;
};
} // namespace

bool MotionMeasures::finite() const
{
  return std::ranges::all_of(std::initializer_list<double>{pga, pga_time, pgv, pgd, arias, d5_95,
                                                           final_velocity, final_displacement},
                             [](double value) { return std::isfinite(value); });
}

MotionMeasures measure(const Series& v, const Series& a, double dt, double factor)
{
  const Series u = displacement(v, a, dt), sum = squares(a, dt);
  const std::size_t peak = index_of_peak(a);
  MotionMeasures result;
  result.pga = factor * std::abs(a[peak]);
  result.pga_time = dt * double(peak);
  result.pgv = factor * std::abs(v[index_of_peak(v)]);
  result.pgd = factor * std::abs(u[index_of_peak(u)]);
  result.arias = factor * factor * 0.5 * pi / standard_gravity * sum.back();
  result.d5_95 = dt * (reached(sum, 0.95 * sum.back()) - reached(sum, 0.05 * sum.back()));
  result.final_velocity = factor * v.back();
  result.final_displacement = factor * u.back();
  return result;
}

Series response_spectrum(const Series& a, double dt, const Series& periods, double damping)
{
  Series spectrum;
  for (const double period : periods)
  {
    const int parts = std::max(1, static_cast<int>(std::ceil(dt * steps_a_period / period - 1e-9)));
    Oscillator oscillator(2 * pi * dt / period / parts, damping);
    double greatest = 0;
    for (std::size_t i = 1; i < a.size(); ++i)
      for (int k = 0; k < parts; ++k)
      {
        const double slope = (a[i] - a[i - 1]) / parts;
        greatest =
            std::max(greatest, std::abs(oscillator.step(a[i - 1] + k * slope, a[i - 1] + (k + 1) * slope)));
      }
    spectrum.push_back(greatest);
  }
  return spectrum;
}

SpectralChange spectral_change(const Series& before, const Series& after, double dt)
{
  const double first = std::max(shortest, 2 * dt); // samples hold no waves that are shorter
  if (first >= longest) return {};
  Series periods;
  for (int k = 0; k < period_count; ++k)
    periods.push_back(first * std::pow(longest / first, double(k) / (period_count - 1)));
  const Series one = response_spectrum(before, dt, periods), other = response_spectrum(after, dt, periods);
  SpectralChange change;
  for (std::size_t k = 0; k < periods.size(); ++k)
  {
    if (!(one[k] > 0 && other[k] > 0)) continue; // of a motion that is nil
    const double apart = std::abs(std::log(other[k] / one[k]));
    change.mean += apart / period_count;
    if (apart <= change.greatest) continue;
    change.greatest = apart;
    change.period = periods[k];
  }
  return change;
}
} // namespace mpm
