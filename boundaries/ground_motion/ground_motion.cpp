#include "boundaries/ground_motion/ground_motion.hpp"

#include "boundaries/ground_motion/checks.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace mpm
{
namespace
{
using Series = std::vector<double>;
constexpr double pi = std::numbers::pi;

constexpr std::array quantity_names{std::pair{Quantity::acceleration, std::string_view("acceleration")},
                                    std::pair{Quantity::velocity, std::string_view("velocity")},
                                    std::pair{Quantity::displacement, std::string_view("displacement")}};
constexpr std::array recorded_as_names{std::pair{RecordedAs::outcrop, std::string_view("outcrop")},
                                       std::pair{RecordedAs::upgoing, std::string_view("upgoing")}};
constexpr std::array baseline_names{std::pair{Baseline::none, std::string_view("none")},
                                    std::pair{Baseline::linear, std::string_view("linear")},
                                    std::pair{Baseline::quadratic, std::string_view("quadratic")},
                                    std::pair{Baseline::cubic, std::string_view("cubic")}};

template <class Value, std::size_t n>
std::optional<Value> value_in(const std::array<std::pair<Value, std::string_view>, n>& names,
                              std::string_view name)
{
  for (const auto& [value, text] : names)
    if (text == name) return value;
  return {};
}

template <class Names, class Value>
std::string_view name_in(const Names& names, Value value)
{
  return std::ranges::find(names, value, [](const auto& pair) { return pair.first; })->second;
}

Series integral(const Series& x, double dt)
{
  Series sum(x.size());
  for (std::size_t i = 1; i < x.size(); ++i) sum[i] = sum[i - 1] + 0.5 * dt * (x[i - 1] + x[i]);
  return sum;
}

/// Fourth order differences, exact for quartics; inside the first two and last two samples one-sided.
Series derivative(const Series& x, double dt)
{
  const std::size_t n = x.size();
  Series slope(n);
  for (std::size_t i = 2; i + 2 < n; ++i)
    slope[i] = (x[i - 2] - 8 * x[i - 1] + 8 * x[i + 1] - x[i + 2]) / (12 * dt);
  const auto at_end = [&](auto at, double sign)
  {
    return std::pair{sign * (-25 * at(0) + 48 * at(1) - 36 * at(2) + 16 * at(3) - 3 * at(4)) / (12 * dt),
                     sign * (-3 * at(0) - 10 * at(1) + 18 * at(2) - 6 * at(3) + at(4)) / (12 * dt)};
  };
  std::tie(slope[0], slope[1]) = at_end([&](std::size_t i) { return x[i]; }, 1);
  std::tie(slope[n - 1], slope[n - 2]) = at_end([&](std::size_t i) { return x[n - 1 - i]; }, -1);
  return slope;
}

/// One second-order section of a Butterworth high-pass, bilinear with the corner prewarped.
void high_pass_section(Series& x, double corner, double dt, double q)
{
  const double k = std::tan(pi * corner * dt), norm = 1 / (1 + k / q + k * k);
  const double a1 = 2 * (k * k - 1) * norm, a2 = (1 - k / q + k * k) * norm;
  double s1 = 0, s2 = 0;
  for (double& value : x)
  {
    const double in = norm * value, out = in + s1;
    s1 = -2 * in - a1 * out + s2;
    s2 = in - a2 * out;
    value = out;
  }
}

/// 4th order Butterworth forth and back: no phase shift, gain 1/2 at the corner. The result is longer by
/// `pad` zeros at either end, filled by the filter's transients; they are to be integrated too, or the motion
/// goes adrift.
Series high_pass(const Series& x, double corner, double dt, std::size_t pad)
{
  double mean = 0;
  for (double value : x) mean += value / double(x.size());
  Series padded(x.size() + 2 * pad);
  std::ranges::transform(x, padded.begin() + long(pad), [mean](double value) { return value - mean; });
  for (int pass = 0; pass < 2; ++pass)
  {
    high_pass_section(padded, corner, dt, 0.5 / std::cos(pi / 8));
    high_pass_section(padded, corner, dt, 0.5 / std::cos(3 * pi / 8));
    std::ranges::reverse(padded);
  }
  return padded;
}

/// Subtracts v(end) s, s = t / T, then the least-squares multiples of s (s - 1) and s (s - 1) (2 s - 1): both
/// vanish at the ends, and being even and odd about the middle they are orthogonal on an even grid.
void correct_baseline(Series& v, Series& a, double dt, Baseline baseline)
{
  const std::size_t last = v.size() - 1;
  const double duration = dt * double(last);
  const auto subtract = [&](double factor, auto shape, auto slope)
  {
    for (std::size_t i = 0; i <= last; ++i)
    {
      const double s = double(i) / double(last);
      v[i] -= factor * shape(s);
      a[i] -= factor * slope(s) / duration;
    }
  };
  const auto fit = [&](auto shape)
  {
    double top = 0, bottom = 0;
    for (std::size_t i = 0; i <= last; ++i)
    {
      const double b = shape(double(i) / double(last));
      top += v[i] * b;
      bottom += b * b;
    }
    return bottom > 0 ? top / bottom : 0.;
  };
  const auto even = [](double s) { return s * (s - 1); };
  const auto odd = [](double s) { return s * (s - 1) * (2 * s - 1); };
  if (baseline >= Baseline::linear)
    subtract(
        v[last], [](double s) { return s; }, [](double) { return 1.; });
  if (baseline >= Baseline::quadratic) subtract(fit(even), even, [](double s) { return 2 * s - 1; });
  if (baseline >= Baseline::cubic) subtract(fit(odd), odd, [](double s) { return 6 * s * (s - 1) + 1; });
}

/// Cosine taper w on v at both ends; a = w a + w' v stays its slope.
void taper_ends(Series& v, Series& a, double dt, double length)
{
  const std::size_t last = v.size() - 1;
  for (std::size_t i = 0; i <= last && dt * double(i) < length; ++i)
  {
    const double phase = pi * dt * double(i) / length;
    const double w = 0.5 * (1 - std::cos(phase)), slope = 0.5 * pi / length * std::sin(phase);
    a[i] = w * a[i] + slope * v[i];
    a[last - i] = w * a[last - i] - slope * v[last - i];
    v[i] *= w;
    v[last - i] *= w;
  }
}

void check(const Record& record, const MotionProcessing& processing)
{
  const auto refuse = [&](const std::string& what) { throw std::runtime_error(record.source + ": " + what); };
  if (!(record.dt > 0) || !std::isfinite(record.dt))
    refuse("dt is " + number(record.dt) + " s; give a positive sampling interval");
  if (record.values.size() < 5)
    refuse("only " + std::to_string(record.values.size()) + " values; a motion needs at least 5");
  for (std::size_t i = 0; i < record.values.size(); ++i)
    if (!std::isfinite(record.values[i]))
      refuse("value " + std::to_string(i + 1) + " is not finite; mend the file");
  if (!std::isfinite(processing.scale)) refuse("scale is not finite; give a number");
  const double duration = record.dt * double(record.values.size() - 1), taper = taper_of(processing);
  if (!(taper >= 0 && 2 * taper <= duration))
    refuse("a taper of " + number(taper) + " s at both ends does not fit a record of " + number(duration) +
           " s; give a shorter one, or 0");
  const double nyquist = 0.5 / record.dt, corner = processing.high_pass;
  if (!(corner >= 0 && corner < nyquist))
    refuse("high_pass of " + number(corner) + " Hz is not between 0 (off) and the Nyquist frequency of " +
           number(nyquist) + " Hz");
  if (corner > 0 && corner * duration < 0.1)
    refuse("high_pass of " + number(corner) + " Hz is far below what " + number(duration) +
           " s of record can hold; raise it, or 0 for off");
}

/// Velocity and its slope from a record of any quantity.
std::pair<Series, Series> velocity_and_slope(Series values, Quantity quantity, double dt)
{
  if (quantity == Quantity::acceleration)
  {
    Series v = integral(values, dt);
    return {std::move(v), std::move(values)};
  }
  if (quantity == Quantity::displacement) values = derivative(values, dt);
  Series a = derivative(values, dt);
  return {std::move(values), std::move(a)};
}
} // namespace

double taper_of(const MotionProcessing& processing)
{
  if (!std::isnan(processing.taper)) return processing.taper;
  return processing.baseline == Baseline::none && processing.high_pass == 0 ? 0 : 0.5;
}

std::optional<Quantity> quantity_from(std::string_view name)
{
  return value_in(quantity_names, name);
}
std::optional<RecordedAs> recorded_as_from(std::string_view name)
{
  return value_in(recorded_as_names, name);
}
std::optional<Baseline> baseline_from(std::string_view name)
{
  return value_in(baseline_names, name);
}
std::string_view name_of(Quantity quantity)
{
  return name_in(quantity_names, quantity);
}
std::string_view name_of(RecordedAs recorded_as)
{
  return name_in(recorded_as_names, recorded_as);
}
std::string_view name_of(Baseline baseline)
{
  return name_in(baseline_names, baseline);
}

double GroundMotion::upgoing_velocity(double t) const
{
  if (velocity.empty() || !(t >= 0)) return 0;
  const double x = t / dt;
  if (x >= double(velocity.size() - 1)) return velocity.back();
  const auto i = std::size_t(x);
  const double s = x - double(i), r = 1 - s;
  return r * r * ((1 + 2 * s) * velocity[i] + s * dt * acceleration[i]) +
         s * s * ((1 + 2 * r) * velocity[i + 1] - r * dt * acceleration[i + 1]);
}

double GroundMotion::upgoing_acceleration(double t) const
{
  if (velocity.empty() || !(t >= 0)) return 0;
  const double x = t / dt, last = double(velocity.size() - 1);
  if (x >= last) return x <= last * (1 + 1e-12) ? acceleration.back() : 0; // the end is the record's
  const auto i = std::size_t(x);
  const double s = x - double(i), r = 1 - s;
  return 6 * r * s * (velocity[i + 1] - velocity[i]) / dt + r * (r - 2 * s) * acceleration[i] +
         s * (s - 2 * r) * acceleration[i + 1];
}

GroundMotion make_ground_motion(const Record& record, const MotionProcessing& processing)
{
  check(record, processing);
  const double dt = record.dt;
  GroundMotion motion{dt, {}, {}, {}};
  Series values = record.values;
  for (double& value : values) value *= processing.scale;

  auto [v, a] = velocity_and_slope(values, record.quantity, dt);
  MotionReport& report = motion.report;
  report.recorded = measure(v, a, dt);
  refuse_overflow(record, processing, report.recorded);
  const Series as_recorded = a;

  if (processing.high_pass > 0)
  {
    const auto pad = std::size_t(std::ceil(1.5 * 4 / (processing.high_pass * dt))); // 1.5 order / corner
    std::tie(v, a) =
        velocity_and_slope(high_pass(values, processing.high_pass, dt, pad), record.quantity, dt);
    for (Series* series : {&v, &a}) *series = Series(series->begin() + long(pad), series->end() - long(pad));
  }
  correct_baseline(v, a, dt, processing.baseline);
  if (const double taper = taper_of(processing); taper > 0) taper_ends(v, a, dt, taper);
  if (processing.baseline != Baseline::none) v.back() = 0; // of rounding
  report.corrected = measure(v, a, dt);
  refuse_overflow(record, processing, report.corrected);
  report.spectrum = spectral_change(as_recorded, a, dt);
  report.warnings = motion_warnings(record, processing, report);

  report.parts = record.quantity == Quantity::acceleration ? 1 : 8;
  report.share = processing.recorded_as == RecordedAs::outcrop ? 0.5 : 1; // v_outcrop = 2 v_up
  for (double& value : v) value *= report.share;
  for (double& value : a) value *= report.share;
  motion.velocity = std::move(v);
  motion.acceleration = std::move(a);
  return motion;
}
} // namespace mpm
