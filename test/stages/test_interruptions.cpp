// Signals, pipes and inputs that are no files: a run ends as it says, or is never begun.

#include "solver/stages/program.hpp"
#include "solver/stages/session.hpp"
#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

#include <cstdlib>
#include <sys/stat.h>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
/// The static stage of `bench`, so slow that it is still at work when a signal comes.
Arguments slow_static(const Bench& bench, const std::string& out)
{
  return bench.static_arguments(out, {"--set", "static.courant_number=0.1"});
}

} // namespace

TEST_CASE("a run that is asked to end by any of the signals that do so on a cluster leaves a checkpoint",
          "[stages]")
{
  const int signal = GENERATE(SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU);
  const Bench bench;
  Running running("mpm-static", slow_static(bench, "out"), bench / "said.txt");
  REQUIRE(running.wait_until([&] { return !checkpoints(bench / "out").empty(); }));
  running.signal(signal);
  const Ending ending = running.wait();
  INFO("signal " << signal << "\n" << ending.said);
  CHECK(ending.code == 75);
  CHECK_FALSE(checkpoints(bench / "out").empty());
  CHECK_FALSE(fs::exists(bench / "out/final.h5"));
}

TEST_CASE("a run that ignores the end of its terminal goes on", "[stages]")
{
  const Bench bench;
  std::signal(SIGHUP, SIG_IGN); // as nohup has it
  Running running("mpm-static", bench.static_arguments("out"), bench / "said.txt");
  std::signal(SIGHUP, SIG_DFL);
  REQUIRE(running.wait_until([&] { return fs::exists(bench / "out/identity.json"); }));
  running.signal(SIGHUP);
  const Ending ending = running.wait();
  INFO(ending.said);
  CHECK(ending.code == 0);
}

TEST_CASE("a signal before the first step ends the program at once", "[stages]")
{
  const Bench bench;
  Running running("mpm-static", bench.static_arguments("out", {"--check", "--set", "grid.spacing=0.05 m"}),
                  bench / "said.txt");
  REQUIRE(running.wait_until([&] { return contents(bench / "said.txt").find("c_s") != std::string::npos; }));
  running.signal(SIGTERM);
  const Ending ending = running.wait();
  INFO(ending.said);
  CHECK(ending.code == 75);
  CHECK_THAT(ending.said, Contains("interrupted before the first step"));
}

TEST_CASE("a run whose messages nobody reads any more goes on to its end", "[stages]")
{
  const Bench bench;
  const std::string command = std::string(BINARY_DIR) + "/mpm-static " + bench.path("case.yaml") + " --out " +
                              bench.path("out") + " --threads 1 2>&1 | true";
  REQUIRE(std::system(command.c_str()) == 0);
  CHECK(fs::exists(bench / "out/final.h5"));
  CHECK(fs::exists(bench / "out/summary.json"));
}

TEST_CASE("inputs that are no regular files are refused with 66, and nothing waits for them", "[stages]")
{
  const Bench bench;
  REQUIRE(mkfifo((bench / "pipe").c_str(), 0600) == 0);
  fs::create_directory(bench / "folder");
  for (const auto& [path, said] : std::map<std::string, std::string>{{bench.path("pipe"), "is a pipe"},
                                                                     {bench.path("folder"), "is a folder"},
                                                                     {"/dev/zero", "is a device"}})
  {
    const std::string expected = path + ": " + said;
    const auto check = [&](const std::string& program, const Arguments& arguments)
    {
      const Ending ending = bench.run(program, arguments);
      INFO(ending.said);
      CHECK(ending.code == 66);
      CHECK_THAT(ending.said, Contains(expected));
      CHECK_FALSE(fs::exists(bench / "out"));
    };
    put(bench / "case.yaml", cut);
    check("mpm-static", {path, "--out", bench.path("out")});
    check("mpm-seismic", {bench.path("case.yaml"), "--from", path, "--out", bench.path("out")});
    check("mpm-seismic", bench.seismic_arguments("out", {"--motion", path}));
    check("mpm-seismic", bench.seismic_arguments("out", {"--vertical", path}));
    put(bench / "case.yaml",
        replaced(cut, "rockhead: {points: [[0 m, 4 m], [30 m, 4 m]]}", "rockhead: {file: " + path + "}"));
    check("mpm-static", bench.static_arguments("out"));
  }
}

TEST_CASE("inputs larger than any that is meant are refused with 66", "[stages]")
{
  const Bench bench;
  const auto check = [&](const fs::path& file, std::uintmax_t size, const Arguments& arguments)
  {
    fs::resize_file(file, size); // zeros that take no room on the disk
    const Ending ending = bench.run("mpm-seismic", arguments);
    INFO(ending.said);
    CHECK(ending.code == 66);
    CHECK_THAT(ending.said, Contains(file.string() + ": is larger than"));
    CHECK_FALSE(fs::exists(bench / "out"));
  };
  put(bench / "long.txt", "0.1\n");
  check(bench / "long.txt", 3'000'000'000,
        bench.seismic_arguments("out", {"--motion", bench.path("long.txt")}));
  check(bench / "case.yaml", 3'000'000'000, bench.seismic_arguments("out"));
}

TEST_CASE("a folder that goes away under a run is a failed write and no bug of ours", "[stages]")
{
  ::setenv("OMP_WAIT_POLICY", "passive", 1); // else the program begins once more with it
  const Bench bench;
  const std::string path = bench.path("case.yaml"), out = bench.path("out");
  std::vector<std::string> words{"mpm-static", path, "--out", out};
  std::vector<char*> given;
  for (std::string& word : words) given.push_back(word.data());
  const auto gone = [](Session& session) -> int
  {
    for (const auto& entry : fs::directory_iterator(session.options.out)) (void)entry; // is not made yet
    return 0;
  };
  CHECK(run_program(int(given.size()), given.data(), "mpm-static", gone) == exit_code::write_failed);
}
