// Lines and numbers as people, Fortran and spreadsheets write them. A number is taken whole or not at all:
// one that runs into anything else ("1.2.3", "0,5", "12:30") is damage or another thing, and has to be seen.

#include "io/records/text.hpp"

#include "io/common/error.hpp"
#include "io/common/printable.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>

namespace mpm::records
{
std::string lower(std::string_view text)
{
  std::string out(text);
  std::ranges::transform(out, out.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return out;
}

bool is_blank(char c)
{
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
bool is_digit(char c)
{
  return c >= '0' && c <= '9';
}
bool is_letter(char c)
{
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

std::string_view trimmed(std::string_view text)
{
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view bracket(std::string_view text)
{
  if (text.empty() || (text[0] != '(' && text[0] != '[')) return {};
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (text[i] == '(' || text[i] == '[') ++depth;
    if ((text[i] == ')' || text[i] == ']') && --depth == 0) return text.substr(1, i - 1);
  }
  return text.substr(1);
}

std::size_t find_word(std::string_view text, std::string_view word, std::size_t from)
{
  for (std::size_t at = from; (at = text.find(word, at)) != text.npos; ++at)
  {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]))) return at;
  }
  return text.npos;
}

void refuse(const RecordSource& source, const std::string& what)
{
  throw Error(exit_code::bad_input, printable(source.file + ": " + what, "\t"));
}

void refuse(const RecordSource& source, const Line& line, const std::string& what)
{
  throw Error(exit_code::bad_input,
              printable(source.file + ":" + std::to_string(line.number) + ": " + what, "\t"));
}

std::string shown(std::string_view text)
{
  return "'" + std::string(text.substr(0, 60)) + (text.size() > 60 ? "...'" : "'");
}

std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::vector<Line> whole_lines_of(std::string_view text)
{
  // The mark with which Windows begins UTF-8.
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number)
  {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    lines.push_back({text.substr(0, end), number});
    text.remove_prefix(std::min(text.size(), end + (text.substr(end).starts_with("\r\n") ? 2 : 1)));
  }
  return lines;
}

std::vector<Line> lines_of(std::string_view text)
{
  std::vector<Line> lines;
  for (Line line : whole_lines_of(text))
  {
    while (!line.text.empty() && is_blank(line.text.front())) line.text.remove_prefix(1);
    while (!line.text.empty() && is_blank(line.text.back())) line.text.remove_suffix(1);
    if (!line.text.empty()) lines.push_back(line);
  }
  return lines;
}

namespace
{
/// Fortran leaves out the E of exponents of three digits: "1.234-103", and reads it left out of any.
bool is_bare_exponent(std::string_view text)
{
  if (text.empty() || (text[0] != '+' && text[0] != '-')) return false;
  const std::size_t end = std::min(text.find_first_not_of("0123456789", 1), text.size());
  if (end < 2 || end > 4) return false;
  return end == text.size() || is_blank(text[end]) ||
         std::string_view("+-,;)").find(text[end]) != std::string_view::npos;
}

/// Whether a number may end before this text: at a blank, a separator, a bracket, or the sign of a number
/// with a decimal point. Whole numbers that touch are dates and times.
bool is_border(std::string_view text)
{
  if (text.empty() || is_blank(text[0]) || std::string_view(",;)").find(text[0]) != std::string_view::npos)
    return true;
  if (text[0] != '+' && text[0] != '-') return false;
  const std::size_t point = text.find_first_not_of("0123456789", 1);
  return point != std::string_view::npos && text[point] == '.';
}
} // namespace

// By hand, since neither strtod nor from_chars reads what Fortran writes: ".5", "5.", "1.0D-3", "1.234-103".
std::optional<double> take_number(std::string_view& text)
{
  std::size_t end = text.starts_with('+') || text.starts_with('-') ? 1 : 0;
  const auto digits = [&]
  {
    const std::size_t start = end;
    while (end < text.size() && is_digit(text[end])) ++end;
    return end - start;
  };
  std::size_t mantissa = digits();
  const bool point = end < text.size() && text[end] == '.';
  if (point) mantissa += (++end, digits());
  if (mantissa == 0) return {};
  std::string token(text.substr(0, end));
  const bool letter =
      end < text.size() && std::string_view("eEdDqQ").find(text[end]) != std::string_view::npos;
  if (letter || (point && is_bare_exponent(text.substr(end))))
  {
    const std::size_t start = end += letter;
    if (end < text.size() && (text[end] == '+' || text[end] == '-')) ++end;
    if (digits() == 0) return {};
    token += 'e';
    token += text.substr(start + (text[start] == '+'), end - start - (text[start] == '+'));
  }
  if (!is_border(text.substr(end))) return {};
  const char* first = token.data() + (token.front() == '+' ? 1 : 0);
  const char* const last = token.data() + token.size();
  double value = 0;
  const auto [stop, status] = std::from_chars(first, last, value);
  // "1e-400" is 0 for every purpose here.
  const bool underflow = status == std::errc::result_out_of_range && token.find("e-") != std::string::npos;
  if (stop != last || (status != std::errc{} && !underflow)) return {};
  text.remove_prefix(end);
  return underflow ? 0. : value;
}

