// The only table of units of the case file. A unit belongs to one dimension, so that "5 s" for a length is
// refused and not converted.

#include "io/case/units.hpp"

#include "boundaries/ground_motion/ground_motion.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <numbers>
#include <vector>

namespace mpm
{
namespace
{
/// A unit that a case may use.
struct Unit
{
  std::string_view name;
  Dimension dimension;
  double factor; ///< SI value of one
};

// The first of a dimension is its SI unit.
constexpr std::array units{
    Unit{"m", Dimension::length, 1},
    Unit{"mm", Dimension::length, 1e-3},
    Unit{"cm", Dimension::length, 1e-2},
    Unit{"km", Dimension::length, 1e3},
    Unit{"m2", Dimension::area, 1},
    Unit{"cm2", Dimension::area, 1e-4},
    Unit{"s", Dimension::time, 1},
    Unit{"ms", Dimension::time, 1e-3},
    Unit{"min", Dimension::time, 60},
    Unit{"h", Dimension::time, 3600},
    Unit{"kg/m3", Dimension::density, 1},
    Unit{"g/cm3", Dimension::density, 1e3},
    Unit{"t/m3", Dimension::density, 1e3},
    Unit{"Pa", Dimension::stress, 1},
    Unit{"kPa", Dimension::stress, 1e3},
    Unit{"MPa", Dimension::stress, 1e6},
    Unit{"GPa", Dimension::stress, 1e9},
    Unit{"rad", Dimension::angle, 1},
    Unit{"deg", Dimension::angle, std::numbers::pi / 180},
    Unit{"m/s", Dimension::velocity, 1},
    Unit{"mm/s", Dimension::velocity, 1e-3},
    Unit{"cm/s", Dimension::velocity, 1e-2},
    Unit{"m/s2", Dimension::acceleration, 1},
    Unit{"cm/s2", Dimension::acceleration, 1e-2},
    Unit{"g", Dimension::acceleration, standard_gravity},
    Unit{"Hz", Dimension::frequency, 1},
};

std::string_view trimmed(std::string_view text)
{
  const auto from = text.find_first_not_of(" \t");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t") - from + 1);
}

/// "m/s^2" is written as often as "m/s2".
std::string without_carets(std::string_view text)
{
  std::string plain(text);
  std::erase(plain, '^');
  return plain;
}

/// The value in SI, or what to write instead.
Quantified convert(double number, std::string_view number_as_written, std::string_view unit,
                   Dimension dimension)
{
  const std::string written(number_as_written);
  if (dimension == Dimension::none)
  {
    if (unit.empty()) return {number, {}};
    return {0, "takes a bare number; '" + std::string(unit) + "' after it is not understood"};
  }
  if (unit.empty())
    return {0, "needs a unit: write '" + written + " " + std::string(usual_unit(dimension)) +
                   "'; units: " + units_of(dimension)};
  const std::string plain = without_carets(unit);
  for (const Unit& known : units)
    if (known.dimension == dimension && known.name == plain) return {number * known.factor, {}};
  return {0, "'" + std::string(unit) + "' is no unit of " + std::string(name_of(dimension)) +
                 "; units: " + units_of(dimension)};
}
} // namespace

Quantified parse_quantity(std::string_view text, Dimension dimension)
{
  // from_chars reads no leading +, and neither hexadecimal nor "1,5".
  const std::string_view all = trimmed(text);
  std::string_view rest = all;
  if (rest.size() > 1 && rest[0] == '+' && rest[1] != '-') rest.remove_prefix(1);
  double number = 0;
  const auto [end, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  const std::string quoted = "'" + std::string(all) + "'";
  if (failure == std::errc::result_out_of_range) return {0, quoted + " is beyond the numbers of the machine"};
  if (failure != std::errc{})
    return {0, quoted + " is not a number" +
                   (dimension == Dimension::none ? "" : " with a unit; units: " + units_of(dimension))};
  if (!std::isfinite(number)) return {0, quoted + " is not a finite number"};
  const std::string_view written(rest.data(), end - rest.data());
  const std::string_view unit = trimmed(rest.substr(written.size()));
  Quantified result = convert(number, written, unit, dimension);
  if (!std::isfinite(result.value)) return {0, quoted + " is beyond the numbers of the machine"};
  return result;
}

std::string units_of(Dimension dimension)
{
  std::vector<std::string_view> names;
  for (const Unit& unit : units)
    if (unit.dimension == dimension) names.push_back(unit.name);
  return either(names);
}

std::string_view si_unit(Dimension dimension)
{
  for (const Unit& unit : units)
    if (unit.dimension == dimension) return unit.name;
  return "";
}

std::string_view usual_unit(Dimension dimension)
{
  return dimension == Dimension::angle ? "deg" : si_unit(dimension);
}

std::string_view name_of(Dimension dimension)
{
  switch (dimension)
  {
  case Dimension::none:
    return "a pure number";
  case Dimension::length:
    return "length";
  case Dimension::area:
    return "area";
  case Dimension::time:
    return "time";
  case Dimension::density:
    return "density";
  case Dimension::stress:
    return "stress";
  case Dimension::angle:
    return "angle";
  case Dimension::velocity:
    return "velocity";
  case Dimension::acceleration:
    return "acceleration";
  case Dimension::frequency:
    return "frequency";
  }
  return "";
}

std::string number_text(double value)
{
  // The shortest that reads back (std::to_chars): 17 digits, a sign, a point and an exponent at most.
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string usual_quantity_text(double value, Dimension dimension)
{
  if (dimension != Dimension::angle) return quantity_text(value, dimension);
  return fmt::format("{:.12g} deg", value * 180 / std::numbers::pi);
}

std::string quantity_text(double value, Dimension dimension)
{
  const std::string_view unit = si_unit(dimension);
  std::string number = fmt::format("{:.15g}", value); // 40000000, not 4e+07
  // Fifteen digits do not always read back to the same number; the shortest text that does is used then.
  if (std::strtod(number.c_str(), nullptr) != value) number = number_text(value);
  return number + (unit.empty() ? "" : " " + std::string(unit));
}
} // namespace mpm
