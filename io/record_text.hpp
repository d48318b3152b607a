#pragma once
// Inside the record reader: lines of text and the numbers on them.

#include "io/record_reader.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mpm::records
{
/// A line of a record that is not empty.
struct Line
{
  std::string_view text; ///< without blanks at its ends
  int number;
};

std::string lower(std::string_view text);
bool is_blank(char c);
bool is_digit(char c);
bool is_letter(char c);

/// Throw Error bad_input, of the file or of a line of it.
[[noreturn]] void refuse(const RecordSource& source, const std::string& what);
[[noreturn]] void refuse(const RecordSource& source, const Line& line, const std::string& what);
/// Text and numbers as messages show them.
std::string quoted(std::string_view text);
std::string number(double value);

/// Non-empty lines, ended by LF, CR LF or CR.
std::vector<Line> lines_of(std::string_view text);
/// Takes one number off the front: leading +, no leading 0, D exponents. Empty if there is none, or if it
/// runs into something other than a blank, a separator, a bracket or the sign of the next number.
std::optional<double> take_number(std::string_view& text);
void skip_separator(std::string_view& text);
/// All numbers of a line; empty if anything in it is not a number.
std::optional<std::vector<double>> numbers_in(std::string_view text);
/// The same; refuses anything else.
std::vector<double> numbers_at(const RecordSource& source, const Line& line);
} // namespace mpm::records