void skip_separator(std::string_view& text)
{
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  if (!text.empty() && (text.front() == ',' || text.front() == ';')) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
}

// "1, 2 3": separators of two kinds on one line are a sign of decimal commas, "0,5 1".
std::optional<std::vector<double>> numbers_in(std::string_view text)
{
  std::vector<double> values;
  std::optional<char> separator;
  while (!text.empty())
  {
    const auto value = take_number(text);
    if (!value) return {};
    values.push_back(*value);
    const std::size_t next = std::min(text.find_first_not_of(" \t\v\f"), text.size());
    const bool is_mark = next < text.size() && (text[next] == ',' || text[next] == ';');
    const char found = is_mark ? text[next] : ' ';
    skip_separator(text);
    if (!text.empty() && separator && *separator != found) return {};
    separator = found;
  }
  return values;
}

std::vector<double> numbers_at(const RecordSource& source, const Line& line)
{
  if (has_decimal_commas(line.text))
    refuse(source, line,
           shown(line.text) + " has decimal commas, or separators of two kinds; write decimal points");
  if (auto values = numbers_in(line.text)) return std::move(*values);
  refuse(source, line, "expected numbers and found " + shown(line.text) + "; mend or remove the line");
}

// It is no line of numbers as it stands, and is one with points in place of its commas.
bool has_decimal_commas(std::string_view text)
{
  if (text.find(',') == std::string_view::npos || numbers_in(text)) return false;
  std::string with_points(text);
  std::ranges::replace(with_points, ',', '.');
  return numbers_in(with_points).has_value();
}

bool is_whole(std::string_view token)
{
  return !token.empty() && token.find_first_not_of("+-0123456789 \t") == std::string_view::npos;
}

namespace
{
/// A name begins with a letter, is no damaged number ("l.23", "O.5", "e-05") and no missing value.
bool is_name(std::string_view cell)
{
  const std::string text = lower(cell.substr(0, cell.find_first_of("([")));
  if (text.empty() || !is_letter(text[0])) return false;
  for (std::string_view missing : {"nan", "inf", "infinity", "null", "none", "na", "n/a", "err", "error"})
    if (text == missing) return false;
  const auto digits = std::ranges::count_if(text, is_digit), letters = std::ranges::count_if(text, is_letter);
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if ((text[i] == '.' && is_digit(text[i + 1])) || (is_digit(text[i]) && text[i + 1] == '.')) return false;
  return digits == 0 || digits < letters;
}
} // namespace

std::vector<std::string_view> cells_of(std::string_view text, std::string_view separators)
{
  std::vector<std::string_view> cells;
  const auto add = [&](std::string_view cell)
  {
    while (!cell.empty() && is_blank(cell.front())) cell.remove_prefix(1);
    while (!cell.empty() && is_blank(cell.back())) cell.remove_suffix(1);
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    cells.push_back(cell);
  };
  std::size_t begin = 0;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    depth += (text[i] == '(' || text[i] == '[') - (text[i] == ')' || text[i] == ']');
    if (depth > 0 || separators.find(text[i]) == std::string_view::npos) continue;
    add(text.substr(begin, i - begin));
    begin = i + 1;
  }
  add(text.substr(begin));
  return cells;
}

std::vector<std::string_view> names_in(std::string_view text, std::size_t columns)
{
  // A separator that gives as many names as there are columns; blanks last, because names have blanks in
  // them.
  for (std::string_view separators : {",", ";", "\t"})
  {
    std::vector<std::string_view> cells = cells_of(text, separators);
    while (cells.size() > columns && cells.back().empty()) cells.pop_back();
    if (cells.size() == columns && std::ranges::all_of(cells, is_name)) return cells;
  }
  std::vector<std::string_view> cells; // by blanks; a bracket belongs to the word before it
  for (std::string_view cell : cells_of(text, " \t"))
  {
    if (cell.empty()) continue;
    const bool is_bracket = cell.front() == '(' || cell.front() == '[';
    if (is_bracket && !cells.empty())
      cells.back() = {cells.back().data(), std::size_t(cell.data() + cell.size() - cells.back().data())};
    else
      cells.push_back(cell);
  }
  const bool names = std::ranges::all_of(cells, is_name);
  if (names && (cells.size() == columns || columns == 1)) return columns == 1 ? std::vector{text} : cells;
  return {};
}
} // namespace mpm::records
