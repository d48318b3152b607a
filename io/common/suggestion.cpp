// Words that are meant and not known are nearly always another known word with a slip of the finger, or its
// beginning.

#include "io/common/suggestion.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace mpm
{
namespace
{
/// Letters to change, add, leave out or exchange with their neighbour (the optimal string alignment
/// distance).
int edit_distance(std::string_view a, std::string_view b)
{
  std::vector<int> before, last, row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  // Row i holds the distances of the first i letters of `a` to every beginning of `b`; two rows back is
  // enough.
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    before = std::exchange(last, row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      row[j] = std::min({last[j - 1] + (a[i - 1] != b[j - 1]), row[j - 1] + 1, last[j] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}
} // namespace

std::string nearest(std::string_view wrong, const std::vector<std::string>& names)
{
  std::string best;
  int least = std::numeric_limits<int>::max();
  for (const std::string& name : names)
  {
    // "spac" is meant for "spacing", however many letters are missing.
    const bool part = wrong.size() > 2 && (name.starts_with(wrong) || wrong.starts_with(name));
    const int distance = part ? 1 : edit_distance(wrong, name);
    const int most = std::max(1, static_cast<int>(std::max(wrong.size(), name.size())) / 3);
    if (distance > most || distance >= least) continue;
    least = distance;
    best = name;
  }
  return best;
}

std::string suggestion(std::string_view wrong, const std::vector<std::string>& names)
{
  const std::string best = nearest(wrong, names);
  return best.empty() ? "" : "; did you mean '" + best + "'?";
}
} // namespace mpm
