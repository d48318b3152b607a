#pragma once

#include "materials/parameter.hpp"

#include <string>
#include <string_view>

namespace mpm
{
/// A number read with its unit: the value in SI (angles in rad), or what is wrong with the text.
struct Quantified
{
  double value = 0;
  std::string problem; ///< empty: none. Reads on after the key: "needs a unit: write '1800 kg/m3'"
};

/// Reads "0.25 m", "40 MPa", "38.5 deg", and for Dimension::none "0.35". Powers may be written m/s2 or m/s^2.
Quantified parse_quantity(std::string_view text, Dimension dimension);

/// The units that a dimension may carry, for messages: "Pa, kPa, MPa or GPa".
std::string units_of(Dimension dimension);
/// The unit in which people write its values, degrees instead of radians; empty for a pure number.
std::string_view usual_unit(Dimension dimension);
/// The unit in which its values are kept: "Pa"; empty for a pure number.
std::string_view si_unit(Dimension dimension);
/// "length", for messages and --keys.
std::string_view name_of(Dimension dimension);

/// The shortest text that reads back as the same number.
std::string number_text(double value);
/// The same with the SI unit of the dimension: "70000 Pa".
std::string quantity_text(double value, Dimension dimension);
/// A number in SI with the unit in which people write it, rounded to 12 digits: "90 deg".
std::string usual_quantity_text(double value, Dimension dimension);
/// "a, b or c".
template <class Names>
std::string either(const Names& names)
{
  std::string text;
  std::size_t left = std::size(names);
  for (const auto& name : names)
  {
    text += name;
    if (--left) text += left == 1 ? " or " : ", ";
  }
  return text;
}
} // namespace mpm
