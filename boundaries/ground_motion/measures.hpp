#pragma once
// What engineers measure of a ground motion.

#include <vector>

namespace mpm
{
inline constexpr double standard_gravity =
    9.80665; ///< 1 g in m/s2, the unit of records (not the case's gravity)

struct MotionMeasures
{
  double pga = 0;                ///< m/s2
  double pga_time = 0;           ///< s
  double pgv = 0;                ///< m/s
  double pgd = 0;                ///< m
  double arias = 0;              ///< m/s, pi / (2 g) times the integral of a^2
  double d5_95 = 0;              ///< s, from 5 to 95 % of the Arias intensity
  double final_velocity = 0;     ///< m/s, at the last sample
  double final_displacement = 0; ///< m, at the last sample

  /// Whether all are numbers.
  bool finite() const;
};

/// Measures of samples of v (m/s) and of its slope a (m/s2), `dt` s apart, the displacement from 0 on. They
/// are those of `factor` times the motion: 2 makes an outcrop motion of an upgoing wave.
MotionMeasures measure(const std::vector<double>& v, const std::vector<double>& a, double dt,
                       double factor = 1);

/// 5 % is what spectra of ground motions are drawn for.
inline constexpr double usual_damping = 0.05;

/// Pseudo-acceleration spectrum w^2 max |u| (m/s2) at the periods (s): u'' + 2 xi w u' + w^2 u = -a, at rest
/// at the first sample, in exact steps for an acceleration that is linear between samples (Nigam and
/// Jennings, Bull. Seismol. Soc. Am. 59 (1969) 909), of at most a twentieth of the period, so that at
/// most 1.2 % of a peak is missed.
std::vector<double> response_spectrum(const std::vector<double>& a, double dt,
                                      const std::vector<double>& periods, double damping = usual_damping);

/// How far two spectra lie apart between 0.05 s (two steps of the record, where that is more) and 4 s.
struct SpectralChange
{
  double mean = 0;     ///< of |ln(Sa / Sa)|, over the logarithm of the period
  double greatest = 0; ///< of |ln(Sa / Sa)|
  double period = 0;   ///< where, s
};
SpectralChange spectral_change(const std::vector<double>& before, const std::vector<double>& after,
                               double dt);
} // namespace mpm
