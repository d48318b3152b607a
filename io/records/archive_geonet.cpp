// GeoNet: GNS Science, New Zealand, https://www.geonet.org.nz. Volumes 1 (uncorrected) and 2 (corrected),
// three components a file: 16 lines of text, 10 of numbers, then values of 8 characters, ten a line.

#include "io/records/archives.hpp"

namespace mpm::records
{
namespace
{
constexpr std::size_t text_lines = 16, number_lines = 10;

/// Accelerations have one digit behind the point, the header's reals and what follows in volume 2 have more.
bool has_one_decimal(std::string_view line)
{
  for (std::string_view cell : cells_of(line, " "))
    if (!cell.empty() && (cell.size() < 2 || cell[cell.size() - 2] != '.')) return false;
  return !bare(line).empty();
}

/// Values of a component whose 16 lines of text begin at `start`.
Channel channel_of(const RecordSource& source, Lines lines, std::size_t start)
{
  if (lines.size() < start + text_lines + number_lines + 1)
    refuse(source, lines.back(), "ends within a header; fetch it again");
  const Lines text = lines.subspan(start, text_lines);
  // The 16 lines are in no fixed order from year to year; each is known by what it says.
  const Line *points = nullptr, *spacing = nullptr, *component = nullptr, *peak = nullptr;
  for (const Line& line : text)
  {
    const std::string name = lower(line.text);
    if (name.starts_with("number of points")) points = &line;
    if (name.find("sec intervals") != name.npos || name.find("at intervals of") != name.npos) spacing = &line;
    if (name.starts_with("component")) component = &line;
    if (name.starts_with("acceleration:")) peak = &line;
  }
  if (!points || !spacing || !component || !peak)
    refuse(source, text.front(), "has no number of points, interval, component or peak in its GeoNet header");
  const bool raw = lower(spacing->text).starts_with("raw readings");
  const auto dt = number_behind(spacing->text, raw ? "intervals of" : "data at");
  const auto one = raw ? number_behind(spacing->text, "in units of") : std::optional(1.);
  const auto largest = number_behind(peak->text, "peak");
  if (!dt || !(*dt > 0) || one != 1. || !largest ||
      lower(peak->text).find(" mm/s/s at") == std::string::npos ||
      (raw && lower(spacing->text).find(" mm/s/s ") == std::string::npos))
    refuse(source, *spacing, "is not in mm/s/s at a stated interval, as GeoNet's files are; fetch it again");
  const std::size_t count = count_behind(source, *points, "Number of points");
  // Points, interval and duration are printed independently of each other.
  const auto duration = number_behind(points->text, "Duration");
  if (!duration || std::abs(*duration - double(count) * *dt) > 1.5 * *dt + 0.01)
    refuse(source, *points,
           std::to_string(count) + " points at " + number(*dt) +
               " s do not last as the line says; fetch it again");
  std::size_t at = start + text_lines + number_lines;
  const std::string_view name = bare(component->text.substr(9));
  Channel channel{std::string(name.substr(0, name.find(' '))), *parse_unit("mm/s2"), *dt, start,
                  fixed_numbers(source, lines, at, count, 8, 10)};
  for (std::size_t i = start + text_lines + number_lines; i < at; ++i)
    if (!has_one_decimal(lines[i].text))
      refuse(source, lines[i], "expected accelerations with one digit behind the point; fetch it again");
  if (at < lines.size() && has_one_decimal(lines[at].text))
    refuse(source, lines[at], "goes on behind the values that the header counts; fetch it again");
  channel.peak = largest;
  channel.peak_tolerance = 0.2 + 1e-3 * std::abs(*largest);
  return channel;
}
} // namespace

bool is_geonet(std::string_view head, Lines)
{
  return head.find("accelerogram") != head.npos && head.find("gns science") != head.npos;
}

Record read_geonet(const RecordSource& source, Lines lines)
{
  std::vector<Channel> channels;
  std::vector<std::string> components;
  for (std::size_t at = 0; at < lines.size(); ++at)
  {
    if (lower(lines[at].text).find("gns science") == std::string::npos) continue;
    channels.push_back(channel_of(source, lines, at));
    components.push_back(channels.back().component);
  }
  return record_of(source, lines, "geonet", std::move(channels[chosen_component(source, components)]));
}
} // namespace mpm::records
