// Faults that are planted in the state of a running stage (faults/plant.cpp): each has to end the run with 80
// within a hundred steps, with a message that names a particle, and must leave no file that holds it.

#include "test/read_json.hpp"
#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

#include <regex>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
/// While it lives, the faulty programs do this after `at` steps.
class Planted
{
public:
  Planted(const std::string& what, int at, const std::string& where = "ground", double by = 2)
  {
    setenv("PLANT", what.c_str(), 1);
    setenv("PLANT_AT", std::to_string(at).c_str(), 1);
    setenv("PLANT_IN", where.c_str(), 1);
    setenv("PLANT_BY", std::to_string(by).c_str(), 1);
  }
  ~Planted()
  {
    for (const char* name : {"PLANT", "PLANT_AT", "PLANT_IN", "PLANT_BY"}) unsetenv(name);
  }
};

struct Fault
{
  std::string what;
  double by;
  std::string told; ///< in the message
};

/// A volume of 1e6 times, a speed of 1e4 m/s; steps of 2 x 0.78, where 1.19 is stable in the bulk.
const std::vector<Fault> of_ground{
    {"stress", 0, "nan"},   {"velocity", 0, "nan"},  {"position", 0, "nan"},  {"affine", 0, "nan"},
    {"far", 0, "1e+30"},    {"away", 0, " at x = "}, {"mass", 0, "nan"},      {"volume", 1e6, " at x = "},
    {"speed", 1e4, " m/s"}, {"history", 0, "nan"},   {"sign", 0, " at x = "}, {"step", 2, " at x = "},
    {"node", 0, "nan"},
};
const std::vector<Fault> of_columns{{"stress", 0, "nan"},
                                    {"position", 0, "nan"},
                                    {"mass", 0, "nan"},
                                    {"volume", 1e6, " at x = "},
                                    {"node", 0, "nan"}};

/// Runs a stage with a fault, and looks at how it ends.
void check_caught(const Bench& bench, const std::string& program, Arguments arguments, const Fault& fault,
                  const std::string& where)
{
  constexpr int at = 130; // checks are made every 100 steps
  INFO(program << ": " << fault.what << " in " << where);
  const Planted planted(fault.what, at, where, fault.by);
  arguments.insert(arguments.end(), {"--fresh", "--set", "output.checkpoint.every=1 h"});
  const Ending ending = bench.run(program, arguments);
  INFO(ending.said);
  REQUIRE(ending.code == 80);
  CHECK_THAT(ending.said, Contains("particle ") && Contains(" of ") && Contains(fault.told));
  if (where != "ground") CHECK_THAT(ending.said, Contains(where + " column: "));
  // Ground that leaves a side is a reason to diverge: how far it has gone is told of every run that does.
  if (program == "mpm-seismic-faulty") CHECK_THAT(ending.said, Contains("left side: ends up to "));
  std::smatch steps;
  REQUIRE(std::regex_search(ending.said, steps, std::regex("after ([0-9]+) steps")));
  CHECK(std::stoi(steps[1]) >= at);
  CHECK(std::stoi(steps[1]) <= at + 100);
}
} // namespace

TEST_CASE("Faults that are planted in the static stage are caught within a hundred steps, by name",
          "[stages]")
{
  const Bench bench;
  const Arguments fast{"--set", "static.courant_number=0.78"};
  for (const Fault& fault : of_ground)
    check_caught(bench, "mpm-static-faulty", bench.static_arguments("out", fast), fault, "ground");
  for (const Fault& fault : of_columns)
    check_caught(bench, "mpm-static-faulty", bench.static_arguments("out", fast), fault, "left");
  const auto summary = read_json(bench / "out/summary.json");
  CHECK(summary["exit"] == 80);
}

TEST_CASE("Faults that are planted in the seismic stage are caught within a hundred steps, by name",
          "[stages]")
{
  const Bench bench;
  bench.make_static();
  const Arguments fast{"--set", "time_step.courant_number=0.78"};
  for (const Fault& fault : of_ground)
    check_caught(bench, "mpm-seismic-faulty", bench.seismic_arguments("out", fast), fault, "ground");
  for (const Fault& fault : of_columns)
    check_caught(bench, "mpm-seismic-faulty", bench.seismic_arguments("out", fast), fault, "right");
}

TEST_CASE("A column that fails on a thread of its own ends the run with 80", "[stages]")
{
  const Bench bench;
  const Planted planted("stress", 50, "right");
  const Ending ending = bench.run("mpm-static-faulty", bench.static_arguments("out", {"--threads", "2"}));
  INFO(ending.said);
  CHECK(ending.code == 80);
  CHECK_THAT(ending.said, Contains("right column: particle "));
}

// Checkpoints come as fast as they can be written, so that one is due in the step of the fault too.
TEST_CASE("After a fault the last checkpoint goes on to the results of a run without one", "[stages]")
{
  const Bench bench;
  bench.make_static();
  const Arguments often{"--set", "output.checkpoint.every=1 ms", "--set", "seismic.duration=0.15 s"};
  REQUIRE(bench.run_seismic("whole", often).code == 0);
  REQUIRE(bench.run_seismic("rare", {"--set", "seismic.duration=0.15 s"}).code == 0); // writes none
  CHECK(difference(bench / "whole/history.h5", bench / "rare/history.h5").empty());
  for (const std::string what : {"stress", "volume", "history", "mass"})
  {
    INFO(what);
    {
      const Planted planted(what, 40, "ground", 1e6);
      const Ending ending = bench.run("mpm-seismic-faulty", bench.seismic_arguments(what, often));
      INFO(ending.said);
      REQUIRE(ending.code == 80);
      CHECK_FALSE(checkpoints(bench / what).empty());
    }
    const Ending ending = bench.run_seismic(what, often);
    INFO(ending.said);
    REQUIRE(ending.code == 0);
    check_same_results(bench / "whole", bench / what);
  }
}

TEST_CASE("What has diverged is not drawn: no frame and no state holds a number that is none", "[stages]")
{
  const Bench bench;
  bench.make_static();
  // The last step of the run: nothing looks at the stress after it but what writes it down.
  const Arguments brief{"--set", "seismic.duration=0.1 s"};
  REQUIRE(bench.run_seismic("whole", brief).code == 0);
  const int steps = read_json(bench / "whole/summary.json")["steps"];
  const Planted planted("history", steps - 1);
  const Ending ending = bench.run("mpm-seismic-faulty", bench.seismic_arguments("out", brief));
  INFO(ending.said);
  CHECK(ending.code == 80);
  CHECK_FALSE(fs::exists(bench / "out/final.h5"));
  CHECK_FALSE(fs::exists(bench / "out/finished.json"));
}
