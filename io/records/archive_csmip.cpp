// CSMIP: California Strong Motion Instrumentation Program, California Geological Survey. Shakal, A. F. and
// Huang, M. J. (1985), Standard tape format for CSMIP strong-motion data tapes, report OSMS 85-03. Volume
// 1, uncorrected, and volume 2, corrected acceleration, velocity and displacement: for each channel a
// block of text, integers, reals and values.

#include "io/records/archives.hpp"

namespace mpm::records
{
namespace
{
/// What the text above a channel's values says of it.
struct Heading
{
  std::string component = "unnamed";
  std::optional<double> peak[3]; ///< acceleration, velocity, displacement in SI
  std::optional<double> points;
};

void read_heading(const Line& line, Heading& heading)
{
  const std::string_view text = bare(line.text);
  if (text.starts_with("Chan") && text.find(':') != text.npos)
  {
    heading.component = text;
    return;
  }
  // As they are printed, blanks included.
  constexpr std::array<std::string_view, 3> peaks{"peak acceleration", "peak   velocity",
                                                  "peak displacement"};
  for (std::size_t i = 0; i < peaks.size(); ++i)
    if (lower(text).starts_with(peaks[i])) heading.peak[i] = quantity_behind(text, "=");
  if (text.starts_with("Units of uncor data")) heading.peak[0] = quantity_behind(text, "Max  =");
  if (text.starts_with("No. of Points")) heading.points = number_behind(text, "=");
}

/// The line above the values: how many, their step in s, their unit. 0: it does not tell.
struct DataLine
{
  double count, dt;
  std::string_view unit;
};

/// "7500 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.6)", or
/// "13200 Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)".
std::optional<DataLine> data_line(const Line& line)
{
  const std::string text = lower(line.text);
  std::string_view rest = bare(line.text);
  // Volume 2 tells an interval, volume 1 a rate.
  const bool corrected = text.find("points of ") != text.npos && text.find("equally spaced at") != text.npos;
  const bool uncorrected = text.find("accelerogram points at") != text.npos;
  if (!corrected && !uncorrected) return {};
  const auto count = take_number(rest);
  const auto spacing = number_behind(line.text, corrected ? "equally spaced at" : "points at");
  std::string_view unit = text_behind(line.text, corrected ? " in " : "in units of");
  unit = unit.substr(0, std::min(unit.find(corrected ? ". " : " ."), unit.find('(')));
  const bool has_step = text.find(corrected ? " sec" : " pts/sec") != text.npos;
  if (!count || !spacing || !(*spacing > 0) || !has_step) return DataLine{0, 0, unit};
  return DataLine{*count, corrected ? *spacing : 1 / *spacing, unit};
}

/// The values below a data line at `at`, which moves to their last line.
Channel channel_of(const RecordSource& source, Lines lines, std::size_t& at, const DataLine& data,
                   const Heading& heading)
{
  const Line& line = lines[at];
  const auto unit = parse_unit(data.unit);
  const auto format = fortran_format(line.text);
  if (!unit) refuse(source, line, "states the unit " + shown(bare(data.unit)) + ", which is not known");
  if (!(data.count >= 2 && data.count <= 1e9) || !format)
    refuse(source, line, "is a CSMIP record without number of values, time step or format; fetch it again");
  if (heading.points && *heading.points != data.count)
    refuse(source, line,
           "holds " + number(data.count) + " values, and the header says " + number(*heading.points) +
               "; fetch it again");
  const std::size_t start = at++;
  Channel channel{heading.component, *unit, data.dt, start,
                  fixed_numbers(source, lines, at, std::size_t(data.count), format->width, format->per_line)};
  check_end(source, lines, at--);
  // Peaks are in the order of Quantity.
  channel.peak = heading.peak[static_cast<int>(unit->quantity)];
  if (!channel.peak) return channel;
  *channel.peak /= unit->si;
  channel.peak_tolerance = 1e-3 * (1 + std::abs(*channel.peak)); // printed with 3 digits
  return channel;
}
} // namespace

bool is_csmip(std::string_view head, Lines)
{
  return head.find("accelerogram") != head.npos && head.find("data of volume i") == head.npos &&
         (head.find("csmip") != head.npos || head.find("cdmg") != head.npos);
}

Record read_csmip(const RecordSource& source, Lines lines)
{
  std::vector<Channel> channels;
  std::vector<std::string> components;
  Heading heading;
  for (std::size_t at = 0; at < lines.size(); ++at)
  {
    // What ends a channel: the heading of the next one owes nothing to this.
    if (lines[at].text.starts_with("/&")) heading = {};
    read_heading(lines[at], heading);
    const auto data = data_line(lines[at]);
    if (!data) continue;
    Channel channel = channel_of(source, lines, at, *data, heading);
    // Volume 2 has velocity and displacement of each channel below its acceleration.
    if (channel.unit.quantity != source.quantity.value_or(Quantity::acceleration)) continue;
    components.push_back(channel.component);
    channels.push_back(std::move(channel));
  }
  if (channels.empty())
    refuse(source, "looks like CSMIP, and holds no acceleration that is read; fetch it again");
  return record_of(source, lines, "csmip", std::move(channels[chosen_component(source, components)]));
}
} // namespace mpm::records
