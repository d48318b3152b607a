// What the command line takes as given, and what it refuses: an option never counts for less than it says.

#include "solver/stages/command_line.hpp"

#include "io/common/error.hpp"
#include "test/read_json.hpp"
#include "test/stages/programs.hpp"

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
Options parsed(const std::string& program, Arguments arguments)
{
  arguments.insert(arguments.begin(), program);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  Options options;
  options.program = program;
  parse_command_line(static_cast<int>(argv.size()), argv.data(), options, "version");
  return options;
}

/// Message of a refusal with exit code 64; empty when the command line is taken.
std::string refusal(const std::string& program, Arguments arguments)
{
  arguments.insert(arguments.begin(), "case.yaml");
  arguments.insert(arguments.end(), "--check");
  try
  {
    parsed(program, arguments);
    return "";
  }
  catch (const Error& error)
  {
    CHECK(error.code == exit_code::usage);
    return error.what();
  }
}

/// With a record, so that --record-dt and --record-unit have something to apply to.
std::string refusal_of(const std::string& option, const std::string& value)
{
  return refusal("mpm-seismic", option == "--motion" ? Arguments{option, value}
                                                     : Arguments{"--motion", "a.AT2", option, value});
}
} // namespace

TEST_CASE("a command line is taken as it is given", "[command_line]")
{
  const Options o =
      parsed("mpm-seismic",
             {"case.yaml", "--out",      "out",         "--from", "s/final.h5",    "--scale", "-1.5e-1",
              "--motion",  "a.AT2",      "--record-dt", "0.005",  "--record-unit", "gal",     "--threads",
              "3",         "--max-wall", "1.5h",        "--set",  "a.b=1",         "--set",   "c=x=y",
              "--profile", "quick",      "--fresh",     "--quiet"});
  CHECK(o.case_file == "case.yaml");
  CHECK(o.out == "out");
  CHECK(o.from == "s/final.h5");
  CHECK(o.scale == -0.15);
  CHECK(o.motion == "a.AT2");
  CHECK(o.record_dt == 0.005);
  CHECK(o.record_unit == "gal");
  CHECK(o.threads == 3);
  CHECK(o.max_wall == 5400);
  CHECK(o.overrides == std::vector<std::string>{"a.b=1", "c=x=y"});
  CHECK(o.profile == "quick");
  CHECK((o.fresh && !o.check && o.verbosity == Verbosity::quiet));
  CHECK(parsed("mpm-seismic", {"case.yaml", "--check"}).scale == 1);
  CHECK(parsed("mpm-seismic", {"case.yaml", "--check", "--scale", "+2."}).scale == 2);
  CHECK(parsed("mpm-static", {"--check", "case.yaml", "--max-wall", "1e9 h"}).max_wall == 3.6e12);
}

TEST_CASE("an empty value is refused, whatever the option", "[command_line]")
{
  for (const std::string option : {"--scale", "--motion", "--vertical", "--profile", "--out", "--from",
                                   "--set", "--threads", "--max-wall", "--record-dt", "--record-unit"})
    for (const std::string value : {"", "  "})
      CHECK_THAT(refusal_of(option, value), Contains("mpm-seismic: " + option + ": is empty"));
  CHECK_THAT(refusal("mpm-static", {"--out="}), Contains("--out: needs a value"));
  CHECK_THAT(refusal("mpm-static", {"--out"}), Contains("--out: needs a value, and '--check'"));
  CHECK_THAT(refusal("mpm-static", {"--set", "grid.spacing="}), Contains("grid.spacing=: has no value"));
  CHECK_THAT(refusal("mpm-static", {"--set", "grid.spacing"}), Contains("has no value"));
  CHECK_THAT(refusal("mpm-static", {"--set", "{}"}), Contains("has no value"));
}

TEST_CASE("numbers are decimal, finite and whole words", "[command_line]")
{
  for (const std::string option : {"--scale", "--threads", "--max-wall", "--record-dt"})
    for (const std::string number :
         {"0x10", "1,5", "nan", "inf", "-inf", "1e999", "1.5x", "1..5", "--", "1 2", "½", "2 g"})
    {
      INFO(option << " " << number);
      CHECK_THAT(refusal_of(option, number), Contains(option));
    }
  CHECK_THAT(refusal_of("--scale", "1,5"), Contains("decimals follow a point"));
  for (const std::string number : {"0", "-1", "1.5", "4097", "1e99"})
    CHECK_THAT(refusal_of("--threads", number), Contains("a whole number from 1 to 4096"));
  for (const std::string time : {"0", "0 s", "-1 s", "10", "2 fortnights", "1h30min", "nan h"})
    CHECK_THAT(refusal_of("--max-wall", time), Contains("--max-wall '" + time));
  for (const std::string step : {"0", "-0.01", "10 ms"})
    CHECK_THAT(refusal_of("--record-dt", step), Contains("--record-dt '" + step));
}

