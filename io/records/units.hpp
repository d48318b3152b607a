#pragma once
// Inside the record reader: units of what is recorded and of its time step, in the spellings of archives.

#include "boundaries/ground_motion/ground_motion.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace mpm::records
{
/// The units that messages offer.
inline constexpr std::string_view offered_units =
    "g, mg, %g, gal, m/s2, cm/s2, mm/s2, ft/s2, in/s2, m/s, cm/s, mm/s, m, cm or mm";

/// A unit that records come in.
struct RecordUnit
{
  std::string name; ///< as messages write it, e.g. "cm/s2"
  Quantity quantity;
  double si; ///< SI value of one

  bool operator==(const RecordUnit& other) const
  {
    return quantity == other.quantity && std::abs(si - other.si) <= 1e-9 * si;
  }
};

/// A unit as headers write it, in any case: g, G/10, %g, mg, gal, and lengths by themselves, over a time or
/// over its square, as in "CM/SEC**2", "Meters/Sec/Sec", "m s-2", "in/s^2", "cm/s²" (UTF-8 or Latin-1). Empty
/// if the text is anything else.
std::optional<RecordUnit> parse_unit(std::string_view text);

/// A unit of a time step, or of a sampling rate.
struct StepUnit
{
  double per_second; ///< units in a second; of a rate 1
  bool rate;         ///< Hz: the step is one over the number

  double seconds(double value) const { return rate ? 1 / value : value / per_second; }
};

/// "SEC", "ms", "MSEC.", "(s)", "Hz", "samples/sec"; empty if the text is anything else.
std::optional<StepUnit> parse_step_unit(std::string_view text);

/// Text without the blanks, brackets and quotes around it.
std::string_view bare(std::string_view text);
} // namespace mpm::records
