#include "io/record_text.hpp"

#include "io/error.hpp"

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

void refuse(const RecordSource& source, const std::string& what)
{
  throw Error(exit_code::bad_input, source.file + ": " + what);
}

void refuse(const RecordSource& source, const Line& line, const std::string& what)
{
  throw Error(exit_code::bad_input, source.file + ":" + std::to_string(line.number) + ": " + what);
}

std::string quoted(std::string_view text)
{
  return "'" + std::string(text.substr(0, 60)) + (text.size() > 60 ? "...'" : "'");
}

std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::vector<Line> lines_of(std::string_view text)
{
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number)
  {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(text.size(), end + (text.substr(end).starts_with("\r\n") ? 2 : 1)));
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
    if (!line.empty()) lines.push_back({line, number});
  }
  return lines;
}

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
  if (end < text.size() && text[end] == '.') mantissa += (++end, digits());
  if (mantissa == 0) return {};
  std::string token(text.substr(0, end));
  if (end < text.size() && std::string_view("eEdD").find(text[end]) != std::string_view::npos)
  {
    const std::size_t start = ++end;
    if (end < text.size() && (text[end] == '+' || text[end] == '-')) ++end;
    if (digits() == 0) return {};
    token += 'e';
    token += text.substr(start, end - start);
  }
  if (end < text.size() && !is_blank(text[end]) &&
      std::string_view("+-,;)").find(text[end]) == std::string_view::npos)
    return {};
  const char* first = token.data() + (token.front() == '+' ? 1 : 0);
  const char* const last = token.data() + token.size();
  double value = 0;
  const auto [stop, status] = std::from_chars(first, last, value);
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

std::optional<std::vector<double>> numbers_in(std::string_view text)
{
  std::vector<double> values;
  while (!text.empty())
  {
    const auto value = take_number(text);
    if (!value) return {};
    values.push_back(*value);
    skip_separator(text);
  }
  return values;
}

std::vector<double> numbers_at(const RecordSource& source, const Line& line)
{
  if (auto values = numbers_in(line.text)) return std::move(*values);
  refuse(source, line, "expected numbers and found " + quoted(line.text) + "; mend or remove the line");
}
} // namespace mpm::records
