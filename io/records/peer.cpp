// PEER: Pacific Earthquake Engineering Research Center, University of California, Berkeley. Ancheta, T. D.
// et al. (2014), NGA-West2 database, Earthquake Spectra 30(3), 989-1005. Four lines of text, of which the
// third states the unit in prose and the last tells number of values and time step in one of two forms,
// then the values.

#include "boundaries/ground_motion/measures.hpp"
#include "io/common/printable.hpp"
#include "io/records/formats.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace mpm::records
{
namespace
{
/// "4164 .0100 NPTS, DT": the numbers before the words, with the unit behind DT if there is one.
std::optional<PeerHeader> numbers_first(const RecordSource& source, const Line& line, std::size_t index,
                                        std::size_t dt_word)
{
  std::string_view rest = line.text;
  const auto count = take_number(rest);
  skip_separator(rest);
  const auto dt = take_number(rest);
  if (!count || !dt) return {};
  if (rest.find_first_not_of(" \t,") != lower(rest).find("npts"))
    refuse(source, line,
           "has " + shown(trimmed(rest)) + " behind its numbers; write them as '4164 .0100 NPTS, DT'");
  const std::string_view unit = bare(line.text.substr(dt_word + 2));
  const auto step_unit = parse_step_unit(unit);
  if (!unit.empty() && !step_unit)
    refuse(source, line,
           "states the unit of DT as " + shown(unit) + ", which is not known; write SEC or MSEC");
  if (!step_unit) refuse_bare_step(source, line, *dt);
  return PeerHeader{index,
                    *count >= 2 && *count <= 1e9 && *count == std::floor(*count) ? std::size_t(*count) : 0,
                    step_unit ? step_unit->seconds(*dt) : *dt};
}

/// "NPTS= 4000, DT= .01000 SEC"; count 0 where a part of it is no number.
std::optional<PeerHeader> words_first(const RecordSource& source, const Line& line, std::size_t index,
                                      std::size_t npts_word, std::size_t dt_word)
{
  std::string_view rest = line.text.substr(npts_word + 4);
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t=:"), rest.size()));
  const auto count = take_number(rest);
  const auto step = take_step(line.text.substr(dt_word + 2));
  if (!count || !step) return {};
  // Words that may follow the step without being its unit.
  constexpr std::array<std::string_view, 8> next{"npts", "units", "unit",   "format",
                                                 "fmt",  "and",   "points", "no"};
  const std::string word = lower(step->unknown);
  if (!word.empty() && is_letter(word[0]) && std::ranges::find(next, std::string_view(word)) == next.end())
    refuse(source, line,
           "states the unit of DT as " + shown(step->unknown) + ", which is not known; write SEC or MSEC");
  if (!step->has_unit) refuse_bare_step(source, line, step->seconds);
  const bool whole = *count >= 2 && *count <= 1e9 && *count == std::floor(*count);
  return PeerHeader{index, whole ? std::size_t(*count) : 0, step->seconds};
}

/// Numbers of the body, line by line, until the count is reached; the rest is checked to be padding.
struct Body
{
  std::vector<std::vector<double>> rows;
  std::size_t values = 0;
  std::size_t end; ///< index of the first line that holds no numbers
};

Body read_body(const RecordSource& source, const std::vector<Line>& lines, const PeerHeader& header)
{
  Body body{{}, 0, header.line + 1};
  for (; body.end < lines.size(); ++body.end)
  {
    auto numbers = numbers_in(lines[body.end].text);
    if (body.values < header.count || has_decimal_commas(lines[body.end].text))
      numbers = numbers_at(source, lines[body.end]);
    if (!numbers) break;
    body.values += numbers->size();
    body.rows.push_back(std::move(*numbers));
  }
  return body;
}

/// Whether a column of all rows grows evenly, as time and index do.
bool grows_evenly(const std::vector<std::vector<double>>& rows, std::size_t column)
{
  const std::size_t n = rows.size() - 1; // the last row may be short
  const double step = (rows[n - 1][column] - rows[0][column]) / double(n - 1);
  if (step == 0) return false;
  for (std::size_t i = 0; i < n; ++i)
    if (!(std::abs(rows[i][column] - rows[0][column] - step * double(i)) <= 0.1 * std::abs(step)))
      return false;
  return true;
}

/// The second of two columns where the first is the time of the header; empty for running text. Refuses other
/// columns.
std::vector<double> column_beside_time(const RecordSource& source, const Line& line, const Body& body,
                                       const PeerHeader& header)
{
  const auto& rows = body.rows;
  const std::size_t width = rows.front().size();
  const auto has_width = [&](const auto& row) { return row.size() == width; };
  if (width < 2 || rows.size() < 8 || !std::all_of(rows.begin(), rows.end() - 1, has_width)) return {};
  std::size_t even = 0;
  for (std::size_t column = 0; column < width; ++column) even += grows_evenly(rows, column);
  // People put a time column or all three components below PEER's header. Read as running text that would be
  // noise.
  const bool one_row_a_step = rows.size() == header.count && has_width(rows.back());
  const bool ramp = even == width; // running text of an even ramp
  if (!one_row_a_step && (even == 0 || ramp)) return {};
  const double step = (rows[rows.size() - 2][0] - rows[0][0]) / double(rows.size() - 2);
  if (width == 2 && one_row_a_step && grows_evenly(rows, 0) && std::abs(step - header.dt) <= 1e-3 * header.dt)
  {
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(row[1]);
    return values;
  }
  refuse(source, line,
         "holds " + std::to_string(rows.size()) + " lines of " + std::to_string(width) +
             " numbers in columns, and NPTS is " + std::to_string(header.count) +
             "; write the values of one component only");
}

/// Whether numbers differ far less from those above them than from those beside them, as components in
/// columns do. Running text does so only where it repeats itself line by line.
bool looks_like_columns(const std::vector<std::vector<double>>& rows)
{
  double beside = 0, above = 0;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i)
    for (std::size_t k = 1; k < std::min(rows[i].size(), rows[i - 1].size()); ++k)
    {
      beside += std::pow(rows[i][k] - rows[i][k - 1], 2);
      above += std::pow(rows[i][k] - rows[i - 1][k], 2);
    }
  return rows.size() >= 20 && above < 0.3 * beside;
}

/// What is more than NPTS has to be padding with zeros.
void check_padding(const RecordSource& source, const Line& line, const Body& body, std::size_t count)
{
  std::size_t at = 0, beyond = 0;
  for (const auto& row : body.rows)
    for (double value : row) beyond += at++ >= count && value != 0;
  // A row that occurs twice in a row is no padding but a copy that went wrong.
  bool doubled = false;
  for (std::size_t i = 1; i < body.rows.size() && body.values > count; ++i)
    doubled =
        doubled || (body.rows[i] == body.rows[i - 1] && body.rows[i].size() > 1 &&
                    std::ranges::adjacent_find(body.rows[i], std::not_equal_to{}) != body.rows[i].end());
  if (beyond > 0 || doubled)
    refuse(source, line,
           "NPTS is " + std::to_string(count) + " and the file holds " + std::to_string(body.values) +
               " values, more than padding with zeros; fetch it again, or correct NPTS");
}
} // namespace

