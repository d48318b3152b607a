#include "io/records/reader.hpp"

#include "test/io/record_texts.hpp"

using namespace mpm;
using namespace mpm::test;
using Values = std::vector<double>;

namespace
{
RecordSource source_of(std::string file = "record.AT2")
{
  return {std::move(file), "auto", NAN, "", {}};
}

RecordSource column_of(double dt = 0.005, std::string unit = "g")
{
  return {"record.txt", "column", dt, std::move(unit), {}};
}
} // namespace

TEST_CASE("an NGA-West2 record is read, with its trailing comma and missing leading zeros", "[io]")
{
  const auto record = parse_record("PEER NGA STRONG MOTION DATABASE RECORD\n"
                                   "Chi-Chi Taiwan, 9/20/1999, CHY080, E\n"
                                   "ACCELERATION TIME SERIES IN UNITS OF G\n"
                                   "NPTS=      3, DT=   .0050 SEC,                    \n"
                                   "  -.1480064E-03   .1486468E+00  -.1492857E-03\n",
                                   source_of());
  CHECK(record.format == "peer");
  CHECK(record.dt == 0.005);
  CHECK(record.quantity == Quantity::acceleration);
  check_values(record, {-.1480064e-3, .1486468, -.1492857e-3}, 9.80665);
}

TEST_CASE("a PEER SMD record is read, with filter points after its unit", "[io]")
{
  const auto record =
      parse_record("PEER STRONG MOTION DATABASE RECORD\n"
                   "LOMA PRIETA 10/18/89 00:05, GILROY ARRAY #6, 090 (CDMG STATION 57383)\n"
                   "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz LP=30. Hz\n"
                   "NPTS=  2, DT= .01000 SEC\n 0.1 0.2\n",
                   source_of("record.txt"));
  CHECK(record.dt == 0.01);
  check_values(record, {0.1, 0.2}, 9.80665);
}

TEST_CASE("an NGA 2005 header with its numbers before the keywords is read", "[io]")
{
  const auto record = parse_record("PEER NGA\nEVENT 1\nACCELERATION TIME HISTORY IN UNITS OF G\n"
                                   "    4    0.0100    NPTS, DT\n 1 2\n3 4\n",
                                   source_of());
  CHECK(record.dt == 0.01);
  check_values(record, {1, 2, 3, 4}, 9.80665);
}

TEST_CASE("prose that holds numbers above the header is not data", "[io]")
{
  const auto record = parse_record("Data for El Centro 1940 North South Component\n"
                                   "1559 points at equal spacing of 0.02 sec in the format of 8F10.5\n"
                                   "12 34 56\nThe units are (g)\n"
                                   "NPTS=  2, DT= .02000 SEC\n   0.00630   0.00364\n",
                                   source_of("record.txt"));
  CHECK(record.dt == 0.02);
  check_values(record, {0.0063, 0.00364}, 9.80665);
}

TEST_CASE("velocity and displacement records are told by extension or header, never taken as g", "[io]")
{
  const std::string header = "A\nB\nC\nNPTS= 2, DT= .01 SEC\n 10 20\n";
  const auto velocity = parse_record(header, source_of("record.VT2"));
  CHECK(velocity.quantity == Quantity::velocity);
  check_values(velocity, {10, 20}, 0.01);
  CHECK(parse_record(header, source_of("record.dt2")).quantity == Quantity::displacement);

  const std::string spoken = "A\nB\nVELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 2, DT= .01 SEC\n 10 20\n";
  CHECK(parse_record(spoken, source_of("record.txt")).quantity == Quantity::velocity);
  CHECK_THAT(refusal(spoken, source_of("record.AT2")),
             Catch::Contains("record.AT2:3: ") && Catch::Contains("cm/s"));
  auto as_g = source_of("record.txt");
  as_g.unit = "g";
  CHECK_THAT(refusal(spoken, as_g), Catch::Contains("the file is in cm/s and the case says g"));
  as_g.file = "record.VT2";
  CHECK_THAT(refusal(header, as_g), Catch::Contains("holds velocity"));
  CHECK_THAT(refusal(header, source_of("record.txt")), Catch::Contains("give unit"));
}

