// The table of io/results/checkpoint_layout.hpp against the states that the programs write.

#include "io/results/checkpoint_layout.hpp"
#include "io/results/files.hpp"
#include "test/stages/programs.hpp"

#include <set>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// Paths of groups, which end with "/", and of attributes, whose names stand behind "@".
using Found = std::set<std::string>;

/// Attributes of an object, but for those that datasets have for readers of HDF5.
std::vector<std::string> attributes(hid_t file, const std::string& object)
{
  static const std::set<std::string> technical{"units", "long_name",      "CLASS",
                                               "NAME",  "REFERENCE_LIST", "DIMENSION_LIST"};
  std::vector<std::string> names;
  std::array<char, 200> name{};
  for (hsize_t k = 0; H5Aget_name_by_idx(file, object.c_str(), H5_INDEX_NAME, H5_ITER_INC, k, name.data(),
                                         name.size(), H5P_DEFAULT) >= 0;
       ++k)
    if (!technical.contains(name.data())) names.emplace_back(name.data());
  return names;
}

void collect(hid_t file, const h5::Group& group, const std::string& path, Found& found)
{
  for (const std::string& name : group.children())
  {
    const std::string object = path + name;
    for (const std::string& attribute : attributes(file, object)) found.insert(object + "@" + attribute);
    if (code_of([&] { group.open_group(name); }) != 0) continue;
    found.insert(object + "/");
    if (object != "output/history") collect(file, group.open_group(name), object + "/", found);
  }
}

Found objects_of(const fs::path& path)
{
  const h5::File ours = open_complete(path);
  const std::string copy = path.string() + "-copy"; // HDF5 opens no file twice in different ways
  fs::copy_file(path, copy);
  const h5::Handle file{H5Fopen(copy.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
  REQUIRE(file.id() >= 0);
  Found found;
  for (const std::string& attribute : attributes(file.id(), ".")) found.insert("@" + attribute);
  collect(file.id(), ours, "", found);
  return found;
}

/// Whether a path of a file is one that an entry of the table stands for.
bool fits(std::string_view entry, std::string_view path)
{
  while (!entry.empty())
  {
    const std::string_view word = entry.substr(0, entry.find_first_of("/@"));
    const std::size_t end = std::min(path.find_first_of("/@"), path.size());
    const bool any_name = word == "NAME" || word == "SIDE";
    if (any_name ? end == 0 : path.substr(0, end) != word) return false;
    entry.remove_prefix(word.size());
    path.remove_prefix(end);
    if (entry.empty()) break;
    if (path.empty() || path[0] != entry[0]) return false;
    entry.remove_prefix(1);
    path.remove_prefix(1);
  }
  return path.empty();
}

/// Paths of the table for a state of one stage, with its three domains.
std::vector<std::string> expected(checkpoint::In stage)
{
  std::vector<std::string> paths;
  const auto add = [&](const std::string& prefix, const auto& table)
  {
    for (const checkpoint::Object& object : table)
      if (object.in == checkpoint::In::both || object.in == stage)
        paths.push_back(prefix + std::string(object.path));
  };
  add("", checkpoint::of_run);
  for (const char* domain : {"", "free_field/left/", "free_field/right/"}) add(domain, checkpoint::of_domain);
  return paths;
}

void check(const fs::path& state, checkpoint::In stage)
{
  const std::vector<std::string> table = expected(stage);
  const Found found = objects_of(state);
  for (const std::string& path : found)
  {
    INFO(path << " is in the file and not in the layout");
    CHECK(std::any_of(table.begin(), table.end(), [&](const auto& entry) { return fits(entry, path); }));
  }
  for (const std::string& entry : table)
  {
    INFO(entry << " is in the layout and not in the file");
    CHECK(std::any_of(found.begin(), found.end(), [&](const auto& path) { return fits(entry, path); }));
  }
}
} // namespace

TEST_CASE("states of both stages have the groups and attributes that the layout of a checkpoint says, and no "
          "others",
          "[stages]")
{
  const Bench bench;
  bench.make_static();
  check(bench / "static/final.h5", checkpoint::In::statics);
  const Ending ending = bench.run_seismic(
      "a", {"--set", "seismic.duration=0.1 s", "--set", "seismic.motion.vertical=built_in"});
  INFO(ending.said);
  REQUIRE(ending.code == 0);
  check(bench / "a/final.h5", checkpoint::In::seismic);
}
