// The two programs from outside: what a script that starts them may rely on.

#include "solver/mpm/phases.hpp"
#include "test/read_json.hpp"
#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

TEST_CASE("one static state serves two motions, and stays as it was", "[stages]")
{
  const Bench bench;
  bench.make_static();
  put(bench / "other.txt", sine(3, 4));
  const std::string state = contents(bench / "static/final.h5");
  REQUIRE(bench.run_seismic("a").code == 0);
  REQUIRE(bench
              .run_seismic(
                  "b", {"--motion", bench.path("other.txt"), "--record-dt", "0.01", "--record-unit", "m/s2"})
              .code == 0);
  CHECK(contents(bench / "static/final.h5") == state);
  CHECK(contents_of(bench / "a/history.h5")["/motion/upgoing_velocity"] !=
        contents_of(bench / "b/history.h5")["/motion/upgoing_velocity"]);
}

TEST_CASE("a finished run that is started again ends at once with 0 and rewrites nothing", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("a").code == 0);
  for (const std::string folder : {"static", "a"})
  {
    const auto before = times(bench / folder);
    const Ending again = folder == "a" ? bench.run_seismic("a") : bench.run_static("static");
    CHECK(again.code == 0);
    CHECK_THAT(again.said, Contains("finished already"));
    CHECK(times(bench / folder) == before);
  }
}

TEST_CASE("the option --fresh starts anew in a folder that holds results", "[stages]")
{
  const Bench bench;
  REQUIRE(bench.run_static("static").code == 0);
  const auto before = times(bench / "static");
  REQUIRE(bench.run_static("static", {"--fresh", "--set", "static.ramp=2 s"}).code == 0);
  CHECK(times(bench / "static")["final.h5"] > before.at("final.h5"));
}

TEST_CASE("a profile, --set and a case that says the same itself are one run", "[stages]")
{
  const Bench bench;
  put(bench / "case.yaml",
      cut + "profiles: {soft: {materials.clay.young_modulus: 30 MPa, static.ramp: 2 s}}\n");
  REQUIRE(bench.run_static("static", {"--profile", "soft"}).code == 0);
  const Ending same = bench.run_static(
      "static", {"--set", "materials.clay.young_modulus=30 MPa", "--set", "static.ramp=2 s"});
  CHECK(same.code == 0);
  CHECK_THAT(same.said, Contains("finished already"));
  const Ending plain = bench.run_static("static");
  CHECK(plain.code == 73);
  CHECK_THAT(plain.said, Contains("materials.clay.young_modulus is 40000000 Pa, but 30000000 Pa"));
  CHECK(open_complete(bench / "static/final.h5").attribute_string("profile", "case") == "soft");
  CHECK_THAT(contents(bench / "static/summary.json"), Contains("\"profile\": \"soft\""));
  REQUIRE(bench.run_seismic("a", {"--profile", "soft", "--set", "seismic.duration=0.1 s"}).code == 0);
  const Ending unknown = bench.run_static("b", {"--profile", "sofd"});
  CHECK(unknown.code == 65);
  CHECK_THAT(unknown.said, Contains("did you mean 'soft'"));
  CHECK_FALSE(fs::exists(bench / "b"));
}

TEST_CASE("both stages come to the same cells by a profile of every case, whatever the motion", "[stages]")
{
  const Bench bench;
  const Arguments options{"--profile",       "quick", "--set",
                          "static.ramp=1 s", "--set", "static.until.unbalanced=1e-3"};
  REQUIRE(bench.run_static("static", options).code == 0);
  put(bench / "other.txt", sine(6, 8));
  Arguments shaken = options;
  shaken.insert(shaken.end(), {"--set", "seismic.duration=0.02 s", "--motion", bench.path("other.txt"),
                               "--record-format", "column", "--record-dt", "0.01", "--record-unit", "m/s2"});
  const Ending ending = bench.run_seismic("run", shaken);
  INFO(ending.said);
  REQUIRE(ending.code == 0);
  // What was chosen, and why: on the screen, in the summary and with the case. 5 m that can slide over 8
  // cells.
  CHECK_THAT(ending.said, Contains("profile quick: grid.spacing 0.6 m, 50 of which"));
  const auto summary = read_json(bench / "run/summary.json");
  CHECK(summary["profile"] == "quick");
  CHECK(summary["profile_chose"].size() == 2);
  const std::string resolved = contents(bench / "run/case-resolved.yaml");
  CHECK_THAT(resolved, Contains("# profile quick: grid.spacing 0.6 m") && Contains("spacing: 0.6 m"));
  // It reads back to the same run without the profile.
  put(bench / "again.yaml", resolved);
  CHECK(bench
            .run("mpm-seismic", {bench.path("again.yaml"), "--from", bench.path("static/final.h5"), "--out",
                                 bench.path("run"), "--threads", "1"})
            .code == 0);
}