TEST_CASE("what is given twice, or against itself, is refused", "[command_line]")
{
  CHECK_THAT(refusal("mpm-seismic", {"--scale", "1", "--scale", "2"}),
             Contains("--scale: is given more than once"));
  CHECK_THAT(refusal("mpm-static", {"--quiet", "--verbose"}), Contains("contradicts"));
  CHECK_THAT(refusal("mpm-static", {"--set", "a.b=1", "--set", "a.b=2"}), Contains("undoes --set a.b=1"));
  CHECK_THAT(refusal("mpm-static", {"--set", "a.0=1", "--set", "a[0]=2"}), Contains("undoes"));
  CHECK_THAT(refusal("mpm-static", {"--set", "a.b=1", "--set", "a={c: 2}"}), Contains("undoes"));
  CHECK(refusal("mpm-static", {"--set", "a={c: 2}", "--set", "a.b=1", "--set", "a.bc=1"}).empty());
  CHECK_THAT(refusal("mpm-static", {"other.yaml"}), Contains("one argument too many"));
  CHECK_THAT(refusal("mpm-static", {"--check=false"}), Contains("check"));
}

TEST_CASE("an option without what it applies to is refused", "[command_line]")
{
  CHECK_THAT(refusal("mpm-seismic", {"--record-dt", "0.01"}), Contains("--record-dt: applies to a record"));
  CHECK_THAT(refusal("mpm-seismic", {"--record-unit", "g"}), Contains("--record-unit: applies to a record"));
  CHECK_THAT(refusal("mpm-seismic", {"--record-format", "shake"}),
             Contains("--record-format: applies to a record"));
  CHECK(refusal("mpm-seismic", {"--vertical", "v.AT2", "--record-unit", "g"}).empty());
  for (const std::string option :
       {"--motion", "--vertical", "--from", "--record-dt", "--record-unit", "--scale"})
  {
    CHECK_THAT(refusal("mpm-static", {option, "1"}), Contains(option + ": is an option of mpm-seismic"));
    CHECK_THAT(refusal("mpm-static", {option + "=1"}), Contains(option + ": is an option of mpm-seismic"));
  }
}

TEST_CASE("an option misspelt is answered with the nearest", "[command_line]")
{
  for (const auto& [typed, meant] : {std::pair{"--profil", "--profile"},
                                     {"--treads", "--threads"},
                                     {"--maxwall", "--max-wall"},
                                     {"-out", "--out"},
                                     {"--sclae", "--scale"},
                                     {"--recorddt", "--record-dt"},
                                     {"--form=x", "--from"},
                                     {"--chek", "--check"},
                                     {"--sett", "--set"},
                                     {"--motn", "--motion"},
                                     {"--verison", "--version"}})
    CHECK_THAT(refusal("mpm-seismic", {typed}), Contains("did you mean '" + std::string(meant) + "'?"));
  CHECK_THAT(refusal("mpm-static", {"--zigzag"}), Contains("--zigzag: there is no such option"));
}

TEST_CASE("a motion scaled away is warned of", "[stages]")
{
  const Bench bench;
  const Arguments still{bench.path("case.yaml"),
                        "--out",
                        bench.path("out"),
                        "--set",
                        "static.gravity=0 m/s2",
                        "--set",
                        "seismic.duration=0.1 s",
                        "--scale",
                        "0"};
  const Ending ending = bench.run("mpm-seismic", still);
  CHECK(ending.code == 0);
  CHECK_THAT(ending.said, Contains("warning: ") && Contains("the scale is 0: this motion is not applied"));
  const auto summary = read_json(bench / "out/summary.json");
  CHECK_THAT(summary["warnings"].dump(), Contains("the scale is 0"));
}

TEST_CASE("a motion asked for on the command line is refused by a fixed base", "[stages]")
{
  const Bench bench;
  for (const Arguments& motion : {Arguments{"--scale", "2"}, {"--motion", bench.path("shake.txt")}})
  {
    Arguments all{bench.path("case.yaml"), "--check", "--set", "seismic.base.kind=fixed"};
    all.insert(all.end(), motion.begin(), motion.end());
    const Ending ending = bench.run("mpm-seismic", all);
    CHECK(ending.code == 64);
    CHECK_THAT(ending.said, Contains("takes no motion"));
  }
}
