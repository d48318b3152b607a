#include "boundaries/ground_motion/checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace mpm
{
namespace
{
// What the correction may change before it is warned of: the 10 % by which spectra of design motions may miss
// their target on average, and twice as much at a single period.
constexpr double much = 0.10;
constexpr double much_at_a_period = 0.20;
// A base that ends elsewhere has moved there at a mean velocity that is small beside the shaking's, or
// drifts.
constexpr double drift = 0.05;     // of PGV
constexpr double far_off = 0.10;   // m
constexpr double at_rest = 1e-3;   // of PGV
constexpr double greatest_pga = 3; // g; the greatest ever recorded is 4 g
// No slope feels less, and a record of up to 1 g whose values are taken for cm/s2 has less.
constexpr double least_pga = 1e-3; // g
constexpr double least_pgv = 1e-4; // m/s

/// A measure and what is usual for it.
struct Measure
{
  const char* name;
  double value, least, most;
  const char* unit;
};

/// ", more than 3 g" or ", less than 0.001 g"; empty: usual.
std::string beyond(const Measure& m)
{
  const bool more = m.value > m.most;
  if (!more && m.value >= m.least) return {};
  return std::string(m.name) + " " + number(m.value) + m.unit + " is " +
         (more ? "more than " : "less than ") + number(more ? m.most : m.least) + m.unit;
}

std::string unit_of(const Record& record)
{
  return record.unit.empty() ? "unit" : "unit '" + record.unit + "'";
}

double in_g(double acceleration)
{
  return acceleration / standard_gravity;
}

/// All that is out of range, in one sentence; empty: nothing.
std::string implausible(const Record& record, const MotionProcessing& processing, const MotionReport& report)
{
  const MotionMeasures& m = report.corrected;
  const double samples = double(record.values.size());
  std::vector<Measure> measures{{"the time step of", record.dt, 5e-4, 0.05, " s"},
                                {"the number of", samples, 100, 1e6, " samples"},
                                {"the length of", record.dt * (samples - 1), 1, 1000, " s"}};
  if (processing.scale != 0)
    measures.insert(measures.end(), {{"PGA", in_g(m.pga), least_pga, greatest_pga, " g"},
                                     {"PGV", m.pgv, least_pgv, 4, " m/s"},
                                     {"PGD", m.pgd, 0, 10, " m"}});
  std::string all;
  for (const Measure& measure : measures)
    if (const std::string text = beyond(measure); !text.empty()) all += (all.empty() ? "" : ", ") + text;
  if (all.empty()) return {};
  return all + "; are its " + unit_of(record) + ", its time step of " + number(record.dt) +
         " s and the scale of " + number(processing.scale) + " right?";
}

/// A unit that is wrong and made good by the scale.
std::string doubtful_unit(const Record& record, const MotionProcessing& processing,
                          const MotionReport& report)
{
  const double scaled = in_g(report.recorded.pga), before = scaled / std::abs(processing.scale);
  const auto usual = [](double pga) { return pga >= least_pga && pga <= greatest_pga; };
  if (processing.scale == 0 || usual(before) || !usual(scaled)) return {};
  return "peak acceleration is " + number(before) + " g before scaling, " +
         (before > greatest_pga ? "more than " + number(greatest_pga) : "less than " + number(least_pga)) +
         " g; is its " + unit_of(record) + " right?";
}

std::string percent(double share)
{
  return (share > 0 ? "+" : "") + number(100 * share) + " %";
}

/// "PGV from 2.2 to 0.86 m/s (-61 %)"
std::string changed(const char* name, double before, double after, const char* unit)
{
  return std::string(name) + " from " + number(before) + " to " + number(after) + " " + unit +
         (before > 0 ? " (" + percent(after / before - 1) + ")" : "");
}

std::string heavy_correction(const MotionReport& report)
{
  const MotionMeasures &before = report.recorded, &after = report.corrected;
  std::string what;
  const auto add = [&](const std::string& text) { what += (what.empty() ? "" : ", ") + text; };
  if (std::abs(after.pgv - before.pgv) > much * before.pgv) add(changed("PGV", before.pgv, after.pgv, "m/s"));
  if (std::abs(after.arias - before.arias) > much * before.arias)
    add(changed("the Arias intensity", before.arias, after.arias, "m/s"));
  if (report.spectrum.mean > much || report.spectrum.greatest > much_at_a_period)
    add("the 5 % spectrum by " + number(100 * report.spectrum.mean) + " % on average and " +
        number(100 * report.spectrum.greatest) + " % at " + number(report.spectrum.period) + " s");
  if (what.empty()) return {};
  return "the correction (seismic.motion.baseline, high_pass, taper) changed " + what +
         ", which is more than " + number(100 * much) + " % (" + number(100 * much_at_a_period) +
         " % at one period): look at the record's velocity, and mend the record or choose another correction";
}

std::string unrest(const Record& record, const MotionReport& report)
{
  const MotionMeasures& m = report.corrected;
  if (std::abs(m.final_velocity) > at_rest * m.pgv)
    return "the motion ends with " + number(m.final_velocity) +
           " m/s and the base drifts on; give a baseline to bring it to rest";
  const double mean = std::abs(m.final_displacement) / (record.dt * double(record.values.size() - 1));
  if (std::abs(m.final_displacement) <= far_off || mean <= drift * m.pgv) return {};
  return "the base ends " + number(std::abs(m.final_displacement)) +
         " m from where it began, at a mean velocity of " + number(mean) + " m/s, " +
         number(100 * mean / m.pgv) + " % of PGV: that is a drift of the record, unless " +
         "the ground did go there; another seismic.motion.baseline or a high_pass takes it out";
}
} // namespace

std::string number(double value)
{
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

void refuse_overflow(const Record& record, const MotionProcessing& processing, const MotionMeasures& measures)
{
  if (measures.finite()) return;
  double greatest = 0;
  for (const double value : record.values) greatest = std::max(greatest, std::abs(value));
  throw std::runtime_error(record.source + ": values of up to " + number(greatest) +
                           " (SI), a time step of " + number(record.dt) + " s and a scale of " +
                           number(processing.scale) +
                           " make a motion beyond the numbers of the machine; mend what of them is wrong");
}

std::vector<std::string> motion_warnings(const Record& record, const MotionProcessing& processing,
                                         const MotionReport& report)
{
  std::vector<std::string> all;
  const auto warn = [&](const std::string& what)
  {
    if (!what.empty()) all.push_back(record.source + ": " + what);
  };
  warn(implausible(record, processing, report));
  if (processing.scale == 0)
  {
    warn("the scale is 0: this motion is not applied; give a scale, or leave the motion out");
    return all;
  }
  warn(doubtful_unit(record, processing, report));
  warn(heavy_correction(report));
  warn(unrest(record, report));
  return all;
}
} // namespace mpm