TEST_CASE("the option --check tells the cost, runs and writes nothing, and exits with 0", "[stages]")
{
  const Bench bench;
  const Ending static_stage = bench.run("mpm-static", {bench.path("case.yaml"), "--check"});
  CHECK(static_stage.code == 0);
  CHECK_THAT(static_stage.said,
             Contains("particles") && Contains("MB") && Contains("steps") && Contains("c_s"));
  const Ending without = bench.run_seismic("out", {"--check"}); // as the run itself
  CHECK(without.code == 66);
  CHECK_THAT(without.said, Contains("static/final.h5"));
  bench.make_static();
  const Ending other = bench.run_seismic("out", {"--check", "--set", "grid.spacing=0.5 m"});
  CHECK(other.code == 65);
  CHECK_THAT(other.said, Contains("grid.spacing"));
  const Ending seismic = bench.run_seismic("out", {"--check"});
  CHECK(seismic.code == 0);
  CHECK_THAT(seismic.said, Contains("carried to") && Contains("Arias"));
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("a run tells what it carries of the motion, warns of what it loses, and of a small step",
          "[stages]")
{
  const Bench bench;
  const auto summary_of = [&](const std::string& out, std::vector<std::string> more)
  {
    more.insert(more.end(), {"--set", "seismic.duration=0.1 s", "--set", "static.gravity=0 m/s2"});
    std::vector<std::string> arguments{bench.path("case.yaml"), "--out", bench.path(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    REQUIRE(bench.run("mpm-seismic", arguments).code == 0);
    return read_json(bench / out / "summary.json");
  };
  const auto usual = summary_of("usual", {"--set", "seismic.transfer=apic"}),
             small = summary_of(
                 "small", {"--set", "time_step.courant_number=0.125", "--set", "seismic.transfer=apic"}),
             flip = summary_of("flip", {"--set", "time_step.courant_number=0.125"});
  const auto waves = [](const nlohmann::json& summary)
  { return summary["resolution"]["materials"]["clay"]["S"]; };
  CHECK(waves(usual)["carried_to"] ==
        std::min(waves(usual)["phase_limit"].get<double>(), waves(usual)["damping_limit"].get<double>()));
  CHECK(waves(usual).contains("arias_share_above"));
  CHECK(waves(small)["damping_limit"].get<double>() < waves(usual)["damping_limit"].get<double>());
  CHECK(waves(small)["arias_share_above"].get<double>() >= waves(usual)["arias_share_above"].get<double>());
  CHECK_THAT(usual["warnings"].dump(), !Contains("time_step.courant_number"));
  CHECK_THAT(small["warnings"].dump(), Contains("time_step.courant_number"));
  CHECK_THAT(flip["warnings"].dump(), !Contains("time_step.courant_number")); // loses nothing by it
  const auto coarse = summary_of("coarse", {"--set", "materials.clay.young_modulus=1 MPa"});
  CHECK_THAT(coarse["warnings"].dump(), Contains("Arias"));
}

TEST_CASE("a case without gravity starts without a static state and says so", "[stages]")
{
  const Bench bench;
  const Ending ending =
      bench.run("mpm-seismic", {bench.path("case.yaml"), "--out", bench.path("out"), "--set",
                                "static.gravity=0 m/s2", "--set", "seismic.duration=0.2 s"});
  CHECK(ending.code == 0);
  CHECK_THAT(ending.said, Contains("stress-free"));
  CHECK(fs::exists(bench / "out/final.h5"));
  CHECK(bench.run_static("static", {"--set", "static.gravity=0 m/s2"}).code == 65);
}

TEST_CASE("summary.json tells how a run ended, and the log all runs of the folder", "[stages]")
{
  const Bench bench;
  const Arguments slowly{"--set", "static.courant_number=0.1"}; // else it ends before it can be cut short
  terminate(bench, "mpm-static", bench.static_arguments("static", slowly), bench / "static");
  CHECK_THAT(contents(bench / "static/summary.json"),
             Contains("\"exit\": 75") && Contains("\"stage\": \"static\""));
  REQUIRE(bench.run_static("static", slowly).code == 0);
  CHECK_THAT(contents(bench / "static/summary.json"), Contains("\"exit\": 0"));
  CHECK_THAT(contents(bench / "static/log.txt"), Contains("ends with 75") && Contains("ends with 0"));
}

TEST_CASE("summary.json and the log tell where the time went", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("out", {"--set", "seismic.duration=0.2 s"}).code == 0);
  for (const std::string out : {"static", "out"})
  {
    INFO(out);
    const auto summary = read_json(bench / out / "summary.json");
    const double all = summary["ns_per_particle_step"].get<double>();
    const auto& phases = summary["phases"];
    CHECK(phases.size() == phase_names.size());
    double sum = 0;
    for (const std::string_view name : phase_names)
    {
      const double cost = phases.at(std::string(name)).get<double>();
      CHECK(cost >= 0);
      sum += cost;
    }
    // Each of these is done in every step; the columns are the seismic stage's too.
    for (const std::string name : {"columns", "scatter", "gather"}) CHECK(phases[name].get<double>() > 0);
    // Parts of the loop's time, to the rounding of clocks and sums.
    CHECK(sum <= all * (1 + 1e-6));
    CHECK_THAT(contents(bench / out / "log.txt"), Contains("of it columns "));
  }
}
