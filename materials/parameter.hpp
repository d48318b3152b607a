#pragma once
// How a constitutive law declares its parameters and state. The case reader, the checkpoint and the
// result files are driven by these tables, so a law names each of its quantities once.

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
  time,
  density,
  stress,
  angle,
  velocity,
  acceleration,
  frequency,
};

/// One parameter of a constitutive law: its key below `materials.NAME` (dots descend), its dimension,
/// the open or closed interval of possible values, and where it is stored.
template <class Law>
struct Parameter
{
  std::string_view key;
  Dimension dimension;
  double Law::*value;
  double lower = -std::numeric_limits<double>::infinity();
  bool lower_allowed = true;
  double upper = std::numeric_limits<double>::infinity();
  bool upper_allowed = true;
  bool required = true; ///< when false and the key is absent, the member keeps NaN or its initial value
  std::string_view doc = "";
};

/// One parameter of a law that is a word out of a few.
template <class Law>
struct Choice
{
  std::string_view key;
  std::span<const std::string_view> names; ///< what the case file may say
  int Law::*value;                         ///< index among the names; the initial value if the key is absent
};

/// One history variable of a law: name in checkpoint and frames, unit, and a line of explanation.
struct StateField
{
  std::string_view name;
  std::string_view unit;
  std::string_view doc;
};
} // namespace mpm
