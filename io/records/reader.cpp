#include "io/records/reader.hpp"

#include "io/common/error.hpp"
#include "io/common/input_file.hpp"
#include "io/records/archives.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace mpm
{
using namespace records;

namespace records
{
Record finished(const RecordSource& source, std::string format, const RecordUnit& unit, double dt,
                std::vector<double> values)
{
  if (values.size() < 2) refuse(source, "holds " + std::to_string(values.size()) + " values; not a record");
  for (double& value : values)
    if (!std::isfinite(value *= unit.si))
      refuse(source, "holds a value that is beyond the numbers of the machine in SI; mend it or the unit");
  Record record{source.file, std::move(format), unit.name, dt, unit.quantity, std::move(values), {}};
  if (dt > 0.2 || dt < 5e-4)
    record.warnings.push_back(source.file + ": its time step is " + number(dt) + " s, which carries up to " +
                              number(0.5 / dt) + " Hz; is it right?");
  return record;
}

void refuse_component(const RecordSource& source)
{
  if (!source.component.empty())
    refuse(source, "names no components, and '" + source.component + "' is asked for; leave component out");
}
} // namespace records

namespace
{
constexpr std::ptrdiff_t most_lines = 20'000'000; // a hundred bytes of memory each

/// Digits behind the point, and of the exponent.
std::pair<int, int> digits_of(std::string_view token)
{
  const std::size_t exponent = std::min(token.find_first_of("eEdD"), token.size());
  const std::size_t point = std::min(token.find('.'), exponent);
  const auto digits = [](std::string_view part) { return int(std::ranges::count_if(part, is_digit)); };
  return {digits(token.substr(point, exponent - point)), digits(token.substr(exponent))};
}

/// A file that ends without a line end, with a number that has fewer digits behind the point, or in its
/// exponent, than all before it, has been cut off within it.
void check_last_number(const RecordSource& source, std::string_view text, const std::vector<Line>& lines)
{
  if (!is_digit(text.back()) && text.back() != '.') return;
  int point = 100, exponent = 100;
  const auto tokens_of = [](std::string_view line) { return cells_of(line, " \t,;"); };
  const auto compare = [&](std::string_view token)
  {
    if (token.empty()) return;
    const auto [behind_point, of_exponent] = digits_of(token);
    point = std::min(point, behind_point);
    exponent = std::min(exponent, of_exponent);
  };
  const auto last = tokens_of(lines.back().text);
  bool is_first = true; // perhaps a count
  for (const Line& line : lines)
    if (line.number < lines.back().number && numbers_in(line.text) && !std::exchange(is_first, false))
      compare(tokens_of(line.text).back());
  const auto [behind_point, of_exponent] = digits_of(last.back());
  if (point < 100 && (behind_point < point || of_exponent < exponent))
    refuse(source, lines.back(),
           "ends within a number, " + shown(last.back()) +
               "; fetch it again, it is cut off, or end its last line");
}
} // namespace

std::vector<std::string> record_formats()
{
  std::vector<std::string> formats{"auto", "peer", "column", "two_column", "shake"};
  for (const Archive& archive : archives()) formats.emplace_back(archive.key);
  return formats;
}

bool is_record_unit(std::string_view text)
{
  return parse_unit(text).has_value();
}

Record parse_record(std::string_view text, const RecordSource& source)
{
  const std::vector<std::string> formats = record_formats();
  if (std::ranges::find(formats, source.format) == formats.end())
  {
    std::string all;
    for (const std::string& format : formats) all += (all.empty() ? "" : ", ") + format;
    refuse(source, "unknown format '" + source.format + "'; use one of " + all);
  }
  if (!std::isnan(source.dt) && !(source.dt > 0 && std::isfinite(source.dt)))
    refuse(source, "dt is " + number(source.dt) + " s; give a positive one");
  if (std::ranges::count_if(text, [](char c) { return c == '\n' || c == '\r'; }) > most_lines)
    refuse(source,
           "has more than " + std::to_string(most_lines / 1'000'000) + " million lines; cut or resample it");
  const std::vector<Line> lines = lines_of(text), whole = whole_lines_of(text);
  if (lines.empty()) refuse(source, "is empty; fetch it again");
  // Before anything else: a file that was cut off may still be a good record of another length.
  check_last_number(source, text, lines);
  // A format that the case names has to be the one the file shows.
  const bool archived = std::ranges::find(archives(), source.format, &Archive::key) != archives().end();
  const auto header = archived ? std::nullopt : peer_header(source, lines);
  if (header)
  {
    if (source.format == "auto" || source.format == "peer") return read_peer(source, lines, *header);
    refuse(source, lines[header->line],
           "a header with NPTS and DT in what the case calls " + source.format + "; use format: peer");
  }
  // Named by the case, or never: rows of values are what a damaged file of any other format looks like.
  if (source.format == "shake") return read_rows(source, lines);
  if (const Archive* archive = archive_of(text, whole))
  {
    if (source.format == "auto" || source.format == archive->key) return archive->read(source, whole);
    refuse(source,
           "looks like " + std::string(archive->title) + "; use format: " + std::string(archive->key));
  }
  // After all that are read: a mark of another archive may stand in anybody's title.
  refuse_foreign(source, text, whole);
  if (archived)
    refuse(source, "is not of the format " + source.format + " that the case names; use format: auto");
  if (source.format == "peer")
    refuse(source, "no header line with NPTS and DT; use format: column or two_column");
  return read_table(source, lines);
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
