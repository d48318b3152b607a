#include "io/record_units.hpp"

#include "io/error.hpp"
#include "io/input_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

namespace mpm
{
using namespace records;

namespace
{
/// An archive's format that is not read, told by two marks (lower case) near the start of the file.
struct Foreign
{
  std::string_view name, mark, second_mark;
};
constexpr std::array foreign{
    Foreign{"KiK-net or K-NET", "scale factor", "(gal)/"},
    Foreign{"COSMOS", "(format v", "text lines"},
    Foreign{"CSMIP", "accelerogram", "csmip"},
    Foreign{"GeoNet", "accelerogram", "gns science"},
    Foreign{"USC (Caltech volume II)", "accelerogram", "data of volume i"},
    Foreign{"CWB", "#datasequence", "#amplitudeunit"},
    Foreign{"AFAD (Turkiye)", "strong ground motion records", "sampling interval"},
    Foreign{"ESM or ITACA (DYNA)", "event_name:", "sampling_interval_s:"},
    Foreign{"an HTML page", "<html", ""},
};

/// dt of the file, or the case's where that agrees to within `tolerance` (relative).
double agreed_dt(const RecordSource& source, const Line& line, double dt, double tolerance)
{
  if (std::isnan(source.dt)) return dt;
  if (!(std::abs(dt - source.dt) <= tolerance * dt))
    refuse(source, line,
           "the file's dt is " + number(dt) + " s and the case says " + number(source.dt) +
               " s; leave dt out of the case");
  return source.dt;
}

Record finished(const RecordSource& source, std::string format, const RecordUnit& unit, double dt,
                std::vector<double> values, std::vector<std::string> notes)
{
  if (values.size() < 2) refuse(source, "holds " + std::to_string(values.size()) + " values; not a record");
  for (double& value : values) value *= unit.si;
  return {source.file,   std::move(format), std::string(unit.name), dt,
          unit.quantity, std::move(values), std::move(notes)};
}

struct PeerHeader
{
  std::size_t line; ///< its index
  long count;
  double dt;
};

/// Number after `key =` in a lower case line.
std::optional<double> number_after(const std::string& text, std::string_view key, std::size_t from)
{
  std::size_t at = text.find(key, from);
  if (at == std::string::npos) return {};
  at += key.size();
  while (at < text.size() && (is_blank(text[at]) || text[at] == '=' || text[at] == ':')) ++at;
  std::size_t end = at; // "DT=.005SEC" ends where the letters of its unit begin
  while (end < text.size() && !is_blank(text[end]) && text[end] != ',' &&
         !(is_letter(text[end]) && text[end] == 's'))
    ++end;
  std::string_view rest = std::string_view(text).substr(at, end - at);
  return take_number(rest);
}

/// "NPTS=  4000, DT= .01000 SEC" or "4164    0.0100    NPTS, DT", among the first lines.
std::optional<PeerHeader> peer_header(const RecordSource& source, const std::vector<Line>& lines)
{
  for (std::size_t i = 0; i < std::min<std::size_t>(lines.size(), 50); ++i)
  {
    const std::string text = lower(lines[i].text);
    const std::size_t npts = text.find("npts");
    if (npts == std::string::npos) continue;
    auto count = number_after(text, "npts", npts), dt = number_after(text, "dt", npts);
    if (std::string_view before = text; !count && (count = take_number(before)))
    {
      skip_separator(before);
      dt = take_number(before);
    }
    if (!count || !dt || !(*count >= 2 && *count <= 1e9) || *count != std::floor(*count) || !(*dt > 0))
      refuse(source, lines[i],
             "cannot take NPTS and DT from " + quoted(lines[i].text) +
                 "; write it as 'NPTS= 4000, DT= .01000 SEC'");
    return PeerHeader{i, long(*count), *dt};
  }
  return {};
}

Record read_peer(const RecordSource& source, const std::vector<Line>& lines, const PeerHeader& header)
{
  const auto count = std::size_t(header.count);
  const double dt = agreed_dt(source, lines[header.line], header.dt, 1e-6);
  const Said said = said_by_units_line({lines.begin(), lines.begin() + long(header.line)});
  const RecordUnit unit = agreed_unit(source, said, unit_by_extension(source.file));
  std::vector<double> values;
  std::size_t i = header.line + 1;
  for (; i < lines.size() && values.size() < count; ++i)
    for (double value : numbers_at(source, lines[i])) values.push_back(value);
  if (values.size() < count)
    refuse(source, lines[header.line],
           "NPTS is " + std::to_string(count) + " and the file holds " + std::to_string(values.size()) +
               " values; fetch it again, it is cut off");
  std::vector<std::string> notes;
  if (values.size() > count || i < lines.size())
    notes.push_back(source.file + ": what follows the " + std::to_string(count) +
                    " values of NPTS is passed over");
  values.resize(count);
  return finished(source, "peer", unit, dt, std::move(values), std::move(notes));
}

struct Table
{
  std::vector<std::array<double, 2>> rows; ///< one column: the value in [0]
  std::vector<Line> lines;
  Said said;
};

/// One or two columns of numbers below at most one header line; '#' and '%' begin comments.
Table read_table(const RecordSource& source, const std::vector<Line>& lines, std::size_t columns)
{
  Table table;
  for (const Line& line : lines)
  {
    if (line.text.front() == '#' || line.text.front() == '%') continue;
    if (table.rows.empty() && table.said.line.number == 0 && !numbers_in(line.text))
    {
      table.said = said_by_column_header(line);
      continue;
    }
    const std::vector<double> values = numbers_at(source, line);
    if (values.size() != columns)
      refuse(source, line,
             "expected " + std::to_string(columns) + (columns == 1 ? " number" : " numbers") + " and found " +
                 std::to_string(values.size()) + " in " + quoted(line.text) +
                 "; numbers take a decimal point, not a comma");
    table.rows.push_back({values[0], values.back()});
    table.lines.push_back(line);
  }
  if (table.rows.size() < 2)
    refuse(source, "holds " + std::to_string(table.rows.size()) + " values; not a record");
  return table;
}

Record read_column(const RecordSource& source, const std::vector<Line>& lines)
{
  const Table table = read_table(source, lines, 1);
  if (std::isnan(source.dt))
    refuse(source, "a single column does not hold its time step; give dt, e.g. dt: 0.005 s");
  std::vector<double> values;
  for (const auto& row : table.rows) values.push_back(row[0]);
  return finished(source, "column", agreed_unit(source, table.said, nullptr), source.dt, std::move(values),
                  {});
}

/// Step of evenly spaced times. Printed times are rounded, so each may be off by a tenth of it.
double even_step(const RecordSource& source, const Table& table)
{
  const auto& rows = table.rows;
  std::vector<double> steps;
  for (std::size_t i = 1; i < rows.size(); ++i) steps.push_back(rows[i][0] - rows[i - 1][0]);
  std::vector<double> sorted = steps;
  std::ranges::nth_element(sorted, sorted.begin() + long(sorted.size() / 2));
  const double typical = sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (!(typical > 0) || std::abs(steps[i] - typical) > 0.2 * typical)
      refuse(source, table.lines[i + 1],
             "time goes from " + number(rows[i][0]) + " to " + number(rows[i + 1][0]) +
                 " s where others step by " + number(typical) +
                 " s; resample the record evenly (first column: time in s)");
  const double dt = (rows.back()[0] - rows.front()[0]) / double(steps.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::abs(rows[i][0] - rows[0][0] - dt * double(i)) > 0.1 * dt)
      refuse(source, table.lines[i],
             "time " + number(rows[i][0]) + " s is off an even step of " + number(dt) +
                 " s; resample the record evenly");
  return dt;
}

Record read_two_columns(const RecordSource& source, const std::vector<Line>& lines)
{
  const Table table = read_table(source, lines, 2);
  const double dt = agreed_dt(source, table.lines.front(), even_step(source, table), 1e-3);
  std::vector<double> values;
  for (const auto& row : table.rows) values.push_back(row[1]);
  std::vector<std::string> notes;
  if (const double start = table.rows[0][0]; std::abs(start) > 0.5 * dt)
    notes.push_back(source.file + ": its time begins at " + number(start) + " s, which becomes t = 0");
  return finished(source, "two_column", agreed_unit(source, table.said, nullptr), dt, std::move(values),
                  std::move(notes));
}

/// Refuses, by name, the formats of other archives.
void refuse_foreign(const RecordSource& source, std::string_view text, const std::vector<Line>& lines)
{
  const auto refuse_as = [&](std::string_view name, std::string_view more = {})
  {
    refuse(source, "looks like " + std::string(name) + ", which is not read" + std::string(more) +
                       "; convert it to two columns, time in s and acceleration");
  };
  if (text.substr(0, 4096).find('\0') != std::string_view::npos) refuse_as("a binary file");
  if (lines.size() > 1 && lines[1].text == "*" && is_digit(lines[0].text.front())) refuse_as("SMC");
  const std::string head = lower(text.substr(0, 4096));
  for (const Foreign& format : foreign)
  {
    if (head.find(format.mark) == std::string::npos || head.find(format.second_mark) == std::string::npos)
      continue;
    if (&format != &foreign.front()) refuse_as(format.name);
    const auto direction =
        std::ranges::find_if(lines, [](const Line& line) { return line.text.starts_with("Dir."); });
    const bool numbered = direction != lines.end() && is_digit(direction->text.back()); // 1 to 6, else "E-W"
    if (!numbered) refuse_as("K-NET");
    if (direction->text.back() > '3') refuse_as("KiK-net");
    refuse_as("KiK-net", ", and it is the borehole's: " + std::string(why_not_within));
  }
}

/// Numbers on the first line that holds nothing else: how many columns there are.
std::size_t columns_of(const RecordSource& source, const std::vector<Line>& lines)
{
  for (const Line& line : lines)
    if (const auto values = numbers_in(line.text))
    {
      if (values->size() <= 2) return values->size();
      refuse(source, line,
             std::to_string(values->size()) +
                 " numbers a line and no header with NPTS and DT above: not a format that is read; "
                 "write two columns, time in s and acceleration");
    }
  refuse(source, "no line of numbers; not a record");
}
} // namespace

Record parse_record(std::string_view text, const RecordSource& source)
{
  const std::array<std::string_view, 4> formats{"auto", "peer", "column", "two_column"};
  if (std::ranges::find(formats, source.format) == formats.end())
    refuse(source, "unknown format '" + source.format + "'; use auto, peer, column or two_column");
  if (!std::isnan(source.dt) && !(source.dt > 0 && std::isfinite(source.dt)))
    refuse(source, "dt is " + number(source.dt) + " s; give a positive one");
  const std::vector<Line> lines = lines_of(text);
  if (lines.empty()) refuse(source, "is empty; fetch it again");
  if (const auto header = peer_header(source, lines))
  {
    if (source.format == "auto" || source.format == "peer") return read_peer(source, lines, *header);
    refuse(source, lines[header->line],
           "a header with NPTS and DT in what the case calls " + source.format + "; use format: peer");
  }
  refuse_foreign(source, text, lines);
  if (source.format == "peer")
    refuse(source, "no header line with NPTS and DT; use format: column or two_column");
  if (source.format == "column") return read_column(source, lines);
  if (source.format == "two_column" || columns_of(source, lines) == 2) return read_two_columns(source, lines);
  return read_column(source, lines);
}

Record read_record(const RecordSource& source)
{
  const InputText input = read_input(source.file, most_of_record);
  if (input.problem.empty()) return parse_record(input.text, source);
  const bool missing = !std::filesystem::exists(source.file);
  throw Error(exit_code::input_missing,
              source.file + ": " + input.problem +
                  (!missing                ? ""
                   : source.origin.empty() ? "; see the README for where records come from, or name another"
                                           : "; it comes from " + source.origin));
}
} // namespace mpm
