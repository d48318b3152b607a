// What a record's header, comments, body and name say, and that they say one thing.

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

/// A PEER file of three values whose third line is `line`.
std::string peer(const std::string& line, const std::string& npts = "NPTS=  3, DT= .01000 SEC")
{
  return "PEER STRONG MOTION DATABASE RECORD\nEVENT 01/01/01, STATION, 090\n" + line + "\n" + npts +
         "\n  .1000000E+00 -.2000000E+00  .3000000E+00\n";
}

constexpr double g = standard_gravity;

/// A line of three components that change little from line to line.
std::string print_three(int i)
{
  return std::to_string(std::sin(.2 * i)) + " " + std::to_string(3 * std::cos(.1 * i)) + " " +
         std::to_string(-2 * std::sin(.15 * i));
}

struct Spelling
{
  std::string text;
  double si;
};
} // namespace

TEST_CASE("a unit that a header states is read in the spellings of archives", "[io]")
{
  const std::vector<Spelling> accelerations{{"G", g},
                                            {"g", g},
                                            {"(g)", g},
                                            {"G.", g},
                                            {"G's", g},
                                            {"G/10", g / 10},
                                            {"g/100", g / 100},
                                            {"MG", g / 1000},
                                            {"mg", g / 1000},
                                            {"%G", g / 100},
                                            {"% g", g / 100},
                                            {"GAL", .01},
                                            {"Gals", .01},
                                            {"GALS", .01},
                                            {"mgal", 1e-5},
                                            {"CM/S/S", .01},
                                            {"CM/SEC/SEC", .01},
                                            {"cm/sec2", .01},
                                            {"CM/SEC**2", .01},
                                            {"cm/s^2", .01},
                                            {"CMS/SEC/SEC", .01},
                                            {"cm s-2", .01},
                                            {"cm/sec squared", .01},
                                            {"cm per sec per sec", .01},
                                            {"cm/(s*s)", .01},
                                            {"M/S/S", 1},
                                            {"M/SEC2", 1},
                                            {"m/s²", 1},
                                            {"m/s\xB2", 1},
                                            {"m·s⁻²", 1},
                                            {"m s^-2", 1},
                                            {"m.s-2", 1},
                                            {"METERS/SEC/SEC", 1},
                                            {"metres per second squared", 1},
                                            {"MM/S/S", .001},
                                            {"mm/s2", .001},
                                            {"IN/SEC/SEC", .0254},
                                            {"in/s2", .0254},
                                            {"inches/sec/sec", .0254},
                                            {"FT/SEC2", .3048},
                                            {"ft/s/s", .3048},
                                            {"µm/s²", 1e-6},
                                            {"nm/s**2", 1e-9}};
  for (const auto& [text, si] : accelerations)
    for (std::string head : {"ACCELERATION TIME HISTORY IN UNITS OF ", "Acceleration time series, units: ",
                             "The units are ", "UNITS=", "Unit: ", "DATA UNITS IN ", "ACCELERATION, ",
                             "UNITS OF ACCELERATION: ", "Acceleration in "})
    {
      INFO(head + text);
      const auto record = parse_record(peer(head + text), source_of());
      CHECK(record.quantity == Quantity::acceleration);
      check_values(record, {.1, -.2, .3}, si);
    }
  for (const auto& [text, si] : std::vector<Spelling>{{"IN/SEC", .0254},
                                                      {"CM/SEC", .01},
                                                      {"m/s", 1},
                                                      {"MM/S", .001},
                                                      {"ft/sec", .3048},
                                                      {"cm/s.", .01},
                                                      {"kine", .01}})
    check_values(parse_record(peer("VELOCITY TIME HISTORY IN UNITS OF " + text), source_of("r.VT2")),
                 {.1, -.2, .3}, si);
  for (const auto& [text, si] :
       std::vector<Spelling>{{"IN", .0254}, {"inches", .0254}, {"cm", .01}, {"m", 1}, {"MM", .001}})
    check_values(parse_record(peer("DISPLACEMENT TIME HISTORY IN UNITS OF " + text), source_of("r.DT2")),
                 {.1, -.2, .3}, si);
}