std::optional<PeerHeader> peer_header(const RecordSource& source, const std::vector<Line>& lines)
{
  const Line* candidate = nullptr;
  std::optional<PeerHeader> found;
  // Old files have the header anywhere in their first lines; a line of numbers ends it.
  for (std::size_t i = 0; i < std::min<std::size_t>(lines.size(), 50); ++i)
  {
    const std::string text = lower(lines[i].text);
    const std::size_t npts = find_word(text, "npts"), dt = find_word(text, "dt");
    if (found && numbers_in(text)) break;
    if (npts == text.npos) continue;
    if (!candidate || dt != text.npos) candidate = &lines[i];
    if (dt == text.npos) continue;
    if (find_word(text, "dt", dt + 2) != text.npos || find_word(text, "npts", npts + 4) != text.npos)
      refuse(source, lines[i], "states NPTS or DT twice; mend the header");
    auto header = words_first(source, lines[i], i, npts, dt);
    if (!header) header = numbers_first(source, lines[i], i, dt);
    if (!header || header->count == 0) continue;
    if (found && (found->count != header->count || found->dt != header->dt))
      refuse(source, lines[i],
             "states NPTS and DT otherwise than line " + std::to_string(lines[found->line].number) +
                 "; mend the header");
    found = header;
  }
  if (!found && candidate)
    refuse(source, *candidate,
           "cannot take NPTS and DT from " + shown(candidate->text) +
               "; write it as 'NPTS= 4000, DT= .01000 SEC'");
  return found;
}

