#pragma once
// How a constitutive law declares its parameters and state. The case reader, `--keys`, the checkpoint and the
// result files are driven by these tables, so a law names each of its quantities once.

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <string_view>

namespace mpm
{
/// Physical dimension of a number in a case file; fixes which units it may carry.
enum class Dimension
{
  none,
  length,
  area,
  time,
  density,
  stress,
  angle,
  velocity,
  acceleration,
  frequency,
};
inline constexpr Dimension last_dimension = Dimension::frequency;

/// Interval of possible values, in SI.
struct Interval
{
  double lower = -std::numeric_limits<double>::infinity();
  bool lower_allowed = true;
  double upper = std::numeric_limits<double>::infinity();
  bool upper_allowed = true;
  std::string_view reason = ""; ///< why no value beyond it will do, for the message that refuses one

  static constexpr Interval positive() { return {.lower = 0, .lower_allowed = false}; }
  static constexpr Interval not_negative() { return {.lower = 0}; }
  constexpr bool holds(double value) const
  {
    return (lower_allowed ? value >= lower : value > lower) &&
           (upper_allowed ? value <= upper : value < upper);
  }
};

/// One parameter of a constitutive law that is a number.
template <class Law>
struct Parameter
{
  std::string_view key;     ///< below `materials.NAME`; dots descend
  std::string_view meaning; ///< one line, for people
  Dimension dimension;
  Interval range;
  double Law::*value;              ///< where it is stored
  std::string_view otherwise = ""; ///< what holds when the key is left out, the member then keeping its
                                   ///< initial value; empty: the key is required
};

/// One parameter of a law that is a word out of a few.
template <class Law>
struct Choice
{
  std::string_view key;
  std::string_view meaning;                ///< one line, for people
  std::span<const std::string_view> names; ///< what the case file may say
  int Law::*value;                         ///< index among the names; the initial value if the key is absent
};

/// One table out of several, so that laws share what they have in common.
template <class Row, std::size_t... n>
constexpr std::array<Row, (n + ...)> joined(const std::array<Row, n>&... parts)
{
  std::array<Row, (n + ...)> all{};
  std::size_t filled = 0;
  ((std::copy(parts.begin(), parts.end(), all.begin() + filled), filled += n), ...);
  return all;
}

/// One history variable of a law: name in checkpoint and frames, unit, and a line of explanation.
struct StateField
{
  std::string_view name;
  std::string_view unit;
  std::string_view doc;
};
} // namespace mpm
