#pragma once
// A recorded time series and the upgoing wave that is made of it for a compliant base.

#include "boundaries/ground_motion/measures.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mpm
{
/// What a record holds.
enum class Quantity
{
  acceleration,
  velocity,
  displacement,
};

/// Where it was recorded: on an outcrop of the base rock (v = 2 v_up, free surface), or the upgoing wave
/// itself.
enum class RecordedAs
{
  outcrop,
  upgoing,
};

/// How v(end) is brought to rest: a polynomial in t through the origin is subtracted from v (and its
/// derivative from a), fitted to v by least squares under the condition v(end) = 0. `linear` has no freedom
/// left: it removes the constant acceleration v(end) / T. `none` leaves the record as it is.
enum class Baseline
{
  none,
  linear,
  quadratic,
  cubic,
};

std::optional<Quantity> quantity_from(std::string_view name);
std::optional<RecordedAs> recorded_as_from(std::string_view name); ///< empty for `within`, see why_not_within
std::optional<Baseline> baseline_from(std::string_view name);
std::string_view name_of(Quantity quantity);
std::string_view name_of(RecordedAs recorded_as);
std::string_view name_of(Baseline baseline);

/// Why a record from a borehole is refused.
inline constexpr std::string_view why_not_within = "a within (borehole) motion holds the downgoing wave too, "
                                                   "which a compliant base makes itself; deconvolve it "
                                                   "to the upgoing wave, and give that as 'upgoing'";

/// A record as read: evenly spaced values in SI (m/s2, m/s or m), the first at t = 0.
struct Record
{
  std::string source; ///< file, for messages
  std::string format; ///< peer, column or two_column
  std::string unit;   ///< the unit it had in the file, e.g. "g"
  double dt = NAN;    ///< s
  Quantity quantity = Quantity::acceleration;
  std::vector<double> values;
  std::vector<std::string> notes;    ///< what the reader passed over, for the log
  std::vector<std::string> warnings; ///< what it doubts, likewise
  std::string component;             ///< as the file names it; empty if it does not
};

/// What is done to a record before it enters the base.
struct MotionProcessing
{
  RecordedAs recorded_as = RecordedAs::outcrop;
  Baseline baseline = Baseline::linear;
  double taper = NAN;   ///< s, cosine taper on v at both ends; NaN: 0.5 s, or 0 if nothing else is corrected
  double high_pass = 0; ///< Hz, corner (-6 dB) of a 4th order Butterworth run forth and back; 0: off (goes
                        ///< best with baseline none)
  double scale = 1;
};

/// What the record is, scaled, before and after its correction; measures are of the kind of the record, that
/// is before the halving of an outcrop.
struct MotionReport
{
  MotionMeasures recorded, corrected;
  SpectralChange spectrum; ///< by the correction
  double share = 1;        ///< of the record that goes up: a half of an outcrop
  int parts = 1; ///< of a step, between which the acceleration is straight: 8 where it comes of differences
  std::vector<std::string> warnings;
};

/// The upgoing wave: samples of v and of its slope a, the first at t = 0. Between samples v is the cubic
/// Hermite interpolant with a as slope, so that the far shorter steps of the solver meet no stair.
struct GroundMotion
{
  double dt = NAN;                  ///< s
  std::vector<double> velocity;     ///< m/s, upgoing
  std::vector<double> acceleration; ///< m/s2, upgoing
  MotionReport report;

  double duration() const { return velocity.empty() ? 0 : dt * double(velocity.size() - 1); } ///< s

  /// Step (s) of samples between which the acceleration may be taken as straight.
  double straight_step() const { return dt / report.parts; }
  /// v_up at time t in s: 0 up to the start, the last value after the end (0 unless baseline is none).
  double upgoing_velocity(double t) const;
  /// Slope of upgoing_velocity: 0 before the record's first and after its last sample.
  double upgoing_acceleration(double t) const;
};

/// `taper`, or what stands for it where it is left out.
double taper_of(const MotionProcessing& processing);

/// Makes the upgoing wave of a record: scale; high-pass with zero pads of 1.5 order / corner; trapezoidal
/// integration to v (pads included); baseline; tapers on v; half of it for an outcrop. An overall mean needs
/// no step of its own: it is removed before the filter, and otherwise it is part of the baseline. Velocity
/// and displacement records are differentiated to 4th order. Throws std::runtime_error where a setting does
/// not fit the record, or the motion goes beyond the numbers of the machine.
GroundMotion make_ground_motion(const Record& record, const MotionProcessing& processing);
} // namespace mpm
