// CWB: Central Weather Bureau, Taiwan. Lee, W. H. K., Shin, T. C., Kuo, K. W., Chen, K. C. and Wu, C. F.
// (2001), CWB free-field strong-motion data from the 21 September Chi-Chi, Taiwan, earthquake, Bulletin of
// the Seismological Society of America 91(5), 1370-1376. Keys behind #, then time and three components a
// line.

#include "io/records/archives.hpp"

#include <algorithm>

namespace mpm::records
{
namespace
{
/// The line that begins with a key of the header, "#SampleRate(Hz):".
const Line& keyed(const RecordSource& source, Lines lines, std::string_view key)
{
  const auto found =
      std::ranges::find_if(lines, [&](const Line& line) { return line.text.starts_with(key); });
  if (found == lines.end())
    refuse(source, "has no line " + std::string(key) + " in its CWB header; fetch it again");
  return *found;
}

/// "Time U(+); N(+); E(+)": the names behind time.
std::vector<std::string> components_of(const RecordSource& source, Lines lines)
{
  const Line& line = keyed(source, lines, "#DataSequence:");
  std::string_view rest = bare(line.text.substr(14));
  if (!rest.starts_with("Time"))
    refuse(source, line, "does not begin with Time; not a sequence that is read");
  rest.remove_prefix(4);
  std::vector<std::string> names;
  for (std::string_view cell : cells_of(rest, ";,"))
  {
    // A component of the other sign would move the slope the other way.
    const std::size_t sign = cell.find("(+)");
    if (sign == cell.npos || sign == 0)
      refuse(source, line,
             "names the component " + shown(cell) + ", whose sign is not (+); write it as two columns");
    names.emplace_back(bare(cell.substr(0, sign)));
  }
  return names;
}

/// The number above zero behind a key.
double number_of(const RecordSource& source, Lines lines, std::string_view key)
{
  const Line& line = keyed(source, lines, key);
  const auto value = number_behind(line.text, key);
  if (!value || !(*value > 0))
    refuse(source, line, "expected a number behind " + std::string(key) + "; fetch it again");
  return *value;
}

/// Values of one column; times have to step as the sampling rate says.
std::vector<double> column_of(const RecordSource& source, Lines lines, std::size_t column,
                              std::size_t columns, double dt)
{
  std::vector<double> values;
  for (const Line& line : lines)
  {
    if (line.text.starts_with("#") || bare(line.text).empty()) continue;
    const std::vector<double> row = numbers_at(source, Line{bare(line.text), line.number});
    if (row.size() != columns)
      refuse(source, line,
             "expected " + std::to_string(columns) + " numbers and found " + std::to_string(row.size()));
    // Times are printed to a millisecond; off by more, a line is missing or double.
    if (!(std::abs(row[0] - dt * double(values.size())) <= 0.1 * dt + 5e-4))
      refuse(source, line, "its time is off an even step of " + number(dt) + " s; fetch it again");
    values.push_back(row[column]);
  }
  return values;
}

/// "#AmplitudeMAX. U:    1.196~   -1.017": greatest of both.
std::optional<double> peak_of(const RecordSource& source, Lines lines, const std::string& component)
{
  const std::string key = "#AmplitudeMAX. " + component + ":";
  for (const Line& line : lines)
    if (line.text.starts_with(key))
    {
      const auto high = number_behind(line.text, key), low = number_behind(line.text, "~");
      if (!high || !low) refuse(source, line, "expected two numbers behind " + key + "; fetch it again");
      return std::max(std::abs(*high), std::abs(*low));
    }
  return {};
}
} // namespace

bool is_cwb(std::string_view head, Lines)
{
  return head.find("#datasequence") != head.npos && head.find("#amplitudeunit") != head.npos;
}

Record read_cwb(const RecordSource& source, Lines lines)
{
  const std::vector<std::string> components = components_of(source, lines);
  const std::size_t chosen = chosen_component(source, components);
  const double rate = number_of(source, lines, "#SampleRate(Hz):");
  const double length = number_of(source, lines, "#RecordLength(sec):");
  const Line& unit_line = keyed(source, lines, "#AmplitudeUnit:");
  const std::string_view stated = bare(unit_line.text.substr(15));
  const auto unit = parse_unit(stated.substr(0, stated.find(". ")));
  if (!unit || unit->name != "gal")
    refuse(source, unit_line, "states the unit " + shown(stated) + "; CWB's files are in gal");
  Channel channel{components[chosen], *unit, 1 / rate, std::size_t(&unit_line - lines.data()),
                  column_of(source, lines, chosen + 1, components.size() + 1, 1 / rate)};
  // The length may count the intervals or the samples.
  const double beyond = double(channel.values.size()) - rate * length; // 1: with both ends
  if (beyond < -0.01 || beyond > 1.01)
    refuse(source, keyed(source, lines, "#RecordLength(sec):"),
           "announces " + number(rate * length) + " values, and the file holds " +
               std::to_string(channel.values.size()) + "; fetch it again");
  channel.peak = peak_of(source, lines, components[chosen]);
  if (channel.peak) channel.peak_tolerance = 1e-3 * (1 + *channel.peak);
  return record_of(source, lines, "cwb", std::move(channel));
}
} // namespace mpm::records
