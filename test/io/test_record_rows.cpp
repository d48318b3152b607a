// Rows of values as SHAKE reads them: which values they are, and what is refused.

#include "test/io/record_texts.hpp"

#include <cstdio>

using namespace mpm;
using namespace mpm::test;
using Catch::Contains;

namespace
{
std::vector<double> some_values()
{
  std::vector<double> values;
  for (int i = 0; i < 43; ++i) values.push_back(1e-6 * ((i * 7919) % 400001 - 200000));
  return values;
}

/// As (8F10.6) prints them, eight a line; `numbered` as (8F9.6,I8).
std::string rows_of(const std::vector<double>& values, bool numbered = false)
{
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    char number[24];
    std::snprintf(number, sizeof number, numbered ? "%9.6f" : "%10.6f", values[i]);
    text += number;
    if (i % 8 < 7 && i + 1 < values.size()) continue;
    std::snprintf(number, sizeof number, numbered ? "%8d\n" : "\n", int(i / 8 + 1));
    text += number;
  }
  return text;
}

const std::string header = "A STATION, 90 DEGREES\nMADE FOR A TEST\n";

RecordSource source()
{
  RecordSource named;
  named.file = "diamond.acc";
  named.format = "shake";
  named.dt = 0.02;
  named.unit = "g";
  return named;
}
} // namespace

TEST_CASE("rows of values are read one after the other, their numbering left out", "[io]")
{
  for (const bool numbered : {false, true})
  {
    const Record record = parse_record(header + rows_of(some_values(), numbered), source());
    CHECK(record.format == "shake");
    CHECK(record.dt == 0.02);
    REQUIRE(record.values.size() == some_values().size());
    for (std::size_t i = 0; i < record.values.size(); ++i)
      CHECK(record.values[i] == Approx(some_values()[i] * standard_gravity).margin(1e-12)); // all is printed
  }
}

TEST_CASE("rows of values that may be anything else are refused", "[io]")
{
  const std::string rows = rows_of(some_values());
  RecordSource automatic = source(), stepless = source(), unitless = source();
  automatic.format = "auto";
  stepless.dt = NAN;
  unitless.unit = "";
  CHECK_THAT(refusal(rows, automatic), Contains("format: shake"));
  CHECK_THAT(refusal(rows, stepless), Contains("give dt"));
  CHECK_THAT(refusal(rows, unitless), Contains("give unit"));
  CHECK_THAT(refusal("ACCELERATION IN UNITS OF GAL\n" + rows, source()), Contains("the case says g"));
  CHECK_THAT(refusal("DT = 0.01 SEC\n" + rows, source()), Contains("0.01"));
  CHECK_THAT(refusal("43 0.02\n" + rows, source()), Contains("line of numbers above the values"));
  CHECK_THAT(refusal(rows.substr(0, 100) + "\n" + rows.substr(100), source()), Contains("damaged row"));
  CHECK_THAT(refusal("0.1\n0.2\n0.3\n", source()), Contains("format: column"));
  CHECK_THAT(refusal(header + "  0.1 0.2\n  0.3 nan\n", source()), Contains("expected numbers"));
}
