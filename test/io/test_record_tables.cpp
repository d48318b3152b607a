// Columns of numbers below comments, a heading or a count: what they say, and that it is one thing.

#include "test/io/record_texts.hpp"

using namespace mpm;
using namespace mpm::test;
using Catch::Contains;

namespace
{
RecordSource source_of(std::string file = "r.AT2", double dt = NAN, std::string unit = "")
{
  return {std::move(file), "auto", dt, std::move(unit), {}};
}

constexpr double g = standard_gravity;
} // namespace

TEST_CASE("comments and headings of columns are read, and contradict no option", "[io]")
{
  const std::string rows = "0.00, 1\n0.01, 2\n0.02, -3\n";
  const auto csv = [](std::string unit = "", double dt = NAN)
  { return source_of("r.csv", dt, std::move(unit)); };
  for (std::string head :
       {"# Time (s), Acceleration (cm/s2)\n", "time (s), NS (cm/s/s)\n", "% units: gal\n", "t, a_gal\n",
        "sec, gal\n", "# acceleration in cm/s/s\n", "time, a(t) (gal)\n", "time (s), acc (station 5) (gal)\n",
        "time [s]; acc [cm/sec^2]\n", "Time (s)\tAcc (gal)\n", "t (s) a (gal)\n",
        "# a record of 2001\n# UNITS OF CM/S/S\ntime, acc\n"})
  {
    INFO(head);
    check_values(parse_record(head + rows, csv()), {1, 2, -3}, .01);
    check_values(parse_record(head + rows, csv("cm/s2", 0.01)), {1, 2, -3}, .01);
    CHECK_THAT(refusal(head + rows, csv("m/s2")), Contains("the case says m/s2"));
    CHECK_THAT(refusal(head + rows, csv("", 0.02)), Contains("0.01 s and the case says 0.02 s"));
  }
  CHECK_THAT(refusal("# units: g\ntime (s), a (gal)\n" + rows, csv()),
             Contains("r.csv:1: states the unit g, and line 2 gal"));
  CHECK_THAT(refusal("# dt = 0.02 s\n" + rows, csv("g")), Contains("states a time step of 0.02 s"));
  CHECK_THAT(refusal("time (s), velocity (g)\n" + rows, csv()), Contains("do not go together"));
  CHECK(parse_record("# dt: 5 ms, units: gal\n1\n2\n", csv()).dt == 0.005);
  CHECK(parse_record("# Sampling rate (Hz): 200\n1\n2\n", csv("g")).dt == 0.005);
  CHECK_THAT(refusal("# dt = 10\n1\n2\n", csv("g")), Contains("a time step of 10 without a unit"));
  CHECK_THAT(refusal("# dt: 5 ms\n1\n2\n", csv("g", 0.01)),
             Contains("r.csv:1: states a time step of 0.005 s"));
}

TEST_CASE("the time column is read with its unit, and an index is no time", "[io]")
{
  const auto csv = source_of("r.csv", NAN, "g");
  for (std::string head :
       {"time (ms), acc (g)\n", "t_ms, a\n", "# time [msec], acc [g]\n", "ms, g\n", "Time in ms; a in g\n"})
  {
    INFO(head);
    const auto record = parse_record(head + "0, 1\n10, 2\n20, -3\n", csv);
    CHECK(record.dt == Approx(0.01).epsilon(1e-15));
    check_values(record, {1, 2, -3}, g);
  }
  CHECK_THAT(refusal("# minutes, acc (g)\n0,1\n0.01,2\n", csv),
             Contains("r.csv:1: calls the first column 'minutes'"));
  CHECK_THAT(refusal("n, acc (g)\n0,1\n1,2\n2,3\n", csv), Contains("r.csv:1: calls the first column 'n'"));
  CHECK_THAT(refusal("0,1\n1,2\n2,3\n", csv), Contains("the first column counts 0, 1"));
  CHECK_THAT(refusal("0 1\n10 2\n20 3\n", csv), Contains("counts 0, 10"));
  CHECK_THAT(refusal("time (min), acc (g)\n0,1\n1,2\n", csv), Contains("the unit of time as 'min'"));
  CHECK_THAT(refusal("acc NS (g), acc EW (g)\n0,1\n1,2\n", csv), Contains("the unit of time as 'g'"));
}

