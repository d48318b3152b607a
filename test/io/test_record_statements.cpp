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
  for (const char* twice : {"NPTS= 2, DT= .01 SEC, DT= .005 SEC", "NPTS= 2, DT= .01 SEC, NPTS= 3"})
    CHECK_THAT(refusal(std::string("UNITS OF G\n") + twice + "\n1 2\n", source_of()), Contains("twice"));
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
