// What --check says of the steps and of the time to settle.

#include "solver/stages/cost.hpp"
#include "solver/stages/occasions.hpp"
#include "solver/stages/relaxation.hpp"
#include "solver/stages/settling.hpp"
#include "test/read_json.hpp"
#include "test/stages/ground.hpp"
#include "test/stages/programs.hpp"

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
nlohmann::json summary_of(const Bench& bench, const std::string& run)
{
  return read_json(bench / run / "summary.json");
}

/// The number before some words of an answer.
double number_before(const std::string& said, const std::string& words)
{
  const std::size_t end = said.find(words);
  REQUIRE(end != said.npos);
  const std::size_t begin = said.find_last_of(' ', end - 1);
  return std::stod(said.substr(begin + 1, end - begin - 1));
}
} // namespace

TEST_CASE("the option --check tells the steps of a seismic run exactly", "[stages]")
{
  const Bench bench;
  for (const std::string duration : {"0.05 s", "0.0234 s"})
  {
    const Arguments options{"--set", "static.gravity=0 m/s2",         "--set", "seismic.duration=" + duration,
                            "--set", "output.checkpoint.every=10 min"};
    Arguments check{bench.path("case.yaml"), "--check", "--threads", "1"},
        run{bench.path("case.yaml"), "--out", bench.path("run"), "--threads", "1", "--fresh"};
    check.insert(check.end(), options.begin(), options.end());
    run.insert(run.end(), options.begin(), options.end());
    const Ending told = bench.run("mpm-seismic", check);
    INFO(told.said);
    REQUIRE(told.code == 0);
    REQUIRE(bench.run("mpm-seismic", run).code == 0);
    CHECK(number_before(told.said, " steps for") == summary_of(bench, "run")["steps"]);
  }
}

TEST_CASE("a run takes as many steps as it takes to reach its end, and no more", "[stages]")
{
  for (const double dt : {1e-3, 7e-4, 0.3, 1.0 / 3})
    for (const double duration : {1e-4, 0.3, 1.0, 59.99})
    {
      const std::int64_t steps = steps_in(duration, dt);
      Clock clock{.dt = dt};
      while (!is_over(clock.time(), duration)) ++clock.step;
      CHECK(steps == clock.step);
    }
}

TEST_CASE("local damping brings a mode to rest as fast as it is said to", "[stages]")
{
  // u'' = (1 - b) f or (1 + b) f with f = -w^2 u, as f drives or holds; swings counted as they come to rest.
  const double damping = 0.75, period = 1, w = 2 * std::numbers::pi / period, dt = 1e-5;
  double u = 1, v = 0, t = 0;
  for (int swings = 0; swings < 6; t += dt)
  {
    const double f = -w * w * u, before = v;
    v += dt * (f - damping * std::fabs(f) * (v > 0 ? 1 : v < 0 ? -1 : 0));
    u += dt * v;
    if (before * v < 0) ++swings;
  }
  CHECK(t == Approx(time_to_fade(damping, period, std::fabs(u))).epsilon(1e-3));
}

// The ramp 10 s^3 - 15 s^4 + 6 s^5 has a jump of 60 / T^3 in its third derivative at its end, which leaves a
// mode of frequency w with an amplitude of 60 / (T w)^3 of what gravity moves it. Unbalanced is half of the
// forces that are not balanced over the weight, so that it starts from 30 / (T w)^3 and has to fade to the
// wanted ratio. What rings longest is the shear mode of the deepest ground; a coarse grid has the same.
TEST_CASE("elastic ground settles between the ramp's end and the time in which its slowest mode fades",
          "[stages]")
{
  const std::string level = level_ground(1, 2, 32, 8, 20, 9.81);
  for (const double ramp : {1.0, 3.0, 10.0})
  {
    Case case_file = case_from(level);
    case_file.static_stage.ramp = ramp;
    Options options;
    options.program = "mpm-static";
    options.verbosity = Verbosity::silent;
    const TemporaryFolder folder;
    put(folder.path() / "case.yaml", level);
    options.case_file = folder.path() / "case.yaml";
    options.overrides = {fmt::format("static.ramp={} s", ramp)};
    Session session(options);
    Clock clock;
    Model model = make_static_model(session.case_file, clock);
    Relaxation relaxation(session, model);
    REQUIRE(relaxation.settle(clock, steps_in(60, clock.dt)));

    // Scaled masses make P waves 251 m/s in both; S waves are slower by sqrt((1 - 2 nu) / (2 - 2 nu)).
    const double fastest = std::sqrt(40e6 * 0.65 / (1.35 * 0.3) / 1800);
    const auto slow = [&](double nu) { return fastest * std::sqrt((1 - 2 * nu) / (2 - 2 * nu)); };
    const double period = 4 * (8 / slow(0.25) + 12 / slow(0.35)), w = 2 * std::numbers::pi / period;
    const double first = std::min(1.0, 30 / std::pow(ramp * w, 3));
    const double bound = ramp + std::max(0.0, time_to_fade(0.75, period, 1e-6 / first)) + 110 * clock.dt;
    CHECK(clock.time() >= ramp);
    CHECK(clock.time() <= bound);

    const Settling coarse = expected_settling(session, 16 * 3000.0);
    CHECK(coarse.settles);
    CHECK(coarse.spacing == Approx(4));
    CHECK(coarse.time >= ramp);
    CHECK(coarse.time <= bound + 110 * 3 * clock.dt);
  }
}

TEST_CASE("where ground rests after the motion, what cannot yield is taken to", "[stages]")
{
  const std::string rest = std::string(cut).insert(cut.find("  motion:"), "  rest_below: 1 mm/s\n");
  const TemporaryFolder folder;
  put(folder.path() / "case.yaml", rest);
  put(folder.path() / "shake.txt", sine(12, 2));
  Case case_file = load_case(folder.path() / "case.yaml");
  IncomingWave wave; // nothing enters: the motion ends at once, and ground rests from t = 1 s on
  const Occasions all = occasions_of(case_file, &wave, 0.01, 11);
  CHECK(all.steps == 1100);
  // Rock: 4 m of 14 to 9 m; 30 x 4 of 30 x 4 + (11 x 10 + 7 x 7.5 + 12 x 5) m2.
  CHECK(all.skipped == Approx(1000 * 120 / (120 + 222.5)).epsilon(1e-3));
  case_file.seismic.rest_below = 0;
  CHECK(occasions_of(case_file, &wave, 0.01, 11).skipped == 0);
}

TEST_CASE("the option --check sets the profiles beside what was chosen", "[stages]")
{
  const Bench bench;
  const Ending told = bench.run("mpm-seismic", {bench.path("case.yaml"), "--check", "--threads", "1", "--set",
                                                "static.gravity=0 m/s2"});
  INFO(told.said);
  REQUIRE(told.code == 0);
  for (const std::string row : {"\nas it is ", "\nquick ", "\nstandard ", "\nfine ", "\npaper "})
    CHECK_THAT(told.said, Contains(row));
  CHECK_THAT(told.said, Contains("run-out") && Contains("A below 2 %"));
  const Ending fine =
      bench.run("mpm-static", {bench.path("case.yaml"), "--check", "--threads", "1", "--profile", "fine"});
  INFO(fine.said);
  REQUIRE(fine.code == 0);
  CHECK_THAT(fine.said, Contains("profile fine: grid.spacing") && Contains("\nfine * ") &&
                            Contains("\nstandard ") && !Contains("as it is"));
}
