// BHRC: Iran Strong Motion Network, Road, Housing and Urban Development Research Center (formerly Building
// and Housing Research Center), Tehran, https://ismn.bhrc.ac.ir. Volume 1, three components a file: 13
// lines of text, 7 of integers, 7 of reals, then values of 13 characters in g/10, ten a line.

#include "io/records/archives.hpp"

namespace mpm::records
{
namespace
{
constexpr std::size_t text_lines = 13, integer_lines = 7, real_lines = 7;

Channel channel_of(const RecordSource& source, Lines lines, std::size_t start)
{
  const std::size_t body = start + text_lines + integer_lines + real_lines;
  if (lines.size() <= body) refuse(source, lines.back(), "ends within a header; fetch it again");
  const Line &points = lines[start + 10], &units = lines[start + 11],
             &rate_line = lines[body - real_lines + 1];
  const std::string_view name = bare(lines[start + 6].text);
  const auto unit = parse_unit(text_behind(units.text, "SECONDS AND "));
  if (!name.starts_with("COMP") || !unit)
    refuse(source, units, "is not UNITS ARE SECONDS AND G/10 below a line COMP, as BHRC's files have it");
  // The rate stands among the reals, the number of points and the duration in the text: they have to fit.
  const std::size_t count = count_behind(source, points, "NO. OF POINTS");
  const auto duration = number_behind(points.text, "DURATION");
  std::string_view real = bare(rate_line.text);
  const auto rate = take_number(real);
  if (!duration || !rate || !(*rate > 0) || std::abs(*duration * *rate - double(count)) > 1.5)
    refuse(source, points,
           "its duration and the sampling rate in line " + std::to_string(rate_line.number) +
               " do not make its number of points; fetch it again");
  std::size_t at = body;
  Channel channel{std::string(bare(name.substr(4))), *unit, 1 / *rate, start + 10,
                  fixed_numbers(source, lines, at, count, 13, 10)};
  check_end(source, lines, at);
  return channel;
}
} // namespace

bool is_bhrc(std::string_view head, Lines)
{
  return head.starts_with("* vol") && head.find("\ncomp ") != head.npos;
}

Record read_bhrc(const RecordSource& source, Lines lines)
{
  if (!lines[0].text.starts_with("* VOL1DS"))
    refuse(source, lines[0], "looks like BHRC of a volume that is not read; give volume 1");
  std::vector<Channel> channels;
  std::vector<std::string> components;
  for (std::size_t at = 0; at < lines.size(); ++at)
  {
    if (!lines[at].text.starts_with("* VOL1DS")) continue;
    channels.push_back(channel_of(source, lines, at));
    components.push_back(channels.back().component);
  }
  return record_of(source, lines, "bhrc", std::move(channels[chosen_component(source, components)]));
}
} // namespace mpm::records
