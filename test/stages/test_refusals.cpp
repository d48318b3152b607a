// What the two programs refuse, and how they fail: exit codes, messages, and what they leave behind.

#include "test/sealed.hpp"
#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

TEST_CASE("a wrong command line exits with 64 and says so", "[stages]")
{
  const Bench bench;
  const std::string case_file = bench.path("case.yaml"), out = bench.path("out");
  CHECK(bench.run("mpm-static", {}).code == 64);
  CHECK(bench.run("mpm-static", {case_file, "--out", out, "--sideways"}).code == 64);
  CHECK(bench.run("mpm-static", {case_file, "--out", out, "--threads", "0"}).code == 64);
  const Ending no_out = bench.run("mpm-static", {case_file});
  CHECK(no_out.code == 64);
  CHECK_THAT(no_out.said, Contains("--out"));
  const Ending no_state = bench.run("mpm-seismic", {case_file, "--out", out});
  CHECK(no_state.code == 64);
  CHECK_THAT(no_state.said, Contains("--from"));
  CHECK_FALSE(fs::exists(out));
}

TEST_CASE("a wall time that is none exits with 64", "[stages]")
{
  const Bench bench;
  for (const std::string time : {"soon", "2 fortnights", "", "1.2.3 s", "-1 s"})
  {
    INFO("'" + time + "'");
    CHECK(bench.run_static("out", {"--max-wall", time, "--check"}).code == 64);
  }
  CHECK(bench.run_static("out", {"--max-wall", "1.5 h", "--check"}).code == 0);
}

