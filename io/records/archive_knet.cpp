// K-NET and KiK-net: National Research Institute for Earth Science and Disaster Resilience (NIED), Japan,
// K-NET ASCII format, https://www.kyoshin.bosai.go.jp. One component a file, counts with a factor to gal
// and an offset.

#include "io/records/archives.hpp"

#include <algorithm>

namespace mpm::records
{
namespace
{
/// The line of the header with a label, one of the first of the file.
const Line& labelled(const RecordSource& source, Lines lines, std::string_view label)
{
  const auto found = std::ranges::find_if(lines.first(std::min<std::size_t>(lines.size(), 30)),
                                          [&](const Line& line) { return line.text.starts_with(label); });
  if (found == lines.begin() + long(std::min<std::size_t>(lines.size(), 30)))
    refuse(source, "has no line '" + std::string(label) + "' in its K-NET header; fetch it again");
  return *found;
}

/// The number above zero behind a label; `end` is the unit printed after it.
double number_of(const RecordSource& source, Lines lines, std::string_view label, std::string_view end = "")
{
  const Line& line = labelled(source, lines, label);
  std::string_view text = bare(line.text.substr(label.size()));
  if (text.ends_with(end)) text.remove_suffix(end.size());
  const auto value = take_number(text);
  if (!value || !text.empty() || !(*value > 0))
    refuse(source, line, "expected a number and found " + shown(line.text) + "; fetch it again");
  return *value;
}

/// gal of one count: "3920(gal)/6182761".
double scale_of(const RecordSource& source, Lines lines)
{
  const Line& line = labelled(source, lines, "Scale Factor");
  const std::string_view text = bare(line.text.substr(12));
  const std::size_t slash = text.find("(gal)/");
  std::string_view above = text.substr(0, slash), below = slash == text.npos ? "" : text.substr(slash + 6);
  const auto top = take_number(above), bottom = take_number(below);
  if (!top || !bottom || !above.empty() || !below.empty() || !(*top > 0 && *bottom > 0))
    refuse(source, line,
           "expected a factor as '3920(gal)/6182761' and found " + shown(text) + "; fetch it again");
  return *top / *bottom;
}

/// "E-W" of K-NET; 4 to 6 of KiK-net are N-S, E-W and U-D at the surface, 1 to 3 the same in the borehole.
std::string component_of(const RecordSource& source, Lines lines)
{
  const Line& line = labelled(source, lines, "Dir.");
  const std::string_view name = bare(line.text.substr(4));
  for (std::string_view known : {"N-S", "E-W", "U-D"})
    if (name == known) return std::string(name);
  if (name.size() != 1 || name[0] < '1' || name[0] > '6')
    refuse(source, line, "names the direction " + shown(name) + ", which is none of K-NET or KiK-net");
  if (name[0] <= '3')
    refuse(source, "looks like KiK-net, and it is the borehole's: " + std::string(why_not_within));
  return name[0] == '4' ? "N-S" : name[0] == '5' ? "E-W" : "U-D";
}
} // namespace

bool is_knet(std::string_view head, Lines)
{
  return head.find("scale factor") != head.npos && head.find("(gal)/") != head.npos;
}

Record read_knet(const RecordSource& source, Lines lines)
{
  const std::string component = component_of(source, lines);
  chosen_component(source, {component});
  const double rate = number_of(source, lines, "Sampling Freq(Hz)", "Hz");
  const double duration = number_of(source, lines, "Duration Time(s)");
  const double scale = scale_of(source, lines), peak = number_of(source, lines, "Max. Acc. (gal)");
  const Line& memo = labelled(source, lines, "Memo.");
  std::vector<double> values;
  for (const Line& line : lines)
    if (line.number > memo.number)
      for (double count : numbers_at(source, Line{bare(line.text), line.number})) values.push_back(count);
  // Every line of values ends with a blank, so that a cut within the last number shows.
  const auto ends_blank = [](const Line& line) { return !line.text.empty() && is_blank(line.text.back()); };
  if (ends_blank(lines[lines.size() - 2]) && !ends_blank(lines.back()) && !lines.back().text.empty())
    refuse(source, lines.back(),
           "ends without the blank of the lines above it; fetch it again, it is cut off");
  // The header counts no samples but tells rate and duration.
  const auto expected = std::size_t(std::round(std::clamp(rate * duration, 0.0, 1e15)));
  if (values.size() != expected)
    refuse(source, labelled(source, lines, "Duration Time(s)"),
           "the header announces " + std::to_string(expected) + " values, and the file holds " +
               std::to_string(values.size()) + "; fetch it again");
  // Counts have an offset of the instrument, which twice integrated would be a drift of kilometres.
  double mean = 0;
  for (double value : values) mean += value / double(values.size());
  for (double& value : values) value = (value - mean) * scale;
  Channel channel{component, *parse_unit("gal"), 1 / rate, std::size_t(&memo - lines.data()),
                  std::move(values)};
  channel.peak = peak; // printed to 0.001 gal, of an offset that is a mean too
  channel.peak_tolerance = 0.005 + 0.005 * peak;
  Record record = record_of(source, lines, "knet", std::move(channel));
  record.notes.push_back(source.file + ": its offset, a mean of " + number(mean * scale) +
                         " gal, is taken off");
  return record;
}
} // namespace mpm::records