TEST_CASE("CR LF, tabs, blank lines, D exponents and touching values read as what they mean", "[io]")
{
  const auto record = parse_record("\xEF\xBB\xBF"
                                   "A\r\nB\r\nUNITS OF G\r\nNPTS=\t7, DT=\t.01 SEC\r\n\r\n"
                                   "-.1234567E-01-.1234567E-01\t1.5D-2\r\n\r\n\t+.5+.25 2. 3\r\n",
                                   source_of());
  check_values(record, {-.01234567, -.01234567, .015, .5, .25, 2, 3}, 9.80665);
}

TEST_CASE("values that touch without a sign are refused, for their border is a guess", "[io]")
{
  CHECK_THAT(refusal("A\nB\nUNITS OF G\nNPTS= 2, DT= .01 SEC\n0.123450.67890\n", source_of()),
             Catch::Contains("record.AT2:5: expected numbers and found '0.123450.67890'"));
}

TEST_CASE("fewer values than NPTS is an error with both numbers, more is padding", "[io]")
{
  CHECK_THAT(refusal("UNITS OF G\nNPTS= 5, DT= .01 SEC\n1 2 3\n", source_of()),
             Catch::Contains("record.AT2:2: NPTS is 5") && Catch::Contains("holds 3 values"));
  const auto padded = parse_record("UNITS OF G\nNPTS= 2, DT= .01 SEC\n1 2 0 0\n0 0\n", source_of());
  check_values(padded, {1, 2}, 9.80665);
  CHECK(padded.notes.size() == 1);
}

TEST_CASE("a dt in the case that contradicts the file is refused", "[io]")
{
  auto source = source_of();
  source.dt = 0.005;
  CHECK_THAT(refusal("UNITS OF G\nNPTS= 2, DT= .01 SEC\n1 2\n", source),
             Catch::Contains("0.01 s and the case says"));
  source.dt = 0.01;
  CHECK(parse_record("UNITS OF G\nNPTS= 2, DT= .01 SEC\n1 2\n", source).dt == 0.01);
}

TEST_CASE("a single column takes dt and unit from the case", "[io]")
{
  const auto record = parse_record("-3.52449E-5\n\n1.461E-4\n", column_of());
  CHECK(record.dt == 0.005);
  check_values(record, {-3.52449e-5, 1.461e-4}, 9.80665);
  CHECK(parse_record("acceleration\n1\n2\n", column_of()).values.size() == 2);
  CHECK_THAT(refusal("1\n2\n", column_of(NAN)), Catch::Contains("give dt"));
  CHECK_THAT(refusal("1\n2\n", column_of(0.01, "")), Catch::Contains("give unit"));
  CHECK_THAT(refusal("1\n2\n", column_of(0.01, "furlong")), Catch::Contains("unknown unit 'furlong'"));
  CHECK_THAT(refusal("1\n2 3\n", column_of()),
             Catch::Contains("record.txt:2: expected 1 number and found 2"));
  CHECK_THAT(refusal("1\n2\nend\n", column_of()),
             Catch::Contains("record.txt:3: ") && Catch::Contains("'end'"));
  CHECK_THAT(refusal("1\nnan\n", column_of()), Catch::Contains("record.txt:2: "));
  CHECK_THAT(refusal("1\n****\n", column_of()), Catch::Contains("record.txt:2: "));
}

TEST_CASE("units come out in SI, and a quantity that is not the unit's is refused", "[io]")
{
  const std::vector<std::pair<std::string, double>> units{{"g", 9.80665}, {"gal", 0.01},  {"cm/s2", 0.01},
                                                          {"m/s2", 1},    {"cm/s", 0.01}, {"m/s", 1},
                                                          {"cm", 0.01},   {"m", 1}};
  for (const auto& [unit, si] : units)
    check_values(parse_record("1\n2\n", column_of(0.01, unit)), {1, 2}, si);
  auto source = column_of(0.01, "cm/s");
  CHECK(parse_record("1\n2\n", source).quantity == Quantity::velocity);
  source.quantity = Quantity::acceleration;
  CHECK_THAT(refusal("1\n2\n", source), Catch::Contains("correct quantity or unit"));
}

