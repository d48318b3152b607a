#include "solver/stages/expected_error.hpp"

#include "boundaries/ground_motion/spectrum.hpp"
#include "io/case/profiles.hpp"
#include "solver/mpm/dispersion.hpp"
#include "solver/stages/fidelity.hpp"
#include "solver/stages/motion.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace mpm
{
namespace
{
// Calibrated on cases/verification, see README.md.
constexpr double passes = 2.6;       // ways through the ground that a wave's error adds up over
constexpr double ragged = 3.7;       // of surfaces and interfaces at a slant, times (h / wavelength)^order
constexpr double ragged_order = 1.4; // cases/verification/hill

// Run-out that is not passed in nine of ten cases, with ten cells across what slides, and its order;
// README.md.
constexpr double slope_error = 0.17, slope_order = 0.75;

/// Error of a slide on a layer so many cells thick whose friction weakens: with four cells and more it does
/// not fall any further; with fewer the two sides hold each other.
double on_a_layer(double cells, bool papers)
{
  constexpr double least = 3 * (1 - 1e-9), blocks = 0.19, blocks_papers = 0.76, too_thin = 1;
  return cells < least ? too_thin : papers ? blocks_papers : blocks;
}

/// A stretch of a wave's way: wave speed, m/s, and time, s.
struct Stretch
{
  double speed, time;
};

/// The slowest way from the base to the surface, by S or P waves.
std::vector<Stretch> slowest_way(const Case& case_file, double (Elastic::*speed)() const)
{
  constexpr int strips = 200;
  std::vector<Stretch> slowest;
  double longest = 0;
  for (int k = 0; k < strips; ++k)
  {
    const double width = case_file.domain.width() / strips, from = case_file.domain.left + k * width;
    std::vector<Stretch> way;
    double time = 0;
    for (const Layer& layer : case_file.layers(from, from + width))
    {
      const double c = (case_file.materials[case_file.regions[layer.region].material].elastic().*speed)();
      way.push_back({c, (layer.top - layer.bottom) / c});
      time += way.back().time;
    }
    if (time <= longest) continue;
    longest = time;
    slowest = std::move(way);
  }
  return slowest;
}

/// Error of a harmonic wave that has gone the way: it comes late by a phase and is damped, abs(1 - exp(-d + i
/// p)). From a quarter of a turn on the phase is any, and errors add up as those of waves with nothing in
/// common.
double harmonic_error(const Resolution& r, const std::vector<Stretch>& way, double frequency)
{
  double phase = 0, damped = 0;
  for (const Stretch& stretch : way)
  {
    const double radians = passes * 2 * std::numbers::pi * frequency * stretch.time;
    phase += radians * std::fabs(phase_error(r, stretch.speed, frequency));
    damped += radians * numerical_damping(r, stretch.speed, frequency);
  }
  return std::abs(1.0 - std::polar(std::exp(-damped), std::min(phase, std::numbers::pi / 2)));
}

/// Spectrum of the velocity's square, which is as that of the acceleration's.
MotionSpectrum velocity_spectrum(const GroundMotion& motion)
{
  GroundMotion velocity = motion;
  velocity.acceleration = motion.velocity;
  return MotionSpectrum(velocity);
}

/// Square of the error over all frequencies of a velocity, up to `highest` (Hz).
double spectral_error(const Resolution& r, const std::vector<Stretch>& way, const MotionSpectrum& spectrum,
                      double highest)
{
  constexpr int bands = 400;
  double sum = 0;
  for (int k = 0; k < bands; ++k)
  {
    const double from = highest * k / bands, to = highest * (k + 1) / bands;
    sum += (spectrum.share_above(from) - spectrum.share_above(to)) *
           std::pow(harmonic_error(r, way, (from + to) / 2), 2);
  }
  return sum;
}

/// Error that surfaces at a slant add to waves of this speed (m/s) and frequency (Hz): they are resolved by
/// cells beside the wavelength.
double slant_error(const Case& case_file, double speed, double frequency)
{
  if (scales_of(case_file).level) return 0;
  return ragged * std::pow(case_file.grid.spacing * frequency / speed, ragged_order);
}
} // namespace

char ExpectedError::letter() const
{
  if (!unknown.empty()) return '?';
  return static_cast<char>(
      'A' + std::ranges::count_if(error_classes, [this](double bound) { return share >= bound; }));
}

ExpectedError expected_wave_error(const Case& case_file, double dt, const IncomingWave& wave)
{
  if (!wave.horizontal && !wave.vertical) return {NAN, "nothing enters at the base"};
  const bool shear = wave.horizontal.has_value();
  const GroundMotion& motion = shear ? *wave.horizontal : *wave.vertical;
  const SeismicSettings& seismic = case_file.seismic;
  const GroundMotion applied =
      sampled(motion, planned_fade(seismic.motion), motion.dt, std::min(seismic.duration, motion.duration()));
  const auto way = slowest_way(case_file, shear ? &Elastic::shear_speed : &Elastic::pressure_speed);
  const MotionSpectrum spectrum = velocity_spectrum(applied);
  const double slowest = std::ranges::min(way, {}, &Stretch::speed).speed,
               slant = slant_error(case_file, slowest, spectrum.frequency_with_above(0.5));
  return {std::sqrt(spectral_error(resolution_of(case_file, dt), way, spectrum, 0.5 / applied.dt) +
                    slant * slant),
          {}};
}

// Which errors were measured: run-out of slopes of clay that softens across a band (cases/slope,
// cases/first), and slip on a layer whose friction weakens (cases/verification/finite_block and
// weakening_slope).
ExpectedError expected_run_out_error(const Case& case_file)
{
  const Scales scales = scales_of(case_file);
  if (!scales.slide.known()) return {NAN, "nothing that can yield stands at a slope"};
  bool softens = false, slips = false;
  for (const Material& material : case_file.materials)
  {
    softens |= material.model() == VonMises::model && material.averaging_length() > 0;
    slips |= material.model() == SlipWeakening::model;
  }
  const bool papers = case_file.seismic.transfer == Transfer::apic;
  const double h = case_file.grid.spacing;
  if (slips) return {on_a_layer(scales.layer.value / h, papers), {}};
  if (!softens) return {NAN, "it was measured for clay that softens by a displacement and for weak layers"};
  const double finer = scales.slide.value / h / 10;
  return {papers ? 0.65 * std::pow(finer, -0.7) : slope_error * std::pow(finer, -slope_order), {}};
}
} // namespace mpm
