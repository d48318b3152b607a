// COSMOS: Consortium of Organizations for Strong-Motion Observation Systems (2001), COSMOS strong motion
// data format, version 1.20, https://www.strongmotion.org/vdc/cosmos_format_1_20.pdf. For each component
// and quantity a block of text, 100 integers, 100 reals, comments and values.

#include "io/records/archives.hpp"

namespace mpm::records
{
namespace
{
constexpr double unknown = -999; ///< where a header has no value

/// "Sta Chan   1: 340 deg (Rcrdr Chan  1) Location:": what stands between the key and the bracket.
std::string component_of(Lines head)
{
  for (const Line& line : head)
    for (std::string_view key : {"Sta Chan", "Sta Cha:", "Sta Chn:"})
      if (line.text.starts_with(key))
      {
        const std::string_view rest = line.text.substr(key.size());
        const std::string_view name = bare(rest.substr(0, rest.find('(')));
        return std::string(name.substr(std::min(name.find_first_not_of(": "), name.size())));
      }
  return "unnamed";
}

/// "7000  acceleration pts, approx   70 secs, units=cm/sec2(04),Format=(8F10.5)".
Channel channel_of(const RecordSource& source, Lines lines, std::size_t at, const std::vector<double>& reals,
                   std::string component)
{
  const Line& line = lines[at];
  std::string_view rest = bare(line.text);
  const auto count = take_number(rest);
  const std::string_view text = text_behind(line.text, "units=");
  const std::string_view stated = text.substr(0, text.find_first_of("(,"));
  const auto unit = parse_unit(stated);
  const auto format = fortran_format(text_behind(line.text, "format="));
  const double step = reals[61] / 1000, length = reals[62]; // ms, s
  if (!unit)
    refuse(source, line,
           "states the unit " + shown(stated) + ", which is not known; give a corrected record");
  // The unit stands twice, as a word and as a code of the format: some writers filled in only one of them.
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> codes{
      std::pair{"(04)", "cm/s2"}, {"(05)", "cm/s"}, {"(06)", "cm"}};
  for (const auto& [code, name] : codes)
    if (text.find(code) != text.npos && !(*unit == *parse_unit(name)))
      refuse(source, line,
             "states the unit " + unit->name + " beside the code of " + std::string(name) +
                 "; fetch it again");
  if (!count || !(*count >= 2 && *count <= 1e9) || !format || !(step > 0))
    refuse(
        source, line,
        "is a COSMOS record without number of values, format or time step (real header 62); fetch it again");
  // The length stands twice as well, to the sample in the reals and in round seconds in the text.
  const auto seconds = number_behind(line.text, "approx");
  for (const auto& [last, slack] :
       {std::pair{length, 1.5 * step + 1e-3}, {seconds.value_or(unknown), 1.5 * step + 1}})
    if (last != unknown && std::abs(*count * step - last) > slack)
      refuse(source, line,
             "holds " + number(*count) + " values at " + number(step) + " s, and the header says it lasts " +
                 number(last) + " s; fetch it again");
  std::size_t body = at + 1;
  Channel channel{std::move(component), *unit, step, at,
                  fixed_numbers(source, lines, body, std::size_t(*count), format->width, format->per_line)};
  check_end(source, lines, body);
  // Real header 64: the greatest value, in the unit of the values.
  if (reals[63] != unknown) channel.peak = reals[63];
  if (channel.peak) channel.peak_tolerance = 1e-3 * std::abs(*channel.peak) + 1e-4;
  return channel;
}

/// The numbers of a header block whose first line, at `at`, tells how many there are and in which format.
std::vector<double> header_numbers(const RecordSource& source, Lines lines, std::size_t& at)
{
  const std::size_t start = at++;
  std::string_view text = bare(lines[start].text);
  const auto format = fortran_format(text);
  const auto count = take_number(text);
  if (!format) refuse(source, lines[start], "states no format as (5F15.6); fetch it again");
  if (!count || *count < 64 || *count > 1000)
    refuse(source, lines[start], "expected 100 values of a COSMOS header");
  return fixed_numbers(source, lines, at, std::size_t(*count), format->width, format->per_line);
}
} // namespace

bool is_cosmos(std::string_view head, Lines)
{
  return head.find("(format v") != head.npos && head.find("text lines") != head.npos;
}

Record read_cosmos(const RecordSource& source, Lines lines)
{
  std::vector<Channel> channels;
  std::vector<std::string> components;
  std::vector<double> reals;
  std::string component = "unnamed";
  for (std::size_t at = 0; at < lines.size(); ++at)
  {
    const std::string text = lower(lines[at].text);
    // A block of text begins a channel; reals and values that follow are its own.
    if (text.find("(format v") != text.npos)
    {
      component = component_of(lines.subspan(at, std::min<std::size_t>(13, lines.size() - at)));
      reals.clear();
    }
    else if (text.find("real-header values follow") != text.npos)
    {
      // The loop goes on behind the block.
      reals = header_numbers(source, lines, at);
      --at;
    }
    else if (text.find(" pts, approx") != text.npos && text.find("units=") != text.npos)
    {
      if (reals.size() < 64)
        refuse(source, lines[at], "has no 100 real-header values above it; fetch it again");
      Channel channel = channel_of(source, lines, at, reals, component);
      if (channel.unit.quantity != source.quantity.value_or(Quantity::acceleration)) continue;
      components.push_back(component);
      channels.push_back(std::move(channel));
    }
  }
  if (channels.empty())
    refuse(source, "looks like COSMOS, and holds no acceleration that is read; give the corrected record");
  return record_of(source, lines, "cosmos", std::move(channels[chosen_component(source, components)]));
}
} // namespace mpm::records