TEST_CASE("a unit that is stated but not known is refused by name, never replaced by the extension's", "[io]")
{
  for (std::string unit : {"FURLONGS", "COUNTS", "VOLTS", "G/3", "G X 10", "G * 1000", "10-3 G", "0.001 G",
                           "CM/SEC/SEC X 10", "CM/MIN/MIN", "M/S3", "CM-SEC", "G G/10", "%", "CM/S-2", "LBS"})
  {
    INFO(unit);
    const std::string message = refusal(peer("ACCELERATION TIME HISTORY IN UNITS OF " + unit), source_of());
    CHECK_THAT(message, Contains("r.AT2:3: states the unit '" + unit.substr(0, unit.find(' '))));
    RecordSource given = source_of("r.txt", NAN, "g");
    CHECK_THAT(refusal(peer("Units: " + unit), given), Contains("which is not known"));
  }
  for (std::string line :
       {"DATA IN PERCENT G", "VALUES ARE IN 1000 CM/S/S", "UNIT MILLI G", "ACCELERATION, PERCENT G",
        "ACCELERATION G x 10", "ACCELERATION TIME HISTORY 10**-1 G"})
    CHECK_THAT(refusal(peer(line), source_of()), Contains("r.AT2:3: states the unit"));
  for (std::string name : {"acc PERCENT G", "acceleration G / 7", "a (10 gal)"})
    CHECK_THAT(refusal("time (s), " + name + "\n0, 1\n.01, 2\n", source_of("r.csv", NAN, "g")),
               Contains("r.csv:1: states the unit"));
  for (std::string line :
       {"ACCELERATION (G/7)", "ACCELERATION IN COUNTS", "ACCELERATION (COUNTS)", "Acceleration in G/7"})
    CHECK_THAT(refusal(peer(line), source_of()), Contains("r.AT2:3: states the unit"));
  CHECK_THAT(refusal("time (s), acc (furlongs)\n0, 1\n.01, 2\n", source_of("r.csv", NAN, "g")),
             Contains("r.csv:1: states the unit 'furlongs'"));
}

TEST_CASE("the line that states the unit is found, not the first with the word", "[io]")
{
  const std::string numbers = "NPTS= 2, DT= .01 SEC\n1 2\n";
  const auto unit_of = [&](const std::string& header)
  { return parse_record(header + numbers, source_of()).unit; };
  CHECK(unit_of("MADE EVENT, INSTRUMENT UNITS COUNTS\nACCELERATION TIME HISTORY IN UNITS OF CM/S/S\n") ==
        "cm/s2");
  CHECK(unit_of("UNITED UNITS BUILDING, 090\nACCELERATION TIME HISTORY IN UNITS OF G\n") == "g");
  CHECK(unit_of("ACCELERATION IN UNITS OF G\nPEAK ACCELERATION 12 CM/S/S, UNITS OF PEAK CM/S/S\n") == "g");
  CHECK(unit_of("STATION (G-4), SENSOR UNITS V\nACCELERATION IN CM/SEC/SEC\n") == "cm/s2");
  CHECK(unit_of("ACCELERATION (CORRECTED) (N45E)\n") == "g"); // that of the extension
  CHECK(unit_of("ACCELERATION RECORDED IN BASEMENT\n") == "g");
  CHECK_THAT(refusal("ACCELERATION IN UNITS OF G\nUNITS: CM/S/S\n" + numbers, source_of()),
             Contains("r.AT2:2: states the unit cm/s2, and line 1 g"));
  for (std::string line :
       {"ACCELERATION, CM/S/S", "ACCELERATION: CM/S/S", "ACCELERATION TIME HISTORY CM/SEC2",
        "acceleration - gal", "time units: s; acceleration units: cm/s2", "units: s, cm/s2",
        "Units are sec and cm/s2"})
  {
    INFO(line);
    CHECK(parse_record(line + "\n" + numbers, source_of()).values[0] == Approx(.01));
  }
  CHECK(unit_of("STATION 7, VS30 = 760 M/S, PGA 30 CM/S/S\n") == "g");
  CHECK_THAT(refusal("MADE STATION, CM/S/S\n" + numbers, source_of()),
             Contains("r.AT2:1: names cm/s2, and the unit is taken to be g"));
  CHECK_THAT(refusal("VELOCITY TIME HISTORY\n" + numbers, source_of()), Contains("the header says velocity"));
}