TEST_CASE("two columns are read with blanks, commas or semicolons, and an optional header line", "[io]")
{
  RecordSource source{"record.csv", "two_column", NAN, "m/s2", {}};
  for (std::string text : {"0 1\n0.01 2\n0.02 -3\n", "0,1\n0.01,2\n0.02,-3\n", "0; 1\n0.01; 2\n0.02; -3\n",
                           "time (s), acceleration (m/s2)\n0, 1\n.01, 2\n.02, -3\n"})
  {
    const auto record = parse_record(text, source);
    CHECK(record.dt == Approx(0.01).epsilon(1e-15));
    check_values(record, {1, 2, -3}, 1);
    source.format = "auto";
    CHECK(parse_record(text, source).format == "two_column");
  }
  source.unit = "";
  check_values(parse_record("t [s]; a [gal]\n0;1\n1;2\n", source), {1, 2}, 0.01);
  CHECK(parse_record("t [s]; a [gal]\n5;1\n6;2\n", source).notes.size() == 1); // does not begin at 0
}

TEST_CASE("uneven time in two columns is refused at its line, rounded time is not", "[io]")
{
  const RecordSource source{"record.csv", "two_column", NAN, "g", {}};
  CHECK_THAT(refusal("0 1\n.01 2\n.02 3\n.04 4\n.05 5\n", source),
             Catch::Contains("record.csv:4: time goes"));
  CHECK_THAT(refusal("0 1\n.01 2\n.01 3\n.02 4\n", source), Catch::Contains("record.csv:3: "));
  CHECK_THAT(refusal("1 1\n.9 2\n.8 3\n", source), Catch::Contains("record.csv:2: "));
  std::string rounded; // 128 Hz printed to 1 ms
  for (int i = 0; i < 129; ++i) rounded += std::to_string(std::round(i / 0.128) / 1000).substr(0, 5) + " 1\n";
  CHECK(parse_record(rounded, source).dt == Approx(1. / 128).epsilon(1e-12));
}

TEST_CASE("a record that is missing or a folder is told from one that is bad", "[io]")
{
  CHECK(failure_of([] { read_record(source_of("/nowhere/record.AT2")); }).code == exit_code::input_missing);
  CHECK(failure_of([] { read_record(source_of(SOURCE_DIR)); }).code == exit_code::input_missing);
}

TEST_CASE("values that are no numbers in SI are refused, whatever the format", "[io]")
{
  // Of a finite number in a unit that is larger than one of SI.
  for (const char* text : {"1e308\n-1\n1\n", "-1.7e308\n0\n", "0\n2e307\n"})
    CHECK_THAT(refusal(text, {.file = "a.txt", .dt = 0.01, .unit = "g"}),
               Catch::Contains("beyond the numbers"));
  CHECK(parse_record("1e307\n-1\n", {.file = "a.txt", .dt = 0.01, .unit = "g"}).values.size() == 2);
}

TEST_CASE("the synthetic motion is at rest at its end, with the peak and duration it was made for", "[io]")
{
  const auto record = read_record(source_of(SOURCE_DIR "/cases/motions/synthetic.AT2"));
  CHECK(record.dt == 0.01);
  CHECK(record.values.size() == 4000);
  const auto report = make_ground_motion(record, {}).report;
  CHECK(report.warnings.empty());
  CHECK(report.corrected.pga / standard_gravity == Approx(0.25).margin(1e-4));
  CHECK(report.corrected.pgv == Approx(0.225).margin(0.025));
  CHECK(report.corrected.d5_95 == Approx(17.5).margin(2.5));
  // 4000 values of 7 digits after the first: each off by at most 5e-8 of up to 0.25 g
  CHECK(std::abs(report.recorded.final_velocity) < 1e-6);
  CHECK(std::abs(report.recorded.final_displacement) < 1e-5);
}
