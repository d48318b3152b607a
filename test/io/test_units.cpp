#include "io/case/units.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace mpm;

TEST_CASE("Numbers with units become SI", "[io]")
{
  CHECK(parse_quantity("0.25 m", Dimension::length).value == 0.25);
  CHECK(parse_quantity("25 cm", Dimension::length).value == 0.25);
  CHECK(parse_quantity("10 m2", Dimension::area).value == 10);
  CHECK(parse_quantity("50 cm^2", Dimension::area).value == Approx(0.005));
  CHECK(parse_quantity("40 MPa", Dimension::stress).value == 40e6);
  CHECK(parse_quantity("2200 kg/m3", Dimension::density).value == 2200);
  CHECK(parse_quantity("2200kg/m^3", Dimension::density).value == 2200);
  CHECK(parse_quantity(" 2.2  t/m3 ", Dimension::density).value == Approx(2200));
  CHECK(parse_quantity("38.5 deg", Dimension::angle).value == Approx(38.5 * std::numbers::pi / 180));
  CHECK(parse_quantity("10 min", Dimension::time).value == 600);
  CHECK(parse_quantity("9.81 m/s2", Dimension::acceleration).value == 9.81);
  CHECK(parse_quantity("1 g", Dimension::acceleration).value == 9.80665);
  CHECK(parse_quantity("0.1 Hz", Dimension::frequency).value == 0.1);
  CHECK(parse_quantity("-1.5e-3 m/s", Dimension::velocity).value == -1.5e-3);
  CHECK(parse_quantity("+0.35", Dimension::none).value == 0.35);
}

TEST_CASE("A bare number where a unit belongs is answered with the text to write", "[io]")
{
  CHECK(parse_quantity("1800", Dimension::density).problem ==
        "needs a unit: write '1800 kg/m3'; units: kg/m3, g/cm3 or t/m3");
  CHECK(parse_quantity("14", Dimension::angle).problem == "needs a unit: write '14 deg'; units: rad or deg");
}

TEST_CASE("A unit of another dimension is refused with the allowed ones", "[io]")
{
  CHECK(parse_quantity("40 m", Dimension::stress).problem ==
        "'m' is no unit of stress; units: Pa, kPa, MPa or GPa");
  CHECK(parse_quantity("40 mpa", Dimension::stress).problem.find("MPa") != std::string::npos);
  CHECK_FALSE(parse_quantity("0.3 m", Dimension::none).problem.empty());
}

TEST_CASE("What is no finite number is refused", "[io]")
{
  for (const char* text :
       {"nan m", "inf m", "-inf m", "1e400 m", "1e306 km", "m", "", " ", "1,5 m", "+-1 m", "0x10 m"})
  {
    CAPTURE(text);
    CHECK_FALSE(parse_quantity(text, Dimension::length).problem.empty());
  }
}

TEST_CASE("A number's text reads back as the same number", "[io]")
{
  for (const double value : {0.1, 1.0 / 3, -2e-300, 1e22}) CHECK(std::stod(number_text(value)) == value);
}