TEST_CASE("NPTS and DT are taken from the line that gives both", "[io]")
{
  const std::string tail = "UNITS OF G\nNPTS= 2, DT= .01 SEC\n1 2\n";
  CHECK(parse_record("A TEST OF NPTS\n" + tail, source_of()).dt == 0.01);
  CHECK(parse_record("NPTS AND DT BELOW, WIDTH 3\n" + tail, source_of()).dt == 0.01);
  CHECK(parse_record("UNITS OF G\nNPTS= 2, WIDTH= 3, DT= .01 SEC\n1 2\n", source_of()).dt == 0.01);
  CHECK_THAT(refusal("NPTS= 2, DT= .02 SEC\n" + tail, source_of()), Contains("otherwise than line 1"));
  CHECK_THAT(refusal("UNITS OF G\nSAMPLING RATE: 200 HZ\n" + tail, source_of()),
             Contains("r.AT2:2: states a time step of 0.005 s"));
  CHECK(parse_record("UNITS OF G\nSAMPLING RATE: 100 HZ\n" + tail, source_of()).dt == 0.01);
  CHECK_THAT(refusal("UNITS OF G\nNPTS= 2O, DT= .01 SEC\n1 2\n", source_of()),
             Contains("cannot take NPTS and DT"));
}

TEST_CASE("DT is read with its unit", "[io]")
{
  for (std::string step :
       {"DT= .01000 SEC", "DT=.01SEC", "DT= 10 MSEC", "DT= 10 ms", "DT=10ms", "DT(MSEC)= 10", "DT (ms) = 10",
        "DT= 100 HZ", "DT= 100 samples/sec", "DT(SEC)= .01", "DT= 1.E-2 S", "DT= .01", "DT= 10000 usec",
        "DT: 0.01 s, 8F10.5", "DT= .01 (SEC)"})
  {
    INFO(step);
    CHECK(parse_record(peer("IN UNITS OF G", "NPTS= 3, " + step), source_of()).dt ==
          Approx(0.01).epsilon(1e-15));
  }
  CHECK(parse_record(peer("UNITS OF G", "3 10.0 NPTS, DT (MSEC)"), source_of()).dt ==
        Approx(0.01).epsilon(1e-15));
  for (std::string numbers : {"3 10 NPTS, DT", "3 10.0 MSEC NPTS, DT", "3 10 NPTS, DT (MIN)"})
    CHECK_THAT(refusal(peer("UNITS OF G", numbers), source_of()), Contains("r.AT2:4: "));
  for (std::string step : {"DT= .01 HZ", "DT= 10 FORTNIGHTS", "DT= 10", "DT= 1/100 SEC", "DT (MIN) = 1",
                           "DT= 0,01 SEC", "DT= -.01 SEC", "DT= 10 MSEC/3", "DT= .01.0 SEC"})
  {
    INFO(step);
    CHECK_THAT(refusal(peer("IN UNITS OF G", "NPTS= 3, " + step), source_of()), Contains("r.AT2:4: "));
  }
  CHECK(parse_record(peer("IN UNITS OF G", "NPTS= 3, DT= 10 SEC"), source_of()).warnings.size() == 1);
}

TEST_CASE("numbers that Fortran writes without E are numbers, and dates are none", "[io]")
{
  const auto record =
      parse_record("UNITS OF G\nNPTS= 5, DT= .01 SEC\n 1.5-103 -2.5+001-.25-.125 1.Q-1\n", source_of());
  check_values(record, {1.5e-103, -25, -.25, -.125, .1}, g);
  CHECK_THAT(refusal("UNITS OF G\nNPTS= 3, DT= .01 SEC\n2018-01-24\n", source_of()),
             Contains("expected numbers"));
}

