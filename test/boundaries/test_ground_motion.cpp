#include "boundaries/compliant_base.hpp"
#include "boundaries/ground_motion/ground_motion.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace mpm;

namespace
{
constexpr double pi = std::numbers::pi;

template <class Function>
Record record_of(Function f, double dt, std::size_t count, Quantity quantity = Quantity::acceleration)
{
  Record record{"test", "column", "m/s2", dt, quantity, {}, {}};
  for (std::size_t i = 0; i < count; ++i) record.values.push_back(f(dt * double(i)));
  return record;
}

MotionProcessing untouched(RecordedAs recorded_as = RecordedAs::upgoing)
{
  MotionProcessing processing;
  processing.recorded_as = recorded_as;
  processing.baseline = Baseline::none;
  return processing;
}

double largest(const std::vector<double>& x)
{
  double value = 0;
  for (double y : x) value = std::max(value, std::abs(y));
  return value;
}
} // namespace

TEST_CASE("a sine of acceleration integrates to the closed form of velocity", "[boundaries]")
{
  const double w = 2 * pi * 1.5, dt = 0.005;
  const auto motion =
      make_ground_motion(record_of([w](double t) { return std::sin(w * t); }, dt, 2001), untouched());
  // The trapezoidal rule integrates sin(w t) to its closed form times (w dt / 2) / tan(w dt / 2).
  const double bound = (w * dt) * (w * dt) / 12 * 2 / w * 1.01;
  for (double t : {0.0, 0.111, 0.5, 1.2345, 7.7, 9.9999})
    CHECK(std::abs(motion.upgoing_velocity(t) - (1 - std::cos(w * t)) / w) <= bound + 1e-15);
}

TEST_CASE("an outcrop motion enters as half of itself, bit by bit", "[boundaries]")
{
  const auto record = record_of([](double t) { return std::exp(-t) * std::sin(9 * t); }, 0.01, 1000);
  const auto outcrop = make_ground_motion(record, untouched(RecordedAs::outcrop));
  const auto upgoing = make_ground_motion(record, untouched(RecordedAs::upgoing));
  for (std::size_t i = 0; i < 1000; ++i)
  {
    REQUIRE(outcrop.velocity[i] == 0.5 * upgoing.velocity[i]);
    REQUIRE(outcrop.acceleration[i] == 0.5 * upgoing.acceleration[i]);
  }
  CHECK(outcrop.report.corrected.pga == upgoing.report.corrected.pga); // measures are those of the record
}

TEST_CASE("between samples the velocity is the cubic that its samples and slopes fix", "[boundaries]")
{
  const auto cubic = [](double t) { return 1 + t * (2 + t * (-3 + 0.5 * t)); };
  const auto slope = [](double t) { return 2 + t * (-6 + 1.5 * t); };
  GroundMotion motion{0.25, {}, {}, {}};
  for (int i = 0; i <= 20; ++i)
  {
    motion.velocity.push_back(cubic(0.25 * i));
    motion.acceleration.push_back(slope(0.25 * i));
  }
  for (double t = 0; t < 5; t += 0.0371) // to rounding: |v| < 9, |a| < 10
  {
    CHECK(motion.upgoing_velocity(t) == Approx(cubic(t)).margin(1e-13));
    CHECK(motion.upgoing_acceleration(t) == Approx(slope(t)).margin(1e-12));
  }
}

TEST_CASE("there is no motion before the start, and after the end it stays as it was", "[boundaries]")
{
  const auto motion = make_ground_motion(record_of([](double) { return 1.; }, 0.5, 5), untouched());
  CHECK(motion.upgoing_velocity(-1e-9) == 0);
  CHECK(motion.upgoing_velocity(1) == Approx(1).epsilon(1e-15));
  CHECK(motion.upgoing_velocity(2) == Approx(2).epsilon(1e-15));
  CHECK(motion.upgoing_velocity(1e6) == motion.upgoing_velocity(2));
  CHECK(motion.upgoing_acceleration(3) == 0);
}

