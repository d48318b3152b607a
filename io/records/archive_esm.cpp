// DYNA, the format of ESM, ITACA and others: Luzi, L. et al. (2016), The Engineering Strong-Motion
// Database: a platform to access pan-European accelerometric data, Seismological Research Letters 87(4),
// 987-997, https://esm-db.eu. One component a file, keys and values above one value a line.

#include "io/records/archives.hpp"

namespace mpm::records
{
namespace
{
/// "KEY: value" lines.
struct Header
{
  const RecordSource& source;
  Lines lines;

  const Line* find(std::string_view key) const
  {
    for (const Line& line : lines)
      if (line.text.starts_with(key) && line.text.substr(key.size()).starts_with(":")) return &line;
    return nullptr;
  }
  std::string_view text(std::string_view key) const
  {
    const Line* line = find(key);
    if (!line) refuse(source, "has no " + std::string(key) + " in its header; fetch it again");
    return bare(line->text.substr(key.size() + 1));
  }
  /// Empty where the key is missing or has no value.
  std::optional<double> number(std::string_view key) const
  {
    const Line* line = find(key);
    std::string_view rest = line ? bare(line->text.substr(key.size() + 1)) : "";
    if (rest.empty()) return {};
    const auto value = take_number(rest);
    if (!value || !rest.empty())
      refuse(source, *line, "expected a number and found " + shown(line->text) + "; fetch it again");
    return value;
  }
};

/// The unit that the header states, of the quantity that it names.
RecordUnit unit_of(const RecordSource& source, const Header& header)
{
  const Line& line = *header.find("UNITS");
  const auto unit = parse_unit(header.text("UNITS"));
  if (!unit) refuse(source, line, "states the unit " + shown(header.text("UNITS")) + ", which is not known");
  if (header.find("DATA_TYPE"))
    if (const std::string type = lower(header.text("DATA_TYPE")); quantity_from(type) != unit->quantity)
      refuse(source, line, "is in " + unit->name + ", and DATA_TYPE says " + type + "; fetch it again");
  return *unit;
}
} // namespace

bool is_esm(std::string_view head, Lines)
{
  return head.find("sampling_interval_s:") != head.npos &&
         (head.find("ndata:") != head.npos || head.find("event_name:") != head.npos);
}

Record read_esm(const RecordSource& source, Lines lines)
{
  std::size_t body = 0;
  // Keys with values, until the first line that is none.
  while (body < lines.size() && !lines[body].text.empty() && is_letter(lines[body].text[0]) &&
         lines[body].text.find(':') != std::string_view::npos)
    ++body;
  const Header header{source, lines.first(body)};
  const std::string component(header.text("STREAM"));
  chosen_component(source, {component});
  const auto dt = header.number("SAMPLING_INTERVAL_S"), count = header.number("NDATA");
  header.text("UNITS");
  if (!dt || !(*dt > 0) || !count || !(*count >= 2))
    refuse(source, "has no SAMPLING_INTERVAL_S or NDATA above 0 in its header; fetch it again");
  std::vector<double> values;
  for (const Line& line : lines.subspan(body))
    if (!bare(line.text).empty())
    {
      const std::vector<double> numbers = numbers_at(source, Line{bare(line.text), line.number});
      if (numbers.size() != 1) refuse(source, line, "expected 1 number a line and found " + shown(line.text));
      values.push_back(numbers[0]);
    }
  const Line& ndata = *header.find("NDATA");
  if (double(values.size()) != *count)
    refuse(source, ndata,
           "NDATA is " + number(*count) + ", and the file holds " + std::to_string(values.size()) +
               " values; fetch it again");
  // Printed to a hundredth of a second, and with or without the last interval.
  const auto duration = header.number("DURATION_S");
  if (duration && std::abs(*duration - *dt * *count) > 1.5 * *dt + 0.0051)
    refuse(source, ndata,
           "DURATION_S is " + number(*duration) + " s, and " + number(*count) + " values at " + number(*dt) +
               " s last otherwise; fetch it again");
  Channel channel{component, unit_of(source, header), *dt, std::size_t(&ndata - lines.data()),
                  std::move(values)};
  // Peaks are in cm whatever the unit of the values.
  const std::string_view key = channel.unit.quantity == Quantity::acceleration ? "PGA_CM/S^2"
                               : channel.unit.quantity == Quantity::velocity   ? "PGV_CM/S"
                                                                               : "PGD_CM";
  if (const auto peak = header.number(key))
  {
    channel.peak = *peak * 0.01 / channel.unit.si;
    channel.peak_tolerance = 1e-3 * std::abs(*channel.peak) + 2e-6;
  }
  return record_of(source, lines, "esm", std::move(channel));
}
} // namespace mpm::records
