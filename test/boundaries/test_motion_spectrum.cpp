#include "boundaries/ground_motion/spectrum.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace mpm;

namespace
{
constexpr double pi = std::numbers::pi;

template <class Function>
GroundMotion motion_of(Function a, double dt, double duration)
{
  GroundMotion motion;
  motion.dt = dt;
  for (double t = 0; t <= duration; t += dt)
  {
    motion.acceleration.push_back(a(t));
    motion.velocity.push_back(0);
  }
  return motion;
}
} // namespace

TEST_CASE("the Arias intensity of a Ricker wavelet above a frequency is the closed form's", "[boundaries]")
{
  // |A|^2 goes with f^4 exp(-2 f^2 / f0^2); with s = sqrt(2) f / f0 the share above s is
  // erfc(s) + (2 / sqrt(pi)) exp(-s^2) (s + 2 s^3 / 3).
  const double f0 = 3;
  const auto ricker = [=](double t)
  {
    const double b = std::pow(pi * f0 * (t - 2), 2);
    return (1 - 2 * b) * std::exp(-b);
  };
  const MotionSpectrum spectrum(motion_of(ricker, 0.005, 7));
  for (const double f : {0.5, 2.0, 3.3, 4.0, 6.0, 9.0})
  {
    const double s = std::sqrt(2.0) * f / f0;
    const double exact = std::erfc(s) + 2 / std::sqrt(pi) * std::exp(-s * s) * (s + 2 * s * s * s / 3);
    // Linear between lines 0.1 Hz apart: (0.1 Hz)^2 / 8 times the curvature of the share, below 0.5 / Hz^2.
    CHECK(std::fabs(spectrum.share_above(f) - exact) < 0.5 * 0.01 / 8);
    CHECK(spectrum.frequency_with_above(spectrum.share_above(f)) == Approx(f).epsilon(1e-9));
  }
}

TEST_CASE("of two sines each has the square of its amplitude", "[boundaries]")
{
  // Whole periods of both, 2048 samples: each is one line.
  const double dt = 1.0 / 128;
  const auto two = [](double t) { return 3 * std::sin(2 * pi * 2 * t) + std::cos(2 * pi * 10 * t); };
  const MotionSpectrum spectrum(motion_of(two, dt, 16 - dt / 2));
  CHECK(spectrum.share_above(0) == Approx(1));
  CHECK(spectrum.share_above(5) == Approx(0.1).epsilon(1e-9));
  CHECK(spectrum.share_above(20) == Approx(0).margin(1e-12));
}

TEST_CASE("a motion at rest has nothing above any frequency", "[boundaries]")
{
  const MotionSpectrum spectrum(motion_of([](double) { return 0; }, 0.01, 3));
  CHECK(spectrum.share_above(0) == 0);
  CHECK(spectrum.frequency_with_above(0.1) == 0);
}