TEST_CASE("a linear baseline takes a constant offset off the acceleration", "[boundaries]")
{
  const double w = 2 * pi; // whole periods, so that v(end) is the offset's alone
  const auto clean = record_of([w](double t) { return std::sin(w * t); }, 0.01, 1001);
  auto shifted = clean;
  for (double& a : shifted.values) a += 0.03;
  auto processing = untouched();
  processing.baseline = Baseline::linear;
  processing.taper = 0;
  const auto motion = make_ground_motion(shifted, processing);
  CHECK(motion.report.recorded.final_velocity == Approx(0.3).epsilon(1e-12));
  CHECK(motion.velocity.back() == 0);
  for (std::size_t i = 0; i < clean.values.size(); ++i)
    REQUIRE(motion.acceleration[i] == Approx(clean.values[i]).margin(1e-13));
}

TEST_CASE("every baseline but none brings the velocity to rest", "[boundaries]")
{
  const auto record = record_of([](double t) { return std::sin(5 * t) + 0.02 * t - 0.1; }, 0.01, 2000);
  for (Baseline baseline : {Baseline::linear, Baseline::quadratic, Baseline::cubic})
  {
    MotionProcessing processing;
    processing.baseline = baseline;
    const auto motion = make_ground_motion(record, processing);
    CHECK(motion.velocity.front() == 0);
    CHECK(motion.velocity.back() == 0);
    CHECK(motion.report.corrected.final_velocity == 0);
    CHECK(motion.upgoing_velocity(1e3) == 0);
  }
  const auto drifting = make_ground_motion(record, untouched());
  CHECK(drifting.velocity.back() == drifting.report.recorded.final_velocity);
  REQUIRE(drifting.report.warnings.size() >= 1);
  CHECK_THAT(drifting.report.warnings.back(), Catch::Contains("drifts on"));
}

TEST_CASE("a cubic baseline removes any cubic drift of velocity through the origin", "[boundaries]")
{
  // v = 0.3 t - 0.05 t^2 + 0.002 t^3, given as velocity: differences of 4th order are exact for it
  const auto drift = [](double t) { return t * (0.3 + t * (-0.05 + t * 0.002)); };
  auto processing = untouched();
  processing.baseline = Baseline::cubic;
  processing.taper = 0;
  const auto motion = make_ground_motion(record_of(drift, 0.02, 1001, Quantity::velocity), processing);
  CHECK(largest(motion.velocity) < 1e-12); // rounding of |v| < 3
  CHECK(largest(motion.acceleration) < 1e-10);
}

TEST_CASE("acceleration stays the slope of velocity through baseline and tapers", "[boundaries]")
{
  const double dt = 0.002;
  const auto record = record_of([](double t) { return std::cos(6 * t) + 0.05; }, dt, 3001);
  MotionProcessing processing;
  processing.baseline = Baseline::cubic;
  const auto motion = make_ground_motion(record, processing);
  // Central differences err by dt^2/6 v''', with |v'''| below (6 + pi/0.5)^2 a_max and a_max = 1.05, and by
  // dt/4 of the jump of v'' where a taper ends: (pi/0.5)^2/2 v.
  const double bound = dt * dt / 6 * 160 * 1.05 + dt / 4 * 20 * largest(motion.velocity);
  for (std::size_t i = 1; i + 1 < motion.velocity.size(); ++i)
    REQUIRE(std::abs((motion.velocity[i + 1] - motion.velocity[i - 1]) / (2 * dt) - motion.acceleration[i]) <
            bound);
}

