#pragma once
// Comparing the results of runs, bit for bit.

#include "io/results/files.hpp"
#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <vector>

namespace mpm::test
{
namespace fs = std::filesystem;
/// Every dataset below a group as path and bytes, in any type; and what the run remembers in attributes.
using Contents = std::map<std::string, std::string>;

inline std::string bytes(const std::vector<double>& values)
{
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

inline std::string dataset(const h5::Group& group, const std::string& name)
{
  std::string shape;
  for (const hsize_t extent : group.shape(name)) shape += std::to_string(extent) + " ";
  if (code_of([&] { group.read_doubles(name); }) == 0) return shape + bytes(group.read_doubles(name));
  if (code_of([&] { group.read_strings(name); }) == 0)
  {
    for (const std::string& text : group.read_strings(name)) shape += text + "\n";
    return shape;
  }
  return shape + group.read_text(name);
}

inline void collect(const h5::Group& group, const std::string& path, Contents& found)
{
  for (const char* name :
       {"step", "time", "dt", "start_time", "start_step", "drift", "plastic", "held", "unbalanced", "kinetic",
        "begin", "end", "gauge_time", "trigger_time", "since", "decided", "slid", "last"})
    if (group.has_attribute(name)) found[path + "@" + name] = bytes(group.attribute_doubles(name));
  for (const std::string& name : group.children())
  {
    if (name == "frame_digests" || name == "warnings")
      continue; // tell the time of day, and what befell the run
    if (code_of([&] { group.open_group(name); }) == 0)
      collect(group.open_group(name), path + name + "/", found);
    else
      found[path + name] = dataset(group, name);
  }
}

inline Contents contents_of(const fs::path& file)
{
  Contents found;
  collect(open_complete(file), "/", found);
  return found;
}

/// What differs between two result files; empty: nothing.
inline std::string difference(const fs::path& one, const fs::path& other)
{
  const Contents a = contents_of(one), b = contents_of(other);
  std::string text;
  for (const auto& [path, value] : a)
    if (const auto same = b.find(path); same == b.end())
      text += path + " is missing\n";
    else if (same->second != value)
      text += path + " differs\n";
  for (const auto& [path, value] : b)
    if (!a.contains(path)) text += path + " is too many\n";
  return a.empty() ? "nothing to compare" : text;
}

/// Names of a folder's files that are results, without those that tell the time of day.
inline std::vector<std::string> result_files(const fs::path& folder)
{
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const fs::path path = entry.path(); path.extension() == ".h5" || path.extension() == ".hdf")
      names.push_back(path.filename());
  std::sort(names.begin(), names.end());
  return names;
}

inline void check_same_results(const fs::path& expected, const fs::path& actual)
{
  REQUIRE(result_files(actual) == result_files(expected));
  for (const std::string& name : result_files(expected))
  {
    INFO(name);
    CHECK(difference(expected / name, actual / name).empty());
  }
  CHECK(contents(actual / "frames.hdf.series") == contents(expected / "frames.hdf.series"));
}
} // namespace mpm::test
