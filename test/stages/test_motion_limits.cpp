// What of a motion is not applied or cannot be, and records that come from elsewhere.

#include "test/stages/block.hpp"
#include "test/stages/results.hpp"

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

TEST_CASE("a fixed base applies no motion, reports none, and says so if one is given", "[stages]")
{
  const Block b;
  const std::string fixed = "seismic.base.kind=fixed";
  const Ending given = b.run("given", {"--set", fixed});
  REQUIRE(given.code == 0);
  CHECK_THAT(given.said, Contains("fixed base takes no motion") && !Contains("PGA"));
  CHECK(greatest(horizontal(b / "given/history.h5", "upgoing_velocity"), 1000) == 0);
  CHECK(b.summary("given")["motion"].empty());
  std::string without = block;
  without.erase(without.find("  motion:"), without.find("output:") - without.find("  motion:"));
  put(b / "case.yaml", without);
  const Ending none = b.run("none", {"--set", fixed});
  REQUIRE(none.code == 0);
  CHECK_THAT(none.said, !Contains("fixed base takes no motion"));
  const Ending relative = b.run("x", {"--set", fixed, "--set", "seismic.duration=record + 10 s"});
  CHECK(relative.code == 65);
  CHECK_THAT(relative.said, Contains("a fixed base takes none") && Contains("'24 s'"));
}

TEST_CASE("what of a motion cannot be is refused, and nothing is ever not a number", "[stages]")
{
  const Block b;
  const Ending scaled = b.run("x", {"--scale", "1e300"});
  CHECK(scaled.code == 65);
  CHECK_THAT(scaled.said, Contains("scale of 1e+300") && !Contains("nan") && !Contains("inf "));
  const Ending slow = b.run("x", b.record("shake.txt", "m/s2", "1e300"));
  CHECK(slow.code == 65);
  CHECK_THAT(slow.said, Contains("time step of 1e+300 s") && !Contains("nan"));
  const Ending endless = b.run("x", {"--check", "--set", "seismic.motion.horizontal.dt=1e100 s", "--set",
                                     "seismic.duration=record + 10 s"});
  CHECK(endless.code == 65);
  CHECK_THAT(endless.said, Contains("seismic.duration") && Contains("mend the time step"));
  const Ending fine = b.run("x", {"--check", "--set", "seismic.motion.horizontal.dt=1e-12 s"});
  CHECK(fine.code == 65);
  CHECK_THAT(fine.said, Contains("resample"));
  const Ending nil = b.run("nil", {"--scale", "0"});
  CHECK(nil.code == 0);
  CHECK_THAT(nil.said, Contains("the scale is 0") && !Contains("nan"));
  CHECK_THAT(contents(b / "nil/summary.json"), Contains("the scale is 0"));
  const Ending alone = b.run("x", {"--record-unit", "gal"});
  CHECK(alone.code == 64);
  CHECK_THAT(alone.said, Contains("--motion"));
}

TEST_CASE("waves that lie beyond the end of the run are not looked for in its grid", "[stages]")
{
  const Block b;
  std::string calm_then_quick = sine(3, 2);
  calm_then_quick += sine(12, 40);
  put(b / "shake.txt", calm_then_quick);
  const auto share_above = [&](const std::string& out, const std::string& duration)
  {
    REQUIRE(b.run(out, {"--set", "seismic.duration=" + duration}).code == 0);
    const auto waves = b.summary(out)["resolution"]["materials"]["rock"]["S"];
    CHECK(waves["carried_to"].get<double>() < 20);
    return waves["arias_share_above"].get<double>();
  };
  CHECK(share_above("calm", "1.2 s") < 0.2);   // a burst of 2 Hz
  CHECK(share_above("whole", "record") > 0.8); // 16 times its intensity at 40 Hz
}

TEST_CASE("the slope that is shipped applies its whole motion, in its quick profile too", "[stages]")
{
  const Block b;
  for (const Arguments& profile : {Arguments{}, Arguments{"--profile", "quick"}})
  {
    Arguments arguments{SOURCE_DIR "/cases/slope/case.yaml", "--check", "--set", "grid.spacing=2 m"};
    arguments.insert(arguments.end(), profile.begin(), profile.end());
    const Ending ending = b.program("mpm-seismic", arguments);
    CHECK(ending.code == 0);
    CHECK_THAT(ending.said,
               Contains("PGA 0.250 g at 8.68 s") && Contains("for 49.99 s") && !Contains("beyond the end"));
  }
}

TEST_CASE("a static stage does not need the record that the length of the shaking comes from", "[stages]")
{
  const Bench bench;
  const Ending ending =
      bench.run("mpm-static", {bench.path("case.yaml"), "--check", "--set", "seismic.duration=record + 10 s",
                               "--set", "seismic.motion.horizontal.file=nowhere.txt"});
  INFO(ending.said);
  CHECK(ending.code == 0);
}

TEST_CASE("rows of values are read where the command line names their format", "[stages]")
{
  const Block b;
  std::string rows = "MADE FOR A TEST\n";
  for (int k = 0; k < 120; ++k)
    rows += (k % 8 ? " " : k ? "\n" : "") + std::to_string(0.1 * std::sin(0.2 * k)) + (k == 119 ? "\n" : "");
  put(b / "rows.acc", rows);
  const Arguments record{"--motion", b / "rows.acc", "--record-dt", "0.01", "--record-unit", "g"};
  Arguments named = record;
  named.insert(named.end(), {"--record-format", "shake"});
  const Ending unnamed = b.run("unnamed", record);
  CHECK(unnamed.code == 65);
  CHECK_THAT(unnamed.said, Contains("rows.acc:1"));
  CHECK(b.run("named", named).code == 0);
  CHECK(b.summary("named")["motion"]["horizontal"]["recorded"]["pga"].get<double>() ==
        Approx(0.1 * 9.80665).epsilon(0.01)); // the sine's samples miss its peak by cos(0.1) at most, 0.5 %
}
