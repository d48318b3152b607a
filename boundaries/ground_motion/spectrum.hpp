#pragma once

#include "boundaries/ground_motion/ground_motion.hpp"

namespace mpm
{
/// How the Arias intensity of a motion is spread over the frequencies. By Parseval's theorem the integral of
/// a^2 over time, which the intensity is proportional to, is that of |A(f)|^2 over frequency.
class MotionSpectrum
{
public:
  /// Of the motion as it enters the base; a motion at rest has nothing above any frequency.
  explicit MotionSpectrum(const GroundMotion& motion);

  /// Share of the Arias intensity above `frequency` (Hz), 0 to 1.
  double share_above(double frequency) const;
  /// Frequency in Hz above which this share of the intensity lies.
  double frequency_with_above(double share) const;

private:
  double resolution_ = 0; ///< Hz between the lines of the spectrum
  std::vector<double>
      share_below_; ///< entry k: of all lines before line k, which reaches from k - 1/2 to k + 1/2
};
} // namespace mpm