TEST_CASE("columns in a PEER file are no running text", "[io]")
{
  const auto body = [](int lines, const std::function<std::string(int)>& line)
  {
    std::string text = "ACCELERATION IN UNITS OF G\nNPTS= " + std::to_string(lines) + ", DT= .01 SEC\n";
    for (int i = 0; i < lines; ++i) text += line(i) + "\n";
    return text;
  };
  const auto value = [](int i) { return std::to_string((i * 7919 % 101 - 50) / 100.); };
  const auto three = body(20, [&](int i) { return value(i) + " " + value(i + 5) + " " + value(i + 9); });
  const auto smooth = body(30, [](int i) { return print_three(i); });
  CHECK(parse_record(std::string(smooth).replace(smooth.find("NPTS= 30"), 8, "NPTS= 90"), source_of())
            .warnings.size() == 1);
  CHECK_THAT(refusal(three, source_of()), Contains("r.AT2:2: holds 20 lines of 3 numbers in columns"));
  const auto indexed = body(20, [&](int i) { return std::to_string(i + 1) + " " + value(i); });
  CHECK_THAT(refusal(indexed, source_of()), Contains("in columns"));
  const auto pairs =
      parse_record(body(20, [&](int i) { return std::to_string(i * .01) + " " + value(i); }), source_of());
  CHECK(pairs.values.size() == 20);
  CHECK(pairs.values[3] == Approx(std::stod(value(3)) * g));
  std::string all = body(20, [&](int i) { return std::to_string(i * .02) + " " + value(i); });
  CHECK_THAT(refusal(all, source_of()), Contains("in columns")); // not the header's step
  all.replace(all.find("NPTS= 20"), 8, "NPTS= 40");              // numbers counted, not rows
  CHECK_THAT(refusal(all, source_of()), Contains("in columns"));
  std::string card = "UNITS OF G\nNPTS= 60, DT= .01 SEC\n"; // a card's number at its end
  for (int i = 0; i < 20; ++i)
    card += value(i) + " " + value(i + 3) + " " + value(i + 4) + " " + std::to_string(i + 1) + "\n";
  CHECK_THAT(refusal(card, source_of()), Contains("in columns"));
  std::string ramp = "UNITS OF G\nNPTS= 40, DT= .01 SEC\n"; // running text, even in each column
  for (int i = 0; i < 20; ++i) ramp += std::to_string(2 * i) + " " + std::to_string(2 * i + 1) + "\n";
  CHECK(parse_record(ramp, source_of()).values[39] == Approx(39 * g));
}

TEST_CASE("more than NPTS is padding of zeros, or refused", "[io]")
{
  const std::string head = "UNITS OF G\nNPTS= 4, DT= .01 SEC\n";
  CHECK(parse_record(head + "1 2 3\n4 0 0\n0 0 0\nEND OF DATA\n", source_of()).values.size() == 4);
  CHECK_THAT(refusal(head + "1 2 3\n4 5 0\n", source_of()),
             Contains("NPTS is 4 and the file holds 6 values"));
  CHECK_THAT(refusal(head + "1 2\n1 2\n0 0\n0 0\n", source_of()), Contains("NPTS is 4")); // a line twice
  CHECK_THAT(refusal(head + "1 2 3 4\nSECOND\nNPTS= 4, DT= .01 SEC\n1 2 3 4\n", source_of()),
             Contains("r.AT2:5: begins another record"));
}

TEST_CASE("decimal commas are refused by name", "[io]")
{
  CHECK_THAT(refusal("UNITS OF G\nNPTS= 2, DT= .01 SEC\n0,000000E+00   5,277895E-05\n", source_of()),
             Contains("decimal commas"));
  CHECK_THAT(refusal("0,00;0,5\n0,01;0,6\n0,02;0,7\n", source_of("r.csv", NAN, "g")),
             Contains("decimal commas"));
  CHECK_THAT(refusal("0,00\t0,5\n0,01\t0,6\n", source_of("r.csv", NAN, "g")), Contains("decimal commas"));
  CHECK_THAT(refusal("0,5\n0,6\n0,2\n", source_of("r.txt", .01, "g")), Contains("decimal point"));
}

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
