// Tables of spreadsheets and scripts. They are nobody's format, so that the names of the columns, the
// comments and the times themselves have to tell what a number is. What none of them tells, the case does.

#include "io/records/first_line.hpp"
#include "io/records/formats.hpp"

#include <algorithm>

namespace mpm::records
{
namespace
{
/// Rows of equally many numbers, and what stands above and between them.
struct Table
{
  std::vector<std::vector<double>> rows;
  std::vector<Line> lines;    ///< of the rows
  std::vector<Line> comments; ///< without their marks
  std::optional<Line> heading;
  std::vector<std::string_view> names; ///< of the columns; empty where nothing names them
  std::vector<std::string> notes;

  std::size_t columns() const { return rows.front().size(); }
  const Line& named_at() const { return heading ? *heading : lines.front(); }
};

/// Columns that the case's format has; empty where it leaves it open.
std::optional<std::size_t> expected_columns(const RecordSource& source)
{
  if (source.format == "column") return 1;
  if (source.format == "two_column" && source.component.empty()) return 2;
  return {};
}

void add_row(const RecordSource& source, Table& table, const Line& line, std::optional<std::size_t> expected)
{
  // The first row says how many numbers a row has: one that differs is damage.
  std::vector<double> values = numbers_at(source, line);
  const std::size_t columns = expected ? *expected : table.rows.empty() ? values.size() : table.columns();
  if (values.size() != columns)
    refuse(source, line,
           "expected " + std::to_string(columns) + (columns == 1 ? " number" : " numbers") + " and found " +
               std::to_string(values.size()) + " in " + shown(line.text) +
               (columns < 4 ? "; numbers take a decimal point, not a comma"
                            : "; if these are rows of values one after the other, name format: shake"));
  table.rows.push_back(std::move(values));
  table.lines.push_back(line);
}

Table table_of(const RecordSource& source, const std::vector<Line>& lines, FirstLine& first)
{
  Table table;
  std::vector<Line> data;
  for (Line line : lines)
  {
    if (line.text.front() != '#' && line.text.front() != '%')
    {
      data.push_back(line);
      continue;
    }
    line.text.remove_prefix(std::min(line.text.find_first_not_of("#% \t"), line.text.size()));
    table.comments.push_back(line);
  }
  // The first line of numbers parts what stands above from the table.
  const auto numbers =
      std::ranges::find_if(data, [](const Line& l) { return numbers_in(l.text).has_value(); });
  for (const Line& line : data)
    if (numbers == data.end() && has_decimal_commas(line.text))
      numbers_at(source, line); // refuses them by name
  if (numbers == data.end()) refuse(source, "no line of numbers; not a record");
  const auto expected = expected_columns(source);
  const std::size_t columns = numbers_in(numbers->text)->size();
  // One line above the numbers may be the heading; with more, comments have to say what the columns are.
  if (numbers == data.begin() + 1)
    if (table.names = names_in(data.front().text, columns); !table.names.empty())
    {
      table.heading = data.front();
      data.erase(data.begin());
    }
  first = first_line(source, data);
  if (first.count > 0)
  {
    table.notes.push_back(source.file + ": its first line is the number of values" +
                          (std::isnan(first.dt) ? "" : " and the time step"));
    data.erase(data.begin());
  }
  refuse_step_as_value(source, data);
  for (const Line& line : data) add_row(source, table, line, expected);
  if (table.rows.size() < 2)
    refuse(source, "holds " + std::to_string(table.rows.size()) + " values; not a record");
  return table;
}

/// Whether a column's name is one of time.
bool names_time(std::string_view name)
{
  const std::string text = lower(name);
  if (find_word(text, "t") == 0 || parse_step_unit(name)) return true;
  return text.starts_with("time") || text.starts_with("tiempo") || text.starts_with("temp") ||
         text.starts_with("zeit");
}

/// A comment names the columns where it has as many names as there are, the first of them of time; or, just
/// above the numbers, the second with a unit.
void take_names_from_comments(Table& table)
{
  const int first = table.lines.front().number;
  for (const Line& comment : table.comments)
  {
    if (!table.names.empty() || comment.number > first) return;
    const auto names = names_in(comment.text, table.columns());
    if (table.columns() < 2 || names.empty()) continue;
    const bool above = comment.number == first - 1 &&
                       comment.text.find_first_of(",;\t") != std::string_view::npos &&
                       said_by_column(comment, names[1]).unit;
    if (!names_time(names[0]) && !above) continue;
    table.names = names;
    table.heading = comment;
  }
}

/// The unit of a column's name and of the comments, which have to agree.
Said said_of_column(const RecordSource& source, const Table& table, std::size_t column)
{
  Said said = said_by(source, table.comments);
  if (table.names.empty()) return said;
  const Said own = said_by_column(*table.heading, table.names[column]);
  if (own.unit && said.unit && !(*own.unit == *said.unit))
    refuse(source, said.line,
           "states the unit " + said.unit->name + ", and line " + std::to_string(own.line.number) + " " +
               own.unit->name + "; mend the header");
  if (own.unit || !own.unknown.empty() || !said.unit)
    return own.unit || own.quantity || !own.unknown.empty() ? own : said;
  if (own.quantity) said.quantity = own.quantity;
  return said;
}

/// Unit of the time column by its name: "time (ms)", "sec"; empty where nothing says it.
std::optional<StepUnit> time_unit(const RecordSource& source, const Table& table)
{
  if (table.names.empty()) return {};
  const std::string_view name = table.names[0];
  if (const auto unit = parse_step_unit(name)) return unit;
  const std::size_t open = name.find_first_of("([");
  std::string_view inside = open == name.npos ? "" : name.substr(open + 1);
  inside = inside.substr(0, inside.find_first_of(")]"));
  // "t_ms", "time in ms", "time, ms"
  for (std::string_view joint : {"_", " in ", ","})
    if (const std::size_t at = name.rfind(joint); inside.empty() && at != name.npos)
      inside = name.substr(at + joint.size());
  const auto unit = parse_step_unit(inside);
  if (!inside.empty() && (!unit || unit->rate))
    refuse(source, *table.heading,
           "states the unit of time as " + shown(inside) +
               ", which is not known; write time (s) or time (ms)");
  if (!unit && !names_time(name))
    refuse(source, *table.heading,
           "calls the first column " + shown(name) +
               ", and it has to be time; write time (s), or one column and dt");
  return unit;
}

/// Step of evenly spaced times, in their own unit. Printed times are rounded, so each may be off by a tenth
/// of it.
double even_step(const RecordSource& source, const Table& table)
{
  // The median step is right even where some are not, and the first that differs from it can be named.
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
                 " s; resample the record evenly (first column: time in s, with decimal points)");
  // From the whole length, which rounding in print changes least.
  const double dt = (rows.back()[0] - rows.front()[0]) / double(steps.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::abs(rows[i][0] - rows[0][0] - dt * double(i)) > 0.1 * dt)
      refuse(source, table.lines[i],
             "time " + number(rows[i][0]) + " s is off an even step of " + number(dt) +
                 " s; resample the record evenly");
  return dt;
}

/// dt of the time column in s.
double step_of(const RecordSource& source, const Table& table)
{
  const auto unit = time_unit(source, table);
  const double step = even_step(source, table);
  // Whole numbers that step by one are an index or samples, hardly seconds: strong motion at 1 Hz is none.
  if (!unit && step > 0.99 &&
      std::ranges::all_of(table.rows, [](const auto& row) { return row[0] == std::floor(row[0]); }))
    refuse(source, table.lines.front(),
           "the first column counts " + number(table.rows[0][0]) + ", " + number(table.rows[1][0]) +
               ", ...; if that is time, name its unit in a heading as 'time (ms), acceleration (g)', if an "
               "index, leave the column out and give dt");
  return unit ? unit->seconds(step) : step;
}

/// The column of the component asked for, or the only one.
std::size_t column_of(const RecordSource& source, const Table& table)
{
  const std::size_t columns = table.columns();
  if (source.component.empty() && columns == 2) return 1;
  if (table.names.empty() && columns == 2) refuse_component(source);
  if (table.names.empty())
    refuse(source, table.lines.front(),
           std::to_string(columns) +
               " numbers a line and nothing that names them: not a format that is read; "
               "write two columns, time in s and acceleration, or name format: shake if it is rows of "
               "values one after the other");
  std::string all;
  std::size_t found = 0, matches = 0;
  // The first column is the time.
  for (std::size_t column = 1; column < columns; ++column)
  {
    all += (all.empty() ? "" : ", ") + std::string(table.names[column]);
    const std::string name = lower(table.names[column]);
    if (name != lower(source.component) && find_word(name, lower(source.component)) == name.npos) continue;
    found = column;
    ++matches;
  }
  if (source.component.empty() || matches != 1)
    refuse(source, *table.heading,
           "its components are " + all + "; give one of them as component" +
               (source.component.empty() ? "" : ", '" + source.component + "' is not one"));
  return found;
}

Record read_columns(const RecordSource& source, Table& table, const FirstLine& first)
{
  const std::size_t column = column_of(source, table);
  const double own = step_of(source, table), dt = agreed_dt(source, table.lines.front(), own, 1e-3);
  check_steps(source, table.comments, own);
  if (!std::isnan(first.dt) && !(std::abs(first.dt - own) <= 1e-3 * own))
    refuse(source, table.lines.front(),
           "the first line says a time step of " + number(first.dt) + " s and the times step by " +
               number(own) + " s; mend the first line");
  std::vector<double> values;
  for (const auto& row : table.rows) values.push_back(row[column]);
  Record record = finished(source, "two_column",
                           agreed_unit(source, said_of_column(source, table, column), {}), dt, values);
  if (!table.names.empty()) record.component = table.names[column];
  if (const double start = table.rows[0][0] * own / even_step(source, table); std::abs(start) > 0.5 * dt)
    record.notes.push_back(source.file + ": its time begins at " + number(start) + " s, which becomes t = 0");
  return record;
}

Record read_column(const RecordSource& source, const Table& table, const FirstLine& first)
{
  refuse_component(source);
  double dt = source.dt;
  if (!std::isnan(first.dt)) dt = agreed_dt(source, table.lines.front(), first.dt, 1e-6);
  for (const SaidStep& step : steps_said_by(table.comments))
  {
    if (std::isnan(dt) && !step.unknown.empty())
      refuse(source, step.line,
             "states its time step with " + shown(step.unknown) + ", which is no unit; write s, ms or Hz");
    if (!step.has_unit) refuse_bare_step(source, step.line, step.seconds);
    if (std::isnan(dt)) dt = step.seconds;
    if (!(std::abs(step.seconds - dt) <= 1e-6 * dt))
      refuse(source, step.line,
             "states a time step of " + number(step.seconds) + " s, and the case or another line " +
                 number(dt) + " s; correct either");
  }
  if (std::isnan(dt))
    refuse(source, "a single column does not hold its time step; give dt, e.g. dt: 0.005 s");
  std::vector<double> values;
  for (const auto& row : table.rows) values.push_back(row[0]);
  return finished(source, "column", agreed_unit(source, said_of_column(source, table, 0), {}), dt,
                  std::move(values));
}
} // namespace

Record read_table(const RecordSource& source, const std::vector<Line>& lines)
{
  FirstLine first;
  Table table = table_of(source, lines, first);
  take_names_from_comments(table);
  Record record =
      table.columns() == 1 ? read_column(source, table, first) : read_columns(source, table, first);
  record.notes.insert(record.notes.end(), table.notes.begin(), table.notes.end());
  return record;
}
} // namespace mpm::records