TEST_CASE("the same wave as acceleration, velocity and displacement gives the same motion", "[boundaries]")
{
  const double w = 4, dt = 0.01; // u = (1 - cos w t)^3 starts and ends at rest with u = v = a = 0
  const auto u = [w](double t) { return std::pow(1 - std::cos(w * t), 3); };
  const auto v = [w](double t) { return 3 * w * std::pow(1 - std::cos(w * t), 2) * std::sin(w * t); };
  const auto a = [w](double t)
  {
    const double c = std::cos(w * t), s = std::sin(w * t);
    return 3 * w * w * (2 * (1 - c) * s * s + (1 - c) * (1 - c) * c);
  };
  const auto from_a = make_ground_motion(record_of(a, dt, 500), untouched());
  const auto from_v = make_ground_motion(record_of(v, dt, 500, Quantity::velocity), untouched());
  const auto from_u = make_ground_motion(record_of(u, dt, 500, Quantity::displacement), untouched());
  // Trapezoid: dt^2/12 |a'| < dt^2/12 * 3 w |a|; differences of 4th order err by far less.
  const double bound = dt * dt / 12 * (3 * w) * largest(from_a.acceleration) * 2;
  for (std::size_t i = 0; i < 500; ++i)
  {
    REQUIRE(std::abs(from_v.velocity[i] - from_a.velocity[i]) < bound);
    REQUIRE(std::abs(from_u.velocity[i] - from_a.velocity[i]) < bound);
  }
}

TEST_CASE("the high-pass halves its corner, keeps what is above and drops what is below, without delay",
          "[boundaries]")
{
  const double dt = 0.01, corner = 0.5;
  const auto gain_at = [&](double f)
  {
    const double w = 2 * pi * f;
    auto processing = untouched();
    processing.high_pass = corner;
    processing.taper = 0;
    const auto motion =
        make_ground_motion(record_of([w](double t) { return std::sin(w * t); }, dt, 20001), processing);
    double in_phase = 0, out_of_phase = 0; // over 100 s in the middle: whole periods
    for (std::size_t i = 5000; i < 15000; ++i)
    {
      in_phase += motion.acceleration[i] * std::sin(w * dt * double(i)) / 5000;
      out_of_phase += motion.acceleration[i] * std::cos(w * dt * double(i)) / 5000;
    }
    CHECK(std::abs(out_of_phase) < 1e-6);
    return in_phase;
  };
  const auto butterworth = [&](double f) { // bilinear: frequencies are warped by tan
    return 1 / (1 + std::pow(std::tan(pi * corner * dt) / std::tan(pi * f * dt), 8));
  };
  for (double f : {0.2, 0.5, 0.7, 5.0}) CHECK(gain_at(f) == Approx(butterworth(f)).margin(1e-6));
}

TEST_CASE("a high-pass does not set a motion adrift that came to rest by itself", "[boundaries]")
{
  // A wave packet at 2 Hz with 10 s of rest on either side: nothing of it lies near the corner of 0.1 Hz.
  const auto packet = [](double t)
  { return std::exp(-0.5 * std::pow(t - 15, 2)) * std::sin(4 * pi * (t - 15)); };
  MotionProcessing filtered;
  filtered.high_pass = 0.1;
  const auto record = record_of(packet, 0.01, 3001);
  const auto with = make_ground_motion(record, filtered), without = make_ground_motion(record, {});
  // (0.1 / 2)^8 = 4e-11 of the packet at 2 Hz; at the corner its spectrum is down by exp(-(2 pi 1.9)^2 / 2) =
  // 1e-31
  for (std::size_t i = 0; i < 3001; ++i) REQUIRE(std::abs(with.velocity[i] - without.velocity[i]) < 1e-9);
}

