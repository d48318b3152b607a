#include "boundaries/ground_motion/incoming_wave.hpp"

#include <catch2/catch.hpp>

using namespace mpm;

namespace
{
constexpr double pi = std::numbers::pi;

template <class Function>
std::vector<double> series(Function f, double dt, int count)
{
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(f(dt * i));
  return values;
}

GroundMotion motion_of(double dt, int count)
{
  const auto v = [](double t) { return std::sin(3 * t); };
  const auto a = [](double t) { return 3 * std::cos(3 * t); };
  return {dt, series(v, dt, count), series(a, dt, count), {}};
}
} // namespace

TEST_CASE("a harmonic at an oscillator's own period is amplified by 1 / (2 xi)", "[boundaries]")
{
  // 40 cycles leave exp(-2 pi 0.05 40) of the transient; 100 samples a cycle miss 1 - cos(pi / 100) of a
  // peak, and their chords are low by (2 pi / 100)^2 / 12.
  const double period = 0.5, dt = period / 100;
  const auto a = series([=](double t) { return std::sin(2 * pi * t / period); }, dt, 4001);
  const double bound =
      std::exp(-2 * pi * 0.05 * 40) + 1 - std::cos(pi / 100) + std::pow(2 * pi / 100, 2) / 12;
  CHECK(response_spectrum(a, dt, {period})[0] * 2 * 0.05 == Approx(1).epsilon(bound));
}

TEST_CASE("an oscillator's answer to a constant acceleration is the closed form's", "[boundaries]")
{
  // At rest, then a = 1 from the first sample on: greatest w^2 u = 1 + exp(-xi pi / sqrt(1 - xi^2)), which
  // steps of a twentieth of the period miss by less than (pi / 20)^2 / 2 of the part that swings.
  const auto a = series([](double) { return 1.; }, 0.01, 501);
  for (const double period : {0.1, 0.7, 2.5})
    CHECK(response_spectrum(a, 0.01, {period})[0] ==
          Approx(1 + std::exp(-0.05 * pi / std::sqrt(1 - 0.05 * 0.05))).margin(0.0124));
}

TEST_CASE("a stiff oscillator feels the ground's acceleration", "[boundaries]")
{
  const auto a = series([](double t) { return 2 * std::sin(t) * std::sin(t); }, 0.01, 1001);
  CHECK(response_spectrum(a, 0.01, {0.02})[0] == Approx(2).epsilon(2e-3)); // 2 xi a' / w and chords
}

TEST_CASE("two spectra lie apart by the logarithm of what scales one to the other", "[boundaries]")
{
  const auto a = series([](double t) { return std::exp(-t) * std::sin(9 * t); }, 0.01, 1001);
  auto more = a;
  for (double& value : more) value *= 1.25;
  const SpectralChange change = spectral_change(a, more, 0.01);
  CHECK(change.mean == Approx(std::log(1.25)).epsilon(1e-12));
  CHECK(change.greatest == Approx(std::log(1.25)).epsilon(1e-12));
  CHECK(spectral_change(a, a, 0.01).greatest == 0);
  CHECK(spectral_change(a, std::vector<double>(a.size(), 0.0), 0.01).mean == 0);
}

TEST_CASE("measures of a constant acceleration are the closed forms, of an outcrop twice the wave's",
          "[boundaries]")
{
  const auto v = series([](double t) { return 2 * t; }, 0.01, 1001),
             a = series([](double) { return 2.; }, 0.01, 1001);
  const MotionMeasures m = measure(v, a, 0.01), outcrop = measure(v, a, 0.01, 2);
  CHECK(m.pga == 2);
  CHECK(m.pgv == Approx(20));
  CHECK(m.pgd == Approx(100));
  CHECK(m.arias == Approx(pi / (2 * standard_gravity) * 4 * 10));
  CHECK(m.d5_95 == Approx(9));
  CHECK(outcrop.pga == 4);
  CHECK(outcrop.pgd == Approx(200));
  CHECK(outcrop.arias == Approx(4 * m.arias));
  CHECK(outcrop.d5_95 == m.d5_95);
}