TEST_CASE("a bad case exits with 65, names file, line and column of every error, and makes no folder",
          "[stages]")
{
  const Bench bench;
  put(bench / "case.yaml",
      replaced(replaced(cut, "spacing: 1 m", "spacing: 1"), "poisson_ratio: 0.35", "poison_ratio: 0.35"));
  for (const std::string program : {"mpm-static", "mpm-seismic"})
  {
    const Ending bad = bench.run(program, {bench.path("case.yaml"), "--out", bench.path("out")});
    CHECK(bad.code == 65);
    CHECK_THAT(bad.said, Contains(bench.path("case.yaml") + ":3:17: grid.spacing: needs a unit"));
    CHECK_THAT(bad.said, Contains(bench.path("case.yaml") + ":17:5: materials.clay.poison_ratio: ") &&
                             Contains("did you mean 'poisson_ratio'?"));
  }
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("a bad override exits with 65 and names it", "[stages]")
{
  const Bench bench;
  const Ending bad = bench.run_static("out", {"--set", "time_step.courant_number=0.9"});
  CHECK(bad.code == 65);
  CHECK_THAT(bad.said, Contains("--set time_step.courant_number=0.9") && Contains("0.78"));
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("a record that is none exits with 65 and makes no folder", "[stages]")
{
  const Bench bench;
  bench.make_static();
  put(bench / "shake.txt", "0.1\nnonsense\n0.3\n");
  const Ending bad = bench.run_seismic("out");
  CHECK(bad.code == 65);
  CHECK_THAT(bad.said, Contains("shake.txt:2"));
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("an input that is missing exits with 66, names it, and makes no folder", "[stages]")
{
  const Bench bench;
  const Ending no_case = bench.run("mpm-static", {bench.path("none.yaml"), "--out", bench.path("out")});
  CHECK(no_case.code == 66);
  CHECK_THAT(no_case.said, Contains("none.yaml"));
  const Ending no_state = bench.run_seismic("out");
  CHECK(no_state.code == 66);
  CHECK_THAT(no_state.said, Contains("static/final.h5"));
  const Ending no_record = bench.run_seismic("out", {"--motion", bench.path("none.txt")});
  CHECK(no_record.code == 66);
  CHECK_THAT(no_record.said, Contains("none.txt"));
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("a folder that holds another setting's run is refused with 73 and the key that differs", "[stages]")
{
  const Bench bench;
  bench.make_static();
  const auto before = times(bench / "static");
  const Ending other = bench.run_static("static", {"--set", "materials.clay.young_modulus=50 MPa"});
  CHECK(other.code == 73);
  CHECK_THAT(other.said,
             Contains("materials.clay.young_modulus") && Contains("50000000 Pa") && Contains("40000000 Pa"));
  const Arguments short_run{"--set", "seismic.duration=0.1 s"};
  REQUIRE(bench.run_seismic("a", short_run).code == 0);
  Arguments scaled = short_run;
  scaled.insert(scaled.end(), {"--scale", "0.5"});
  const Ending other_motion = bench.run_seismic("a", scaled);
  CHECK(other_motion.code == 73);
  CHECK_THAT(other_motion.said, Contains("motion.horizontal"));
  Arguments smaller = short_run; // it may end the motion and FLIP at another time
  smaller.insert(smaller.end(), {"--set", "output.slide.moved=10 cm"});
  const Ending other_slide = bench.run_seismic("a", smaller);
  CHECK(other_slide.code == 73);
  CHECK_THAT(other_slide.said, Contains("output.slide.moved"));
  CHECK(bench.run("mpm-static", bench.static_arguments("a")).code == 73);
  CHECK(times(bench / "static") == before);
}

TEST_CASE("a profile file with another text makes another ground: 73 in its folder, 65 for its static state",
          "[stages]")
{
  const Bench bench;
  put(bench / "case.yaml",
      replaced(cut, "{points: [[0 m, 14 m], [11 m, 14 m], [18 m, 9 m], [30 m, 9 m]]}", "{file: cut.csv}"));
  put(bench / "cut.csv", "0, 14\n11, 14\n18, 9\n30, 9\n");
  bench.make_static();
  CHECK(bench.run_static("static").code == 0);
  put(bench / "cut.csv", "0, 14\n11.2, 14\n17.8, 9\n30, 9\n");
  const Ending again = bench.run_static("static");
  CHECK(again.code == 73);
  CHECK_THAT(again.said, Contains("surfaces.ground"));
  const Ending shaken = bench.run_seismic("a", {"--max-wall", "0.1 s"});
  CHECK(shaken.code == 65);
  CHECK_THAT(shaken.said, Contains("surfaces.ground"));
}

TEST_CASE("a folder that a live run holds is refused with 73, and free again when that run has ended",
          "[stages]")
{
  const Bench bench;
  bench.make_static();
  const Arguments arguments = bench.seismic_arguments("a", {"--set", "seismic.duration=100 s"});
  Running first("mpm-seismic", arguments, bench / "first.txt");
  REQUIRE(first.wait_until([&] { return fs::exists(bench / "a/frame-00001.hdf"); }));
  const Ending second = bench.run("mpm-seismic", arguments);
  CHECK(second.code == 73);
  CHECK_THAT(second.said, Contains("another run holds it"));
  first.signal(SIGUSR1);
  CHECK(first.wait().code == 75);
  Running third("mpm-seismic", arguments, bench / "third.txt");
  REQUIRE(third.wait_until(
      [&] { return contents(bench / "third.txt").find("goes on from") != std::string::npos; }));
  third.signal(SIGINT);
  CHECK(third.wait().code == 75);
}

TEST_CASE("an output folder that cannot be made exits with 74", "[stages]")
{
  const Bench bench;
  put(bench / "file", "in the way");
  CHECK(bench.run_static("file/out").code == 74);
  CHECK(contents(bench / "file") == "in the way");
}

TEST_CASE("a run that blows up exits with 80 and keeps its last good checkpoint", "[stages]")
{
  const Bench bench;
  bench.make_static();
  // The pulse has 10 km/s, 12 cells a step.
  put(bench / "blow.txt", sine(12, 2) + "1000000\n-1000000\n" + sine(12, 2));
  const Ending ending = bench.run_seismic("out", {"--motion", bench.path("blow.txt"), "--record-dt", "0.01",
                                                  "--record-unit", "m/s2", "--set", "seismic.duration=2 s",
                                                  "--set", "output.checkpoint.every=0.05 s"});
  INFO(ending.said);
  CHECK(ending.code == 80);
  CHECK_THAT(ending.said, Contains("t = ") && Contains("cells in the step"));
  CHECK_FALSE(fs::exists(bench / "out/final.h5"));
  REQUIRE_FALSE(checkpoints(bench / "out").empty());
  CHECK(code_of([&] { open_complete(checkpoints(bench / "out").back()); }) == 0);
}

TEST_CASE("a base spring that is too stiff for the time step is refused with 65", "[stages]")
{
  const Bench bench;
  bench.make_static();
  const Ending ending = bench.run_seismic("out", {"--set", "seismic.base.spring=1 ms"});
  CHECK(ending.code == 65);
  CHECK_THAT(ending.said,
             Contains("seismic.base.spring: 0.001 s is shorter than two time steps of 0.00125 s"));
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("a static stage without equilibrium in time exits with 81, says what fails, and writes no state",
          "[stages]")
{
  const Bench bench;
  const Ending ending = bench.run_static(
      "out", {"--set", "static.until.at_most=3.02 s", "--set", "static.until.unbalanced=1e-9"});
  CHECK(ending.code == 81);
  CHECK_THAT(ending.said, Contains("static.until.at_most") && Contains("unbalanced force"));
  CHECK_FALSE(fs::exists(bench / "out/final.h5"));
}

TEST_CASE("a static state of another ground is refused with 65 and the key that differs", "[stages]")
{
  const Bench bench;
  bench.make_static();
  const Ending finer = bench.run_seismic("finer", {"--set", "grid.spacing=0.5 m"});
  CHECK(finer.code == 65);
  CHECK_THAT(finer.said, Contains("grid.spacing = 1 m") && Contains("grid.spacing = 0.5 m"));
  const Ending softer = bench.run_seismic("softer", {"--set", "materials.clay.young_modulus=30 MPa"});
  CHECK(softer.code == 65);
  CHECK_THAT(softer.said, Contains("materials.clay.young_modulus"));
}

TEST_CASE("a static state that is incomplete, damaged or none is refused with 65", "[stages]")
{
  const Bench bench;
  bench.make_static();
  const fs::path good = bench / "static/final.h5", bad = bench / "bad.h5";
  const auto refused = [&]
  {
    const Ending ending = bench.run(
        "mpm-seismic", {bench.path("case.yaml"), "--from", bad, "--out", bench.path("out"), "--fresh"});
    CHECK_THAT(ending.said, Contains("bad.h5"));
    return ending.code == 65;
  };
  put(bad, "no HDF5 at all");
  CHECK(refused());
  put(bad, contents(good));
  tear(bad);
  CHECK(refused());

  std::string flipped = contents(good);
  const auto at = flipped.find(bytes({open_complete(good).read_doubles("particles/stress")[0]}));
  REQUIRE(at != std::string::npos);
  flipped[at + 3] = static_cast<char>(flipped[at + 3] ^ 1);
  put(bad, flipped);
  CHECK(refused());

  put(bad, unsealed(contents(good)));
  CHECK(refused());

  REQUIRE(bench.run_seismic("a", {"--set", "seismic.duration=0.1 s"}).code == 0);
  put(bad, contents(bench / "a/final.h5"));
  CHECK(refused());
}

TEST_CASE("a static state that had not settled is no static state", "[stages]")
{
  const Bench bench;
  const Arguments slowly{"--set", "static.courant_number=0.1"};
  terminate(bench, "mpm-static", bench.static_arguments("static", slowly), bench / "static");
  const Ending ending =
      bench.run("mpm-seismic", {bench.path("case.yaml"), "--from", checkpoints(bench / "static").back(),
                                "--out", bench.path("a")});
  CHECK(ending.code == 65);
  CHECK_THAT(ending.said, Contains("had not settled"));
  CHECK_FALSE(fs::exists(bench / "a"));
}

TEST_CASE("a refused static state leaves the output folder free for the right one", "[stages]")
{
  const Bench bench;
  REQUIRE(bench.run_static("static", {"--set", "materials.clay.young_modulus=30 MPa"}).code == 0);
  CHECK(bench.run_seismic("a").code == 65);
  REQUIRE(bench.run_static("static", {"--fresh"}).code == 0);
  CHECK(bench.run_seismic("a", {"--max-wall", "0.1 s"}).code == 75);
}

TEST_CASE("options of a record want a record on the command line, and several components one of them",
          "[stages]")
{
  const Bench bench;
  bench.make_static();
  for (std::vector<std::string> options : {std::vector<std::string>{"--record-unit", "g"},
                                           {"--record-dt", "0.01"},
                                           {"--record-component", "NS"},
                                           {"--motion", bench.path("a.csv"), "--vertical-component", "UD"}})
  {
    const Ending ending = bench.run_seismic("out", options);
    CHECK(ending.code == 64);
    CHECK_THAT(ending.said, Contains("applies to a record of "));
  }
  std::string text = "time (s), NS (gal), UD (gal)\n";
  for (int i = 0; i < 200; ++i)
    text += std::to_string(i * 0.01) + ", " + std::to_string(i % 2 ? 0.5 : -0.5) + ", " +
            std::to_string(i % 4 - 1.5) + "\n";
  put(bench / "a.csv", text);
  const std::string file = bench.path("a.csv");
  const Ending unnamed = bench.run_seismic("out", {"--motion", file, "--check"});
  CHECK(unnamed.code == 65);
  CHECK_THAT(unnamed.said, Contains("its components are NS (gal), UD (gal); give one of them"));
  const Ending named = bench.run_seismic("out", {"--motion", file, "--record-component", "NS", "--vertical",
                                                 file, "--vertical-component", "UD", "--check"});
  CHECK(named.code == 0);
  CHECK_THAT(named.said, Contains("horizontal motion: component NS (gal)") &&
                             Contains("vertical motion: component UD (gal)"));
  CHECK_THAT(
      bench
          .run_seismic("out", {"--motion", file, "--record-component", "NS", "--record-unit", "g", "--check"})
          .said,
      Contains("the file is in gal and the case says g"));
}
