#pragma once
// The wave that enters at the base, and what of it a run applies.

#include "boundaries/ground_motion/ground_motion.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <optional>

namespace mpm
{
/// How a wave ends before its record does: its velocity fades like a cosine over `length` from `start` on.
struct Fade
{
  static constexpr double length = 0.5;                   ///< s
  double start = std::numeric_limits<double>::infinity(); ///< s

  double end() const { return start + length; }
  /// What is left of the velocity at `t` in s.
  double share(double t) const { return 0.5 + 0.5 * std::cos(std::numbers::pi * passed(t)); }
  /// Slope of `share`, 1/s.
  double slope(double t) const
  {
    return -0.5 * std::numbers::pi / length * std::sin(std::numbers::pi * passed(t));
  }

private:
  /// Part of the fade that is over at `t`, 0 to 1.
  double passed(double t) const { return std::clamp((t - start) / length, 0.0, 1.0); }
};

/// The upgoing wave that enters at the base: S (horizontal) and P (vertical) part, each of them optional.
struct IncomingWave
{
  std::optional<GroundMotion> horizontal, vertical;
  Fade fade;

  /// When the longer record ends, s.
  double records_end() const
  {
    const auto duration = [](const std::optional<GroundMotion>& motion)
    { return motion ? motion->duration() : 0; };
    return std::max(duration(horizontal), duration(vertical));
  }
  /// When nothing comes any more, s.
  double end() const { return std::min(records_end(), fade.end()); }
  std::array<double, 2> velocity(double t) const
  {
    const double share = fade.share(t);
    return {horizontal ? share * horizontal->upgoing_velocity(t) : 0,
            vertical ? share * vertical->upgoing_velocity(t) : 0};
  }
};

/// How many samples, `step` s apart, there are from 0 to `until` s.
std::size_t sample_count(double step, double until);

/// Samples of a motion as a run applies it: with the fade, every `step` s from 0 on and not beyond `until` s.
GroundMotion sampled(const GroundMotion& motion, const Fade& fade, double step, double until);

/// A step in s at which samples of the wave leave out none of its records' own, nor bends of acceleration in
/// between: the greatest that divides the straight steps of both; a twentieth of the smaller one where there
/// is none above that. 0: there is no record.
double common_step(const IncomingWave& wave);
} // namespace mpm