TEST_CASE("a motion is applied until the run ends, sample by sample, and fades where it is ended",
          "[boundaries]")
{
  const GroundMotion motion = motion_of(0.01, 1001);
  const GroundMotion cut = sampled(motion, {}, motion.dt, 4);
  REQUIRE(cut.velocity.size() == 401);
  for (std::size_t i = 0; i < 401; ++i)
  {
    REQUIRE(cut.velocity[i] == Approx(motion.velocity[i]).margin(1e-14));
    REQUIRE(cut.acceleration[i] == Approx(motion.acceleration[i]).margin(1e-12));
  }
  CHECK(sampled(motion, {}, motion.dt, 20).acceleration.size() == 2001);
  CHECK(sampled(motion, {}, motion.dt, 10).acceleration.back() == motion.acceleration.back());
  CHECK(sampled(motion, {}, motion.dt, 20).acceleration.back() == 0);

  // The slope of what fades is its acceleration: central differences err by dt^2 / 6 v''' < dt^2 / 6 (3 + 2
  // pi)^3 and, where the fade begins and ends, by dt / 4 of the jump of v'': (2 pi)^2 / 2.
  const GroundMotion faded = sampled(motion, Fade{4.2}, 0.001, 6);
  const double bound = 1e-6 / 6 * std::pow(3 + 2 * pi, 3) + 0.001 / 4 * 20;
  for (std::size_t i = 1; i + 1 < faded.velocity.size(); ++i)
    REQUIRE(std::abs((faded.velocity[i + 1] - faded.velocity[i - 1]) / 0.002 - faded.acceleration[i]) <
            bound);
  CHECK(faded.velocity.back() == Approx(0).margin(1e-15));
}

TEST_CASE("samples of two records have a step that leaves out none of either's", "[boundaries]")
{
  const auto step = [](double one, double other)
  {
    IncomingWave wave;
    wave.horizontal = motion_of(one, 5);
    wave.vertical = motion_of(other, 5);
    return common_step(wave);
  };
  CHECK(step(0.01, 0.01) == 0.01);
  CHECK(step(0.02, 0.005) == 0.005);
  CHECK(step(0.004, 0.005) == Approx(0.001));
  CHECK(step(0.01, 0.004) == Approx(0.002));
  CHECK(step(0.01, 0.01 / pi) == Approx(0.01 / pi / 20));
  IncomingWave alone;
  CHECK(common_step(alone) == 0);
  alone.vertical = motion_of(0.005, 5);
  CHECK(common_step(alone) == 0.005);
}

TEST_CASE("between samples of a wave its acceleration is straight, of a velocity record's too",
          "[boundaries]")
{
  // A packet at 5 Hz in steps of 20 ms. Chords of acceleration miss (w step)^2 / 12 of the velocity: nothing
  // where the velocity was made of them, 0.05 % with an eighth of the step (3.3 % with the whole).
  for (const Quantity quantity : {Quantity::acceleration, Quantity::velocity})
  {
    Record record{"test", "column", "", 0.02, quantity, {}, {}};
    for (int i = 0; i <= 400; ++i)
      record.values.push_back(std::exp(-std::pow(0.02 * i - 4, 2)) * std::sin(10 * pi * (0.02 * i - 4)));
    MotionProcessing untouched;
    untouched.baseline = Baseline::none;
    IncomingWave wave;
    wave.horizontal = make_ground_motion(record, untouched);
    const double step = common_step(wave);
    const GroundMotion samples = sampled(*wave.horizontal, {}, step, 8);
    double v = 0, off = 0, most = 0;
    for (std::size_t i = 1; i < samples.velocity.size(); ++i)
    {
      v += 0.5 * step * (samples.acceleration[i - 1] + samples.acceleration[i]);
      off = std::max(off, std::abs(v - samples.velocity[i] + samples.velocity[0]));
      most = std::max(most, std::abs(samples.velocity[i]));
    }
    CHECK(step == (quantity == Quantity::acceleration ? 0.02 : 0.0025));
    CHECK(off < (quantity == Quantity::acceleration ? 1e-12 : 1e-3) * most);
  }
}
