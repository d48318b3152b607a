#include "io/records/first_line.hpp"

#include <algorithm>

namespace mpm::records
{
namespace
{
/// With the point; 0 where there is none.
std::size_t digits_behind_point(std::string_view token)
{
  const std::size_t point = token.find('.');
  if (point == token.npos) return 0;
  return std::min(token.find_first_not_of("0123456789", point + 1), token.size()) - point;
}
} // namespace

FirstLine first_line(const RecordSource& source, const std::vector<Line>& data)
{
  // Only one or two numbers, the first of them whole and not small, or just the number of lines below.
  const auto first = data.size() > 2 ? numbers_in(data[0].text) : std::nullopt;
  if (!first || first->empty() || first->size() > 2) return {};
  const std::vector<double> next = numbers_in(data[1].text).value_or(std::vector<double>{});
  const auto tokens = cells_of(data[0].text, " \t,;");
  const auto rest = data.size() - 1;
  const bool is_count =
      first->front() >= 5 && (is_whole(tokens[0]) || (first->size() == 1 && first->front() == double(rest)));
  if (!is_count) return {};
  const std::size_t count = std::size_t(std::min(first->front(), 1e15)); // more than lines there can be
  // Count and step above one column, or above time and value.
  if (first->size() == 2)
  {
    const bool heads = next.size() == 1 || (next.size() == 2 && count == rest && (*first)[1] > 0);
    if (!heads) return {};
    if (count != rest || !((*first)[1] > 0))
      refuse(source, data[0],
             "announces " + std::to_string(count) + " values at " + number((*first)[1]) + " s, and " +
                 std::to_string(rest) + " lines follow; mend the first line");
    refuse_bare_step(source, data[0], (*first)[1]);
    return {count, (*first)[1]};
  }
  if (next.size() != 1) return {};
  // Counts of an instrument are whole numbers too: then only the right number of lines makes the first a
  // count.
  const bool others_whole =
      std::all_of(data.begin() + 1, data.end(), [](const Line& l) { return is_whole(l.text); });
  const bool counts = count == rest;
  if (others_whole && !counts) return {};
  if (!counts || others_whole || !is_whole(tokens[0]))
    refuse(source, data[0],
           "is " + std::string(data[0].text) + ", which looks like a count, and " + std::to_string(rest) +
               " lines follow; remove the line, or write it with a "
               "decimal point if it is a value");
  return {count, NAN};
}

void refuse_step_as_value(const RecordSource& source, const std::vector<Line>& data)
{
  if (data.size() < 2 || std::isnan(source.dt)) return;
  const auto first = numbers_in(data[0].text);
  // "0.005" above "0.00012": SHAKE-like decks are often kept with their step on top.
  if (first && first->size() == 1 && first->front() == source.dt &&
      digits_behind_point(data[0].text) != digits_behind_point(data[1].text))
    refuse(source, data[0], "is the time step, not a value; remove the line");
}
} // namespace mpm::records
