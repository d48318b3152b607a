// What a case says when every default is written out.

#include "io/case/case.hpp"
#include "test/io/case_texts.hpp"
#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace mpm;
using namespace mpm::test;

namespace
{
std::map<std::string, std::string> settings_of(const std::string& text,
                                               const std::vector<std::string>& overrides = {})
{
  const TemporaryFolder folder;
  put(folder / "case.yaml", text);
  const Settings::Entries entries = load_case(folder / "case.yaml", overrides).settings;
  return {entries.begin(), entries.end()};
}

/// What differs, one a line; the order of the keys is no matter.
std::string difference(const Case& one, const Case& other)
{
  const std::map<std::string, std::string> a{one.settings.begin(), one.settings.end()},
      b{other.settings.begin(), other.settings.end()};
  std::string text;
  for (const auto& [key, value] : a)
    if (!b.contains(key) || b.at(key) != value) text += key + " = " + value + " here only\n";
  for (const auto& [key, value] : b)
    if (!a.contains(key) || a.at(key) != value) text += key + " = " + value + " there only\n";
  return text;
}

/// Loads what `to_yaml` makes of a case, from another folder.
Case read_back(const Case& case_file)
{
  const TemporaryFolder folder;
  put(folder / "again.yaml", to_yaml(case_file.settings));
  return load_case(folder / "again.yaml");
}
} // namespace

TEST_CASE("a case with every default written out reads back to the same settings", "[io]")
{
  int cases = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(SOURCE_DIR) + "/cases"))
  {
    const std::string name = entry.path().filename();
    if (entry.path().extension() != ".yaml" || name == "ladder.yaml") continue;
    if (contents(entry.path()).find("seismpm-case/1") == std::string::npos) continue;
    INFO(entry.path());
    std::optional<Case> case_file;
    if (code_of([&] { case_file = load_case(entry.path()); }) != 0)
      continue; // needs a file that is not shipped
    CHECK(difference(read_back(*case_file), *case_file) == "");
    ++cases;
  }
  CHECK(cases > 10);
}

TEST_CASE("names with dots, empty lists and files of points read back too", "[io]")
{
  const TemporaryFolder folder;
  put(folder / "line.csv", "0, 10\n20, 10.5\n");
  put(folder / "case.yaml", replaced(small, "{points: [[0 m, 10 m]]}", "{file: line.csv}") +
                                "output: {frames: {fields: []}, gauges: {points: {\"top.1 [a]\": [1 m, 9 m], "
                                "\"[b]\": [2 m, 9 m]}}}\n");
  const Case case_file = load_case(folder / "case.yaml");
  const Case again = read_back(case_file);
  CHECK(difference(again, case_file) == "");
  REQUIRE(again.output.gauges.points.size() == 2);
  CHECK(again.output.gauges.points[1].name == "[b]");
  CHECK(again.output.gauges.points[0].name == "top.1 [a]");
  CHECK(again.output.frames.fields.empty());
  CHECK(again.surfaces[0].height(10) == 10.25);
}

TEST_CASE("units, defaults written out and the order of keys make no other settings", "[io]")
{
  const auto usual = settings_of(small);
  CHECK(settings_of(small, {"grid.spacing=100 cm"}).at("grid.spacing") == "1 m");
  CHECK(settings_of(small,
                    {"grid.particles_per_cell=3", "static.gravity=9.81 m/s2", "static.masses=scaled",
                     "static.until.at_most=60 s", "output.checkpoint.keep=2", "output.slide.moved=100 cm",
                     "output.slide.area=10 m2", "time_step.courant_number=0.5"}) == usual);
  CHECK(usual.at("static.until.at_most") == "60 s");
  CHECK(settings_of(small, {"static.ramp=40 s"}).at("static.until.at_most") == "80 s");
  for (const char* defaults :
       {"static.damping", "time_step.courant_number", "output.frames.every", "grid.interfaces"})
    CHECK(usual.contains(defaults));
  const std::string shaken = small + "seismic: {duration: 1 s}\n";
  CHECK(settings_of(shaken) ==
        settings_of(shaken, {"seismic.motion={recorded_as: outcrop, horizontal: built_in}",
                             "seismic.base.spring=auto", "seismic.motion.end=never", "seismic.transfer=flip",
                             "seismic.filter={time: 3 s, strain: 0.001}", "seismic.sides.kind=free_field"}));
  CHECK_THAT(settings_of(shaken).at("seismic.base.spring"), Contains(" s")); // the time, not how it was found
}

TEST_CASE("what a law makes of its parameters is settled: a residual strength, the width of a band", "[io]")
{
  const std::string soft = replaced(small, "model: elastic", "model: von_mises");
  const std::vector<std::string> peak{"materials.soil.strength.peak=80 kPa"};
  const auto with = [&](std::vector<std::string> more)
  {
    more.insert(more.begin(), peak.begin(), peak.end());
    return settings_of(soft, more);
  };
  CHECK(with({}).at("materials.soil.strength.residual") == "80000 Pa");
  CHECK(with({}) == with({"materials.soil.strength.residual=0.08 MPa"}));
  const std::string residual = "materials.soil.strength.residual=40 kPa",
                    displacement = "materials.soil.softening.displacement=1 m";
  const auto usual = with({residual, displacement});
  CHECK(usual.at("materials.soil.softening.band_width") == "3 m");
  CHECK(usual == with({residual, displacement, "materials.soil.softening.band_cells=3"}));
  CHECK(usual == with({residual, displacement, "materials.soil.softening.band_width=300 cm"}));
  CHECK(usual != with({residual, displacement, "materials.soil.softening.band_cells=1.45"}));
}