TEST_CASE("the report measures a sine in closed form", "[boundaries]")
{
  const double w = 2 * pi, peak = 2;
  const auto motion = make_ground_motion(
      record_of([=](double t) { return peak * std::sin(w * t); }, 0.01, 2001), untouched());
  CHECK(motion.report.corrected.pga == Approx(peak).epsilon(1e-12)); // a sample lies on the crest
  // Trapezoidal v is the closed form (1 - cos w t) / w times 1 - (w dt)^2 / 12.
  CHECK(motion.report.corrected.pgv == Approx(2 * peak / w).epsilon(4e-4));
  CHECK(motion.report.corrected.final_displacement == Approx(peak / w * 20).epsilon(4e-4));
  CHECK(motion.report.corrected.arias ==
        Approx(pi / (2 * standard_gravity) * peak * peak / 2 * 20).epsilon(1e-12));
  CHECK(motion.report.corrected.d5_95 ==
        Approx(18).margin(0.03)); // whole samples, crossed during a half period
}

TEST_CASE("scaling a record scales its motion", "[boundaries]")
{
  const auto record = record_of([](double t) { return std::sin(5 * t) + 0.1; }, 0.01, 1000);
  MotionProcessing processing, doubled;
  doubled.scale = 2;
  const auto one = make_ground_motion(record, processing), two = make_ground_motion(record, doubled);
  for (std::size_t i = 0; i < 1000; ++i)
    REQUIRE(two.velocity[i] == 2 * one.velocity[i]); // a power of 2 is exact
}

TEST_CASE("settings that do not fit a record are refused with the reason", "[boundaries]")
{
  const auto record = record_of([](double t) { return std::sin(t); }, 0.01, 101);
  const auto refused = [&](auto change)
  {
    Record changed = record;
    MotionProcessing processing;
    change(changed, processing);
    try
    {
      make_ground_motion(changed, processing);
    }
    catch (const std::runtime_error& error)
    {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(refused([](Record&, MotionProcessing& p) { p.taper = 0.6; }), Catch::Contains("taper of 0.6 s"));
  CHECK_THAT(refused([](Record&, MotionProcessing& p) { p.high_pass = 50; }), Catch::Contains("Nyquist"));
  CHECK_THAT(refused([](Record&, MotionProcessing& p) { p.high_pass = 1e-9; }), Catch::Contains("far below"));
  CHECK_THAT(refused([](Record&, MotionProcessing& p) { p.scale = NAN; }), Catch::Contains("scale"));
  CHECK_THAT(refused([](Record& r, MotionProcessing&) { r.dt = 0; }), Catch::Contains("dt is 0 s"));
  CHECK_THAT(refused([](Record& r, MotionProcessing&) { r.values[7] = NAN; }), Catch::Contains("value 8"));
  CHECK_THAT(refused([](Record& r, MotionProcessing&) { r.values.resize(3); }),
             Catch::Contains("only 3 values"));
}

TEST_CASE("names of settings go there and back, and within is not among them", "[boundaries]")
{
  for (Quantity q : {Quantity::acceleration, Quantity::velocity, Quantity::displacement})
    CHECK(quantity_from(name_of(q)) == q);
  for (RecordedAs r : {RecordedAs::outcrop, RecordedAs::upgoing}) CHECK(recorded_as_from(name_of(r)) == r);
  for (Baseline b : {Baseline::none, Baseline::linear, Baseline::quadratic, Baseline::cubic})
    CHECK(baseline_from(name_of(b)) == b);
  CHECK_FALSE(recorded_as_from("within"));
}

TEST_CASE("a wave that fades goes on unchanged until it does, and is at rest half a second later",
          "[boundaries]")
{
  IncomingWave wave;
  wave.horizontal = GroundMotion{1, {2, 2, 2, 2}, {0, 0, 0, 0}, {}};
  wave.fade.start = 1.2;
  CHECK(wave.velocity(1.2)[0] == 2);
  CHECK(wave.velocity(1.2 + Fade::length / 2)[0] == Approx(1));
  CHECK(wave.velocity(wave.fade.end())[0] == Approx(0).margin(1e-15));
  CHECK(wave.velocity(2.9)[0] == 0);
  CHECK(wave.velocity(2)[1] == 0);
}
