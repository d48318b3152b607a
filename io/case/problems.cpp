// Messages are sorted by line, because checks of the whole come after those of the parts, and people go
// through a file from its top.

#include "io/case/problems.hpp"

#include "io/common/error.hpp"
#include "io/common/printable.hpp"

#include <algorithm>
#include <tuple>

namespace mpm
{
namespace
{
constexpr std::size_t most_told = 200; // messages, more than anybody reads at once
} // namespace

std::string Location::text() const
{
  if (line == 0) return source;
  return source + ":" + std::to_string(line) + ":" + std::to_string(column);
}

void Problems::add(const Location& location, const std::string& path, const std::string& what)
{
  add_missing(location, path, what);
  only_missing_ = false;
}

void Problems::add_missing(const Location& location, const std::string& path, const std::string& what)
{
  // One line each, also where a value has several.
  entries_.push_back(
      {location, printable(location.text() + ": " + (path.empty() ? "" : path + ": ") + what, "")});
}

void Problems::throw_if_any() const
{
  if (entries_.empty()) return;
  std::vector<Entry> sorted = entries_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Entry& a, const Entry& b) {
                     return std::tie(a.location.line, a.location.column) <
                            std::tie(b.location.line, b.location.column);
                   });
  const std::size_t told = std::min(sorted.size(), most_told);
  std::string all;
  for (std::size_t k = 0; k < told; ++k) all += (k ? "\n" : "") + sorted[k].message;
  if (sorted.size() > told) all += "\nand " + std::to_string(sorted.size() - told) + " more like these";
  // A missing file beside a mistake is told as a mistake: running again with the file would not help.
  throw Error(only_missing_ ? exit_code::input_missing : exit_code::bad_input, all);
}
} // namespace mpm
