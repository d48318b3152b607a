// The keys of the case file as --keys prints them.

#include "io/case/key_table.hpp"
#include "io/case/renamed_keys.hpp"
#include "test/cards.hpp"
#include "test/io/case_texts.hpp"

#include <set>
#include <sstream>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// The table of io/case/README.md: a section for each branch of the case.
std::string markdown(const std::vector<KeyDescription>& keys)
{
  std::string text, branch;
  for (const KeyDescription& key : keys)
  {
    const std::size_t dot = key.path.find_first_of(".[");
    const bool before_branches = branch.empty() || branch == "top level";
    const std::string own = dot == key.path.npos && before_branches ? "top level" : key.path.substr(0, dot);
    if (own != branch)
      text += (branch.empty() ? "" : "\n") + ("### " + own) +
              "\n\n| key | value | default | meaning |\n| --- | --- | --- | --- |\n";
    branch = own;
    text += "| `" + key.path + "` | " + key.form + " | " +
            (key.otherwise.empty() ? "required" : key.otherwise) + " | " + key.meaning + " |\n";
  }
  text += "\n### units\n\n";
  std::istringstream units(units_text());
  for (std::string line; std::getline(units, line);) text += "- " + line + "\n";
  return text;
}

std::set<std::string> paths(const std::vector<KeyDescription>& keys)
{
  std::set<std::string> all;
  for (const KeyDescription& key : keys) all.insert(key.path);
  return all;
}

const KeyDescription& described(const std::vector<KeyDescription>& keys, const std::string& path)
{
  for (const KeyDescription& key : keys)
    if (key.path == path) return key;
  throw std::runtime_error(path + " is not described");
}
} // namespace

TEST_CASE("the card of io/case lists the keys as the programs do", "[io]")
{
  const std::string now = "\n" + markdown(case_keys()) + "\n";
  if (part_of_card("io/case/README.md", "keys") != now)
    FAIL("io/case/README.md: the part between the marks 'keys' has to be\n" << now);
}

TEST_CASE("the example on the card of io/case is a case, and nothing speaks against it", "[io]")
{
  const std::string card = contents(std::filesystem::path(SOURCE_DIR) / "io/case/README.md"),
                    mark = "```yaml\n";
  const std::size_t begin = card.find(mark) + mark.size();
  const std::string example = card.substr(begin, card.find("```", begin) - begin);
  CHECK(load(example).warnings == std::vector<std::string>{});
  CHECK(load(example, {}, "fine").grid.spacing == 0.5);
}

TEST_CASE("every key has a form and a meaning, and is listed once", "[io]")
{
  const auto keys = case_keys();
  CHECK(paths(keys).size() == keys.size());
  for (const KeyDescription& key : keys)
  {
    INFO(key.path);
    CHECK_FALSE(key.form.empty());
    CHECK_FALSE(key.meaning.empty());
    CHECK(key.meaning.size() < 200);
  }
}

TEST_CASE("every key of every case in the repository is in the table", "[io]")
{
  int cases = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(SOURCE_DIR) / "cases"))
  {
    if (entry.path().extension() != ".yaml") continue;
    if (contents(entry.path()).find("schema: seismpm-case/1") == std::string::npos) continue;
    ++cases;
    for (auto [path, value] : load_case(entry.path()).settings)
    {
      INFO(entry.path() << ": " << path);
      for (const std::string list : {"fields[", "points.", "points[", "domain.x[", ".x["})
        if (const auto at = path.find(list); at != std::string::npos && !path.starts_with("surfaces.points"))
          path.resize(at + list.size() - 1); // what stands in one key's value
      CHECK_NOTHROW(case_keys(path));
    }
  }
  CHECK(cases > 5);
}

TEST_CASE("the table tells range, unit, default and the laws that have a parameter", "[io]")
{
  const auto keys = case_keys();
  CHECK(described(keys, "grid.spacing").form == "length, above 0 m");
  CHECK(described(keys, "grid.spacing").otherwise.empty());
  CHECK(described(keys, "grid.particles_per_cell").form == "whole number from 1 to 10");
  CHECK(described(keys, "grid.particles_per_cell").otherwise == "3");
  CHECK(described(keys, "time_step.courant_number").form == "number, above 0 and at most 0.78");
  CHECK(described(keys, "time_step.courant_number").otherwise == "0.5");
  CHECK(described(keys, "materials.NAME.friction_angle.peak").form ==
        "angle, at least 0 deg and below 90 deg");
  CHECK_THAT(described(keys, "materials.NAME.strength.peak").meaning,
             Catch::Matchers::StartsWith("von_mises: "));
  CHECK_THAT(described(keys, "materials.NAME.softening.strain").meaning,
             Catch::Matchers::StartsWith("von_mises, mohr_coulomb: "));
  CHECK(described(keys, "materials.NAME.match").form == "mc or plane");
  CHECK_THAT(described(keys, "materials.NAME.density").meaning,
             Catch::Matchers::StartsWith("mass per volume"));
}

TEST_CASE("a path lists the keys at and below it, by the names of a case too", "[io]")
{
  CHECK(paths(case_keys("seismic.base")) ==
        std::set<std::string>{"seismic.base.kind", "seismic.base.spring"});
  CHECK(paths(case_keys("grid.spacing")) == std::set<std::string>{"grid.spacing"});
  CHECK(paths(case_keys("materials.soil.strength")) ==
        std::set<std::string>{"materials.NAME.strength.peak", "materials.NAME.strength.residual"});
  CHECK(case_keys("regions[0]").size() == 4);
  CHECK(case_keys("").size() == case_keys().size());
  try
  {
    case_keys("seismic.bas");
    FAIL("was found");
  }
  catch (const Error& error)
  {
    CHECK(error.code == exit_code::usage);
    CHECK_THAT(error.what(),
               Contains("--keys seismic.bas: there is no such key; did you mean 'seismic.base'?"));
  }
}

TEST_CASE("as text the table is 100 columns wide", "[io]")
{
  std::istringstream text(text_of(case_keys()));
  for (std::string line; std::getline(text, line);) CHECK(line.size() <= 100);
  CHECK(text_of(case_keys("grid.spacing")) == "grid.spacing  length, above 0 m; required\n"
                                              "              cell size h\n");
}

TEST_CASE("a key that has a better name is refused with it, in the file, in profiles and in --set", "[io]")
{
  const auto keys = paths(case_keys());
  for (const RenamedKey& key : renamed_keys)
  {
    INFO(key.before);
    CHECK(keys.contains(std::string(key.now)));
    CHECK_FALSE(keys.contains(std::string(key.before)));
    // Only a section that is there has keys.
    const bool seismic = key.before.starts_with("seismic.");
    const std::string text = small + (seismic ? "seismic: {duration: 1 s}\n" : "");
    const std::string before(key.before), said = before + ": is now called " + std::string(key.now) + "\n";
    CHECK(refusal(text, {before + "=1"}) == "65\n--set " + before + "=1: " + said);
    CHECK(refusal(text + "profiles: {other: {" + before + ": 1}}\n", {}, "other") ==
          (seismic ? "65\ncase.yaml:15:20: " : "65\ncase.yaml:14:20: ") + said);
  }
  CHECK(refusal(small + "time_step: {safety: 0.5}\n") ==
        "65\ncase.yaml:14:13: time_step.safety: is now called time_step.courant_number\n");
}
