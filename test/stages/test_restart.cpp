// Runs that are cut short and gone on with, and the same on any number of threads.

#include "solver/mpm/simd.hpp"
#include "test/read_json.hpp"
#include "test/sealed.hpp"
#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
double greatest_plastic_strain(const fs::path& final)
{
  double greatest = 0;
  for (const double strain : open_complete(final).read_doubles("materials/clay/plastic_strain"))
    greatest = std::max(greatest, strain);
  return greatest;
}

/// The energy balances of a seismic run: sampled from start to end, of all that there is, closed, and in the
/// summary.
void check_ledger(const fs::path& folder, const std::vector<std::string>& groups)
{
  const h5::File history = open_complete(folder / "history.h5");
  for (const std::string& group : groups)
  {
    const auto last = [&](const std::string& term) { return history.read_doubles(group + term).back(); };
    CHECK(history.read_doubles(group + "time").size() == 13); // 1.2 s
    INFO(group << ": incoming " << last("incoming") << ", residual " << last("residual"));
    CHECK(last("incoming") > 0);
    CHECK(last("radiated_base") > 0.1 * last("incoming"));
    CHECK(last("plastic") > 0);
    CHECK(std::fabs(last("residual")) < 0.02 * std::max(last("incoming"), last("plastic")));
    const double sum = last("kinetic") + last("elastic") + last("gravitational") + last("plastic") +
                       last("transfer") + last("radiated_base") + last("radiated_sides") - last("incoming") -
                       last("free_field") - last("static_reaction");
    CHECK(last("residual") == Approx(sum).margin(1e-9 * last("incoming")));
  }
  CHECK_THAT(contents(folder / "summary.json"), Contains("\"left_column\"") && Contains("\"residual\""));
  CHECK_THAT(contents(folder / "log.txt"), Contains("energy in J/m: ") && !Contains("does not close"));
}

/// Ends a run by a signal, by SIGKILL and by its time limit, on one thread and on two, and goes on with each;
/// `check` looks at the folder that comes of it; `more` are further arguments of all these runs.
void cut_short_and_go_on(const Bench& bench, const std::string& program,
                         Arguments (Bench::*arguments_for)(const std::string&, const Arguments&) const,
                         const std::function<void(const std::string&)>& check, const Arguments& more = {})
{
  for (const std::string threads : {"1", "2"})
  {
    Arguments all{"--threads", threads};
    all.insert(all.end(), more.begin(), more.end());
    const auto arguments = [&](const std::string& out) { return (bench.*arguments_for)(out, all); };
    const auto check_goes_on = [&](const std::string& out)
    {
      const Ending ending = bench.run(program, arguments(out));
      INFO(threads + " threads, " + out + "\n" + ending.said);
      REQUIRE(ending.code == 0);
      CHECK_THAT(ending.said, Contains("goes on from"));
      check(out);
    };
    const std::string terminated = "terminated" + threads, killed = "killed" + threads,
                      stopped = "stopped" + threads;
    terminate(bench, program, arguments(terminated), bench / terminated);
    check_goes_on(terminated);
    kill_after_checkpoints(bench, program, arguments(killed), bench / killed, 1);
    check_goes_on(killed);
    run_out_of_time(bench, program, arguments(stopped), bench / stopped);
    check_goes_on(stopped);
  }
}

/// Kills the run at its first checkpoint after it has said that the slide is self-driven.
void kill_when_decided(const Bench& bench, const Arguments& arguments, const fs::path& out)
{
  Running running("mpm-seismic", arguments, bench / "said.txt");
  REQUIRE(running.wait_until(
      [&] { return contents(bench / "said.txt").find("is self-driven") != std::string::npos; }));
  const auto newest = [&] { return checkpoints(out).empty() ? fs::path() : checkpoints(out).back(); };
  const fs::path before = newest();
  REQUIRE(running.wait_until([&] { return newest() != before; }));
  running.signal(SIGKILL);
  REQUIRE(running.wait().code == -SIGKILL);
}
} // namespace

TEST_CASE("a static run that was cut short and resumed ends bit for bit as one that was not", "[stages]")
{
  const Bench bench;
  const Arguments slowly{"--set", "static.courant_number=0.1"}; // else it ends before it can be cut short
  REQUIRE(bench.run_static("static", slowly).code == 0);
  const auto same_state = [&](const std::string& out)
  {
    CHECK(difference(bench / "static/final.h5", bench / (out + "/final.h5")).empty());
    CHECK(checkpoints(bench / out).empty());
  };
  cut_short_and_go_on(bench, "mpm-static", &Bench::static_arguments, same_state, slowly);
}

TEST_CASE("a static run ends bit for bit the same on one thread and on two", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_static("two", {"--threads", "2"}).code == 0);
  CHECK(difference(bench / "static/final.h5", bench / "two/final.h5").empty());
}

