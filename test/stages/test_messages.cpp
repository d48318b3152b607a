// What the programs tell: where, and about what.

#include "io/common/printable.hpp"
#include "solver/stages/slide_report.hpp"
#include "test/read_json.hpp"
#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

#include <set>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
/// What a program writes to stdout.
std::string answer_of(const std::string& program, const Arguments& arguments, const fs::path& to)
{
  std::string command = std::string(BINARY_DIR) + "/" + program;
  for (const std::string& argument : arguments) command += " '" + argument + "'";
  REQUIRE(std::system((command + " >'" + to.string() + "' 2>/dev/null").c_str()) == 0);
  return contents(to);
}
} // namespace

TEST_CASE("the option --check answers on stdout and tells how long the static stage takes", "[stages]")
{
  const Bench bench;
  const Arguments check{bench.path("case.yaml"), "--check"};
  const std::string static_stage = answer_of("mpm-static", check, bench / "answer.txt");
  CHECK_THAT(static_stage, Contains("particles") && Contains("carried to"));
  CHECK_THAT(answer_of("mpm-seismic", check, bench / "answer.txt"),
             Contains("Arias") && Contains("steps for"));

  bench.make_static();
  const auto summary = read_json(bench / "static/summary.json");
  const auto steps_after = [&](const std::string& words)
  { return std::stod(static_stage.substr(static_stage.find(words) + words.size())); };
  const double steps = summary["steps"];
  CHECK(steps_after("at least ") < steps);
  // So few particles are tried on their own grid.
  CHECK(steps_after("settled after about ") == steps);
  CHECK(steps_after("at most ") > steps);
}

TEST_CASE("messages of mpm-static do not name keys that it does not use", "[stages]")
{
  const Bench bench;
  const Arguments odd{"--set", "time_step.courant_number=0.1"};
  const Ending ending = bench.run_static("static", odd);
  REQUIRE(ending.code == 0);
  CHECK_THAT(ending.said, !Contains("time_step.courant_number: "));
  CHECK(bench.run_static("static").code == 0); // the same run: it does not depend on that key
  // The pull of 1e5 g throws the ground apart.
  const Ending apart =
      bench.run_static("apart", {"--set", "static.gravity=1e6 m/s2", "--set", "static.ramp=0.01 s"});
  INFO(apart.said);
  CHECK(apart.code == 80);
  CHECK_THAT(apart.said,
             Contains("use a smaller static.courant_number") && !Contains("time_step.courant_number"));
}

TEST_CASE("the log of a seismic run ends with the slide", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("still", {"--set", "seismic.duration=0.1 s"}).code == 0);
  CHECK_THAT(contents(bench / "still/log.txt"), Contains("no slide: no ground has moved more than 1 m"));
  put(bench / "case.yaml",
      replaced(replaced(cut, "{peak: 80 kPa, residual: 40 kPa}", "{peak: 60 kPa, residual: 5 kPa}"),
               "displacement: 0.2 m", "displacement: 0.05 m"));
  REQUIRE(bench.run_static("static", {"--fresh"}).code == 0);
  REQUIRE(bench.run_seismic("flows", {"--set", "seismic.duration=2.5 s"}).code == 0);
  const auto slide = read_json(bench / "flows/summary.json")["slide"];
  INFO(slide.dump());
  REQUIRE(slide["moved_area"] > 0);
  const std::string log = contents(bench / "flows/log.txt");
  CHECK_THAT(log, Contains(fmt::format("slide: {:.1f} m2 have moved more than 1 m",
                                       slide["moved_area"].get<double>())));
  CHECK_THAT(log, Contains(fmt::format("triggered at t = {:.2f} s", slide["trigger_time"].get<double>())));
  CHECK_THAT(log, Contains(fmt::format("toe at x = {:.1f} m", slide["toe"].get<double>())));
}

TEST_CASE("a slide is told by area, centre of mass, toe and trigger", "[stages]")
{
  nlohmann::json slide{{"moved_area", 0.0}, {"greatest_moved_area", {{"value", 0.0}, {"time", nullptr}}}};
  CHECK(slide_text(slide, 1) == "no slide: no ground has moved more than 1 m");
  slide["greatest_moved_area"] = {{"value", 47.64}, {"time", 0.7}};
  CHECK(slide_text(slide, 1) ==
        "no slide: no ground is more than 1 m from where it was (47.6 m2 were at t = 0.70 s, and came back)");
  slide.update({{"moved_area", 123.45},
                {"centre_of_mass_displacement", {-3.0, -4.0}},
                {"toe", 40.04},
                {"toe_advance", 2.5},
                {"trigger_time", 6.789}});
  const std::string text = slide_text(slide, 1);
  CHECK(
      text ==
      "slide: 123.5 m2 have moved more than 1 m, their centre of mass 5.00 m (3.00 m to the left and 4.00 m "
      "down); toe at x = 40.0 m, advanced by 2.50 m; triggered at t = 6.79 s");
  slide["trigger_time"] = nullptr;
  CHECK(slide_text(slide, 1) == text.substr(0, text.rfind(';')));
}

TEST_CASE("names of a case and of its files are data: they lead nowhere, and a terminal does not obey them",
          "[stages]")
{
  const Bench bench;
  std::string text = replaced(cut, "name: cut", "name: ../../evil");
  for (const auto& [from, to] :
       {std::pair{"crest:", "'../../crest':"}, std::pair{"clay", "'..'"}, std::pair{"clay", "'..'"},
        std::pair{"rockhead:", "'../rockhead':"}, std::pair{"above: rockhead", "above: '../rockhead'"},
        std::pair{"below: rockhead", "below: '../rockhead'"}})
    text = replaced(text, from, to);
  // A path of any bytes: a sequence that clears a terminal, Latin-1.
  const std::string name = "\x1b[2J\xe9.txt";
  put(bench / "case.yaml", text);
  const Arguments more{"--set", "seismic.duration=0.2 s"};
  const Ending first = bench.run_static("static", more);
  INFO(first.said);
  REQUIRE(first.code == 0);
  put(bench / name, sine(12, 2));
  Arguments record{"--motion", bench.path(name), "--record-dt", "0.01", "--record-unit", "m/s2"};
  record.insert(record.end(), more.begin(), more.end());
  const Ending second = bench.run_seismic("seismic", record);
  INFO(second.said);
  REQUIRE(second.code == 0);
  for (const std::string& said : {first.said, second.said, contents(bench / "seismic/log.txt")})
  {
    CHECK(printable(said) == said);
    CHECK_THAT(said, Contains("stage"));
  }
  CHECK_THAT(contents(bench / "seismic/log.txt"), Contains("\\x1b[2J\\xe9.txt"));
  CHECK(read_json(bench / "seismic/summary.json").at("exit") == 0);
  std::set<std::string> there;
  for (const auto& entry : fs::directory_iterator(bench / ".")) there.insert(entry.path().filename());
  CHECK(there == std::set<std::string>{"case.yaml", "shake.txt", "said.txt", "static", "seismic", name});
}