Record read_peer(const RecordSource& source, const std::vector<Line>& lines, const PeerHeader& header)
{
  const std::size_t count = header.count;
  const Line& line = lines[header.line];
  const std::vector<Line> head(lines.begin(), lines.begin() + long(header.line) + 1);
  refuse_component(source);
  const double dt = agreed_dt(source, line, header.dt, 1e-6);
  check_steps(source, head, header.dt);
  const RecordUnit unit = agreed_unit(source, said_by(source, head), unit_by_extension(source.file));
  const Body body = read_body(source, lines, header);
  if (body.values < count)
    refuse(source, line,
           "NPTS is " + std::to_string(count) + " and the file holds " + std::to_string(body.values) +
               " values; fetch it again, it is cut off");
  if (auto values = column_beside_time(source, line, body, header); !values.empty())
    return finished(source, "peer", unit, dt, std::move(values));
  for (std::size_t i = body.end; i < lines.size(); ++i)
    if (find_word(lower(lines[i].text), "npts") != std::string::npos)
      refuse(source, lines[i], "begins another record; give each a file of its own");
  check_padding(source, line, body, count);
  std::vector<double> values;
  for (const auto& row : body.rows) values.insert(values.end(), row.begin(), row.end());
  values.resize(count);
  Record record = finished(source, "peer", unit, dt, std::move(values));
  if (looks_like_columns(body.rows))
    record.warnings.push_back(source.file +
                              ": its lines look like components in columns, and are read as one after "
                              "the other; if they are columns, write one component only");
  if (body.values > count || body.end < lines.size())
    record.notes.push_back(source.file + ": what follows the " + std::to_string(count) +
                           " values of NPTS is passed over");
  return record;
}
} // namespace mpm::records

namespace mpm
{
std::string peer_text(const Record& record)
{
  struct Kind
  {
    std::string_view name, unit;
    double size; ///< of the unit, in SI
  };
  constexpr Kind kinds[] = {
      {"ACCELERATION", "G", standard_gravity}, {"VELOCITY", "CM/S", 0.01}, {"DISPLACEMENT", "CM", 0.01}};
  const Kind& kind = kinds[static_cast<int>(record.quantity)];
  const std::string component = record.component.empty() ? "" : ", component " + record.component;
  std::string text =
      fmt::format("seismpm\n{}{}, in {}\n{} TIME SERIES IN UNITS OF {}\nNPTS= {}, DT= {:.9g} SEC\n",
                  std::filesystem::path(record.source).filename().string(), component, record.unit, kind.name,
                  kind.unit, record.values.size(), record.dt);
  for (std::size_t k = 0; k < record.values.size(); ++k)
    text += fmt::format("{:17.8E}{}", record.values[k] / kind.size,
                        k % 5 == 4 || k + 1 == record.values.size() ? "\n" : "");
  return printable(text);
}
} // namespace mpm
