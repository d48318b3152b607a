// SMC: United States Geological Survey, https://escweb.wr.usgs.gov/nsmp-data/smcfmt.html. One component a
// file: 11 lines of text, 48 integers, 50 reals, comments, values of 10 characters in cm/s2, cm/s or cm.

#include "io/records/archives.hpp"

#include <algorithm>

namespace mpm::records
{
namespace
{
/// What a header holds where it has no value.
constexpr double missing = 1.7e38; ///< printed as 0.1700000E+39

RecordUnit unit_of(const RecordSource& source, const Line& first)
{
  const std::string type = lower(first.text);
  if (type.starts_with("2 corrected accelerogram")) return *parse_unit("cm/s2");
  if (type.starts_with("3 velocity")) return *parse_unit("cm/s");
  if (type.starts_with("4 displacement")) return *parse_unit("cm");
  refuse(source, first,
         "looks like SMC of a kind that is not read, " + shown(bare(first.text)) +
             "; give a corrected accelerogram");
}

/// "component=    360".
std::string component_of(Lines lines)
{
  for (const Line& line : lines.first(11))
    if (const std::string_view name = bare(text_behind(line.text, "component=")); !name.empty())
      return std::string(name);
  return "unnamed";
}
} // namespace

bool is_smc(std::string_view, Lines lines)
{
  return lines.size() > 28 && !lines[0].text.empty() && is_digit(lines[0].text[0]) &&
         bare(lines[1].text) == "*";
}

Record read_smc(const RecordSource& source, Lines lines)
{
  const RecordUnit unit = unit_of(source, lines[0]);
  const std::string component = component_of(lines);
  chosen_component(source, {component});
  std::size_t at = 11;
  const std::vector<double> integers = fixed_numbers(source, lines, at, 48, 10, 8);
  const std::vector<double> reals = fixed_numbers(source, lines, at, 50, 15, 5);
  const double comments = integers[15], count = integers[16], rate = reals[1];
  if (!(comments >= 0 && comments < 1e6 && count >= 2 && count <= 1e9 && rate > 0 && rate < missing))
    refuse(source, lines[12],
           "has no number of comments and values or no sampling rate in its header; fetch it again");
  for (std::size_t i = 0; i < std::size_t(comments) && at < lines.size(); ++i, ++at)
    if (!lines[at].text.starts_with("|"))
      refuse(source, lines[at], "expected a comment, which begins with |");
  Channel channel{component, unit, 1 / rate, 0, fixed_numbers(source, lines, at, std::size_t(count), 10, 8)};
  for (const Line& line : lines.subspan(at))
    if (!bare(line.text).empty())
      refuse(source, line, "goes on behind its " + number(count) + " values; fetch it again");
  // Greatest and least value; their times stand beside them.
  if (const double high = reals[29], low = reals[31]; high < missing && low < missing)
  {
    channel.peak = std::max(std::abs(high), std::abs(low));
    channel.peak_tolerance = 1e-3 * std::abs(*channel.peak);
  }
  return record_of(source, lines, "smc", std::move(channel));
}
} // namespace mpm::records