TEST_CASE("a seismic run that was cut short and resumed ends bit for bit as one that was not", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("whole").code == 0);
  REQUIRE(greatest_plastic_strain(bench / "whole/final.h5") >
          0.01); // else the clay would have nothing to remember
  const auto same_results = [&](const std::string& out) { check_same_results(bench / "whole", bench / out); };
  cut_short_and_go_on(bench, "mpm-seismic", &Bench::seismic_arguments, same_results);
}

TEST_CASE("a seismic run ends bit for bit the same on one thread and on two", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("one").code == 0);
  REQUIRE(bench.run_seismic("two", {"--threads", "2"}).code == 0);
  check_same_results(bench / "one", bench / "two");
  check_ledger(bench / "one", {"energy/", "energy/left/", "energy/right/"});
}

TEST_CASE("a torn checkpoint is passed over for the one before it, and the results stay the same", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("whole").code == 0);
  kill_after_checkpoints(bench, "mpm-seismic", bench.seismic_arguments("torn"), bench / "torn", 2);
  REQUIRE(checkpoints(bench / "torn").size() >= 2);
  tear(checkpoints(bench / "torn").back());
  const Ending ending = bench.run_seismic("torn");
  INFO(ending.said);
  REQUIRE(ending.code == 0);
  CHECK_THAT(ending.said, Contains("trying an older one"));
  check_same_results(bench / "whole", bench / "torn");
}

TEST_CASE("a run that goes on with other instructions than its checkpoint's says so", "[stages]")
{
  const Bench bench;
  bench.make_static();
  for (const bool other : {false, true})
  {
    const std::string out = other ? "other" : "same";
    terminate(bench, "mpm-seismic", bench.seismic_arguments(out), bench / out);
    if (other)
      for (const fs::path& checkpoint : checkpoints(bench / out))
        claim(checkpoint, "clock", "vectors", "abacus");
    const Ending ending = bench.run_seismic(out);
    INFO(ending.said);
    REQUIRE(ending.code == 0);
    const std::string warned =
        "was computed with abacus instructions, this build uses " + std::string(vector_path);
    CHECK((ending.said.find(warned) != std::string::npos) == other);
    CHECK((contents(bench / out / "summary.json").find(warned) != std::string::npos) == other);
  }
}

TEST_CASE("a write that fails exits with 74 and leaves the last checkpoint to go on from", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("whole").code == 0);
  const Arguments arguments = bench.seismic_arguments("full");
  terminate(bench, "mpm-seismic", arguments, bench / "full");
  const auto saved = checkpoints(bench / "full");
  const Ending full = bench.run("mpm-seismic", arguments, 100'000);
  INFO(full.said);
  CHECK(full.code == 74);
  CHECK(checkpoints(bench / "full") == saved);
  REQUIRE(bench.run("mpm-seismic", arguments).code == 0);
  check_same_results(bench / "whole", bench / "full");
}

TEST_CASE("a motion that ends when the slide is self-driven ends the same in a run that was killed",
          "[stages]")
{
  const Bench bench;
  put(bench / "shake.txt",
      sine(12, 2) + sine(12, 2) + sine(12, 2) + sine(12, 2)); // shakes on while the slide goes
  // Clay that barely stands and hardly keeps any strength: the cut slides on by itself.
  const Arguments weak{"--set", "materials.clay.strength.peak=45 kPa", "--set",
                       "materials.clay.strength.residual=4 kPa"};
  REQUIRE(bench.run_static("static", weak).code == 0);
  Arguments sliding = weak;
  sliding.insert(sliding.end(), {"--set", "seismic.motion.end=self_driven", "--set", "seismic.duration=4.5 s",
                                 "--set", "output.checkpoint.every=0.1 s"});
  const Ending whole = bench.run_seismic("whole", sliding);
  INFO(whole.said);
  REQUIRE(whole.code == 0);
  REQUIRE_THAT(whole.said, Contains("the slide is self-driven"));
  const auto summary_of = [&](const std::string& out) { return read_json(bench / out / "summary.json"); };
  const double ended = summary_of("whole")["motion_ended"].get<double>();
  CHECK(ended > 1.5); // a second of sliding, and half a second of fading
  CHECK(ended < 4.5); // the record goes on for 4.8 s

  kill_after_checkpoints(bench, "mpm-seismic", bench.seismic_arguments("before", sliding), bench / "before",
                         1);
  kill_when_decided(bench, bench.seismic_arguments("after", sliding), bench / "after");
  for (const std::string out : {"before", "after"})
  {
    const double decided =
        open_complete(checkpoints(bench / out).back()).attribute_double("decided", "motion");
    INFO(out << ": decided at " << decided);
    CHECK(std::isnan(decided) == (out == "before"));
    const Ending ending = bench.run_seismic(out, sliding);
    INFO(ending.said);
    REQUIRE(ending.code == 0);
    CHECK_THAT(ending.said, Contains("goes on from"));
    CHECK(summary_of(out)["motion_ended"].get<double>() == ended);
    check_same_results(bench / "whole", bench / out);
  }
}