TEST_CASE("the first line is a heading only where it looks like one", "[io]")
{
  const auto column = source_of("r.txt", .01, "g");
  const std::string rows = "0.5\n0.25\n-0.5\n0.125\n0.25\n0.0\n";
  for (std::string damaged : {"nan", "NaN", "inf", "-inf", "****", "-", "1.2.3", "O.5", "l.25", "0.x5", "1e",
                              "e-05", "0.5g", "N/A", "?", "x.1"})
  {
    INFO(damaged);
    CHECK_THAT(refusal(damaged + "\n" + rows, column), Contains("r.txt:1: "));
    CHECK_THAT(refusal("0.00 " + damaged + "\n0.01 2\n0.02 3\n", column), Contains("r.txt:1: "));
  }
  for (std::string heading : {"acceleration", "acc (g)", "Acceleration in g", "a", "g", "NS component"})
    CHECK(parse_record(heading + "\n" + rows, column).values.size() == 6);
}

TEST_CASE("a first line of count and time step is read, a wrong one refused", "[io]")
{
  const auto file = [](double dt = NAN) { return source_of("r.txt", dt, "g"); };
  const std::string rows = "0.5\n0.25\n-0.5\n0.125\n0.25\n0.0\n";
  for (std::string first : {"6 0.01", "6, 0.01", "  6   1.0E-2"})
  {
    const auto record = parse_record(first + "\n" + rows, file());
    CHECK(record.dt == 0.01);
    check_values(record, {.5, .25, -.5, .125, .25, 0}, g);
    CHECK_THAT(refusal(first + "\n" + rows, file(.02)), Contains("the case says 0.02"));
  }
  check_values(parse_record("6\n" + rows, file(.01)), {.5, .25, -.5, .125, .25, 0}, g);
  CHECK_THAT(refusal("7\n" + rows, file(.01)), Contains("looks like a count"));
  CHECK_THAT(refusal("400\n" + rows, file(.01)), Contains("looks like a count"));
  CHECK_THAT(refusal("7 0.01\n" + rows, file()), Contains("announces 7 values"));
  const std::string timed = "0.00 .5\n0.01 .25\n0.02 -.5\n0.03 .125\n0.04 .25\n";
  check_values(parse_record("5 0.01\n" + timed, file()), {.5, .25, -.5, .125, .25}, g);
  CHECK_THAT(refusal("5 0.02\n" + timed, file()), Contains("the first line says a time step of 0.02"));
  CHECK_THAT(refusal("6 0.01\n" + timed, file()), Contains("r.txt:"));
  CHECK_THAT(refusal("6.\n" + rows, file(.01)), Contains("looks like a count"));
  CHECK_THAT(refusal("6 10\n" + rows, file()), Contains("a time step of 10 without a unit"));
  CHECK_THAT(refusal("0.01\n" + rows, file(.01)), Contains("is the time step, not a value"));
  CHECK(parse_record("7\n3\n-2\n12\n", file(.01)).values.size() == 4); // whole numbers are values too
}

TEST_CASE("a component of several columns is chosen by its name", "[io]")
{
  const std::string text = "time (s), NS (gal), EW (gal), UD (g)\n0, 1, 4, 7\n.01, 2, 5, 8\n.02, 3, 6, 9\n";
  auto source = source_of("r.csv");
  CHECK_THAT(refusal(text, source), Contains("its components are NS (gal), EW (gal), UD (g); give one"));
  source.component = "ew";
  const auto record = parse_record(text, source);
  check_values(record, {4, 5, 6}, .01);
  CHECK(record.component == "EW (gal)");
  source.component = "UD";
  check_values(parse_record(text, source), {7, 8, 9}, g);
  source.component = "N45E";
  CHECK_THAT(refusal(text, source), Contains("'N45E' is not one"));
  CHECK_THAT(refusal("1\n2\n", source), Contains("names no components"));
  CHECK_THAT(refusal("0 1 2 3\n.01 1 2 3\n", source),
             Contains("4 numbers a line and nothing that names them"));
}
