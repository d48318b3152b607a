#include "boundaries/ground_motion/checks.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace mpm;
using Catch::Matchers::Contains;

namespace
{
constexpr double pi = std::numbers::pi;

/// A wave packet of `peak` m/s2 at 2 Hz about 15 s, which begins and ends at rest where it began.
Record packet(double peak, double dt = 0.01, std::size_t count = 3001)
{
  Record record{"test", "column", "g", dt, Quantity::acceleration, {}, {}};
  for (std::size_t i = 0; i < count; ++i)
  {
    const double t = dt * double(i) - 0.5 * dt * double(count - 1);
    record.values.push_back(peak * std::exp(-t * t / 8) * std::sin(4 * pi * t));
  }
  return record;
}

/// All warnings, one a line.
std::string warnings(const Record& record, double scale = 1, Baseline baseline = Baseline::linear)
{
  MotionProcessing processing;
  processing.scale = scale;
  processing.baseline = baseline;
  std::string all;
  for (const std::string& warning : make_ground_motion(record, processing).report.warnings)
    all += warning + "\n";
  return all;
}

std::string refusal(const Record& record, double scale = 1)
{
  MotionProcessing processing;
  processing.taper = 0;
  processing.scale = scale;
  try
  {
    make_ground_motion(record, processing);
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return "accepted";
}
/// The same values, given with another time step.
Record retimed(Record record, double dt)
{
  record.dt = dt;
  return record;
}
} // namespace

TEST_CASE("a usual motion is not warned of", "[boundaries]")
{
  for (const double peak : {0.02, 1.0, 10.0}) CHECK(warnings(packet(peak)).empty());
  for (const Baseline baseline : {Baseline::none, Baseline::quadratic, Baseline::cubic})
    CHECK(warnings(packet(2), 1, baseline).empty());
  CHECK(warnings(packet(2, 0.001, 30001)).empty());
}

TEST_CASE("a motion out of the usual range is warned of by name and value, as scaled", "[boundaries]")
{
  CHECK_THAT(warnings(packet(300)), Contains("PGA 30.4") && Contains("more than 3 g") && Contains("'g'"));
  CHECK_THAT(warnings(packet(5e-4)), Contains("PGA 5.0") && Contains("less than 0.001 g"));
  CHECK_THAT(warnings(packet(3), 1 / standard_gravity / 100),
             Contains("less than 0.001 g")); // g taken for cm/s2
  CHECK_THAT(warnings(packet(3), 1e-6), Contains("less than 0.001 g") && Contains("scale of 1e-06"));
  CHECK_THAT(warnings(packet(3), 100),
             Contains("more than 3 g") && Contains("PGV") && Contains("scale of 100"));
  CHECK_THAT(warnings(retimed(packet(3), 10)), Contains("time step of 10 s is more than 0.05 s") &&
                                                   Contains("length of 3e+04 s is more than 1000 s") &&
                                                   Contains("PGD"));
  CHECK_THAT(warnings(retimed(packet(3, 0.01, 200001), 1e-5)),
             Contains("time step of 1e-05 s is less than 0.0005 s"));
  CHECK_THAT(warnings(packet(3, 0.04, 51)), Contains("number of 51 samples is less than 100 samples"));
  CHECK_THAT(warnings(packet(3, 0.005, 121), 1, Baseline::none),
             Contains("length of 0.6 s is less than 1 s"));
}

TEST_CASE("a wrong unit that the scale hides is warned of", "[boundaries]")
{
  CHECK_THAT(warnings(packet(300), 0.01), Contains("30.4") && Contains("before scaling") && Contains("'g'"));
  CHECK_THAT(warnings(packet(5e-4), 1e4), Contains("less than 0.001 g") && Contains("before scaling"));
}

TEST_CASE("a scale of 0 is told as what it is, and nothing else of that motion", "[boundaries]")
{
  CHECK_THAT(warnings(packet(3), 0), Contains("the scale is 0") && !Contains("PGA") && !Contains("nan"));
}

TEST_CASE("what goes beyond the numbers of the machine is refused with what may be the cause", "[boundaries]")
{
  CHECK_THAT(refusal(packet(3), 1e300), Contains("scale of 1e+300") && Contains("beyond"));
  CHECK_THAT(refusal(packet(3), 1e154), Contains("scale of 1e+154")); // the square of a
  CHECK_THAT(refusal(retimed(packet(3), 1e300)), Contains("time step of 1e+300 s") && Contains("beyond"));
  CHECK_THAT(refusal(packet(1e200)), Contains("values of up to"));
  Record velocity = packet(1);
  velocity.dt = 1e-320;
  velocity.quantity = Quantity::velocity; // its differences
  CHECK_THAT(refusal(velocity), Contains("time step of 1e-320 s"));
}

TEST_CASE("a correction that changes the motion is warned of with what it changed", "[boundaries]")
{
  // A sensor that tilts at 15 s: from there on an offset of 0.05 m/s2, which no straight line takes out.
  Record tilted = packet(3);
  for (std::size_t i = 1500; i < tilted.values.size(); ++i) tilted.values[i] += 0.05;
  const std::string linear = warnings(tilted);
  CHECK_THAT(linear, Contains("the correction") && Contains("PGV from") && Contains("more than 10 %"));
  // v(end) = 0.75 m/s raw; the line leaves a triangle of 0.375 m/s in the middle, 5.6 m.
  CHECK_THAT(linear, Contains("the base ends 5.6") && Contains("% of PGV"));
  // A low-frequency motion that the high-pass takes away.
  MotionProcessing filtered;
  filtered.high_pass = 3;
  const auto report = make_ground_motion(packet(3), filtered).report;
  REQUIRE(report.warnings.size() >= 1);
  CHECK_THAT(report.warnings[0], Contains("the Arias intensity from") && Contains("the 5 % spectrum by"));
  CHECK(report.spectrum.greatest > 1); // (2/3)^8 = 1/26 of the packet is left
}
