// The cards of io/results and io/run_folder against what runs write and how programs end.

#include "test/cards.hpp"
#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

#include <map>
#include <set>
#include <sstream>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// How many dimensions a dataset has, and its unit; texts have neither.
struct Form
{
  std::size_t rank;
  std::string unit;
  bool operator==(const Form&) const = default;
};
using Datasets = std::map<std::string, Form>;

std::ostream& operator<<(std::ostream& out, const Form& form)
{
  return out << form.rank << " dimensions, unit " << form.unit;
}

Datasets datasets_in(const h5::Group& group, const std::string& path = "")
{
  Datasets all;
  for (const std::string& name : group.children())
    if (code_of([&] { group.open_group(name); }) == 0)
      all.merge(datasets_in(group.open_group(name), path + name + "/"));
    else if (group.has_attribute("units", name))
      all[path + name] = {group.shape(name).size(), group.attribute_string("units", name)};
    else
      all[path + name] = {0, "text"};
  return all;
}

/// "a/{b,c}" as a/b and a/c.
std::vector<std::string> expanded(const std::string& name)
{
  const std::size_t open = name.find('{'), close = name.find('}');
  if (open == name.npos) return {name};
  std::vector<std::string> all;
  std::istringstream words(name.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(words, word, ',');)
    for (const std::string& one : expanded(name.substr(0, open) + word + name.substr(close + 1)))
      all.push_back(one);
  return all;
}

/// The rows `name | dimensions | unit | meaning` of a part of the card.
Datasets datasets_on_card(const std::string& part)
{
  Datasets all;
  for (const auto& row : table_rows(part_of_card("io/results/README.md", part)))
  {
    REQUIRE(row.size() == 4);
    const auto rank = static_cast<std::size_t>(std::count(row[1].begin(), row[1].end(), ',') + 1);
    for (const std::string& name : expanded(row[0])) all[name] = {row[2] == "text" ? 0 : rank, row[2]};
  }
  return all;
}

/// Materials by any name are NAME.
std::string general(const std::string& path)
{
  const std::string branch = "materials/";
  if (!path.starts_with(branch)) return path;
  const std::size_t end = path.find('/', branch.size());
  return end == path.npos ? path : branch + "NAME" + path.substr(end);
}

void check_same(const Datasets& on_card, const Datasets& in_files)
{
  for (const auto& [path, form] : in_files)
  {
    INFO("a run writes " << path << ": " << form);
    const auto known = on_card.find(path);
    CHECK(known != on_card.end());
    if (known != on_card.end()) CHECK(known->second == form);
  }
  for (const auto& [path, form] : on_card)
  {
    INFO("the card names " << path);
    CHECK(in_files.contains(path));
  }
}
} // namespace

TEST_CASE("the card of io/results names every dataset that a run writes, and no other", "[stages]")
{
  const Bench bench;
  const Arguments more{"--set",
                       "materials.rock={model: mohr_coulomb, density: 2200 kg/m3, young_modulus: 250 MPa, "
                       "poisson_ratio: 0.25, friction_angle: {peak: 30 deg}, cohesion: {peak: 1 MPa}}"};
  REQUIRE(bench.run_static("static", more).code == 0);
  REQUIRE(bench.run_seismic("a", more).code == 0);

  const Datasets history = datasets_in(open_complete(bench / "a/history.h5"));
  check_same(datasets_on_card("history.h5"), history);

  Datasets frame;
  for (const auto& [path, form] : datasets_in(open_complete(bench / "a/frame-00001.hdf")))
    if (!path.starts_with("VTKHDF/")) frame[path] = form;
  check_same(datasets_on_card("frames"), frame);

  Datasets state;
  for (const std::string file : {"static/final.h5", "a/final.h5"})
    for (const auto& [full_path, form] : datasets_in(open_complete(bench / file)))
    {
      std::string path = full_path;
      const std::string rows = "output/history/";
      if (path.starts_with(rows))
      {
        CHECK(history.contains(path.substr(rows.size())));
        continue;
      }
      for (const std::string column : {"free_field/left/", "free_field/right/"})
        if (path.starts_with(column)) path.erase(0, column.size());
      state[general(path)] = form;
    }
  check_same(datasets_on_card("states"), state);
}

TEST_CASE("the card of io/run_folder lists the exit codes that there are", "[stages]")
{
  std::set<int> codes, on_card;
  std::istringstream header(contents(fs::path(SOURCE_DIR) / "io/common/error.hpp"));
  const std::string mark = "inline constexpr int ";
  for (std::string line; std::getline(header, line);)
    if (line.starts_with(mark)) codes.insert(std::stoi(line.substr(line.find('=') + 1)));
  for (const auto& row : table_rows(part_of_card("io/run_folder/README.md", "exit codes")))
    on_card.insert(std::stoi(row.at(0)));
  CHECK(codes.size() > 5);
  CHECK(on_card == codes);
}

TEST_CASE("both programs print the keys at and below a path, without a case", "[stages]")
{
  const Bench bench;
  for (const std::string program : {"mpm-static", "mpm-seismic"})
  {
    const Ending branch = bench.run(program, {"--keys", "grid.spacing"});
    CHECK(branch.code == 0);
    CHECK(branch.said == "grid.spacing  length, above 0 m; required\n              cell size h\n");
    const Ending all = bench.run(program, {"--keys"});
    CHECK(all.code == 0);
    for (const std::string key :
         {"\nseismic.motion.recorded_as ", "\nmaterials.NAME.strength.peak ", "\nUnits:\nlength: "})
      CHECK_THAT(all.said, Catch::Matchers::Contains(key));
    const Ending unknown = bench.run(program, {"--keys", "grid.spacng"});
    CHECK(unknown.code == 64);
    CHECK_THAT(unknown.said, Catch::Matchers::Contains("did you mean 'grid.spacing'?"));
  }
}
