#pragma once
// Inside the record reader: lines of text and the numbers on them.

#include "io/records/reader.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mpm::records
{
/// A line of a record.
struct Line
{
  std::string_view text; ///< a part of the record's text, which has to outlive it
  int number;            ///< in the file, from 1
};

// In ASCII, whatever the locale: headers are compared in lower case.

std::string lower(std::string_view text);
/// Blanks and tabs; line ends never occur within a line.
bool is_blank(char c);
bool is_digit(char c);
bool is_letter(char c);

/// Text without blanks at its ends.
std::string_view trimmed(std::string_view text);
/// What is in the bracket at the front; empty if there is none.
std::string_view bracket(std::string_view text);
/// Position of a whole word in lower case text, npos if there is none.
std::size_t find_word(std::string_view text, std::string_view word, std::size_t from = 0);

/// Throw Error bad_input, of the file or of a line of it.
[[noreturn]] void refuse(const RecordSource& source, const std::string& what);
[[noreturn]] void refuse(const RecordSource& source, const Line& line, const std::string& what);
/// Text and numbers as messages show them.
std::string shown(std::string_view text);
std::string number(double value);

/// Lines that are not empty, without blanks at their ends; they end with LF, CR LF or CR.
std::vector<Line> lines_of(std::string_view text);
/// All lines with their blanks.
std::vector<Line> whole_lines_of(std::string_view text);
/// Takes one number off the front: leading +, no leading 0, D exponents, Fortran's exponents without E. Empty
/// if there is none, or if it runs into something other than a blank, a separator, a bracket or the sign of
/// the next number.
std::optional<double> take_number(std::string_view& text);
/// Takes blanks and at most one comma or semicolon off the front.
void skip_separator(std::string_view& text);
/// All numbers of a line, between separators of one kind; empty if anything in it is not a number.
std::optional<std::vector<double>> numbers_in(std::string_view text);
/// The same; refuses anything else.
std::vector<double> numbers_at(const RecordSource& source, const Line& line);
/// No numbers with the commas as separators, but with commas as decimal points: "0,01; 0,5".
bool has_decimal_commas(std::string_view text);
/// A whole number, as a count is written.
bool is_whole(std::string_view token);
/// What is between separators outside brackets, without blanks and quotes around it.
std::vector<std::string_view> cells_of(std::string_view text, std::string_view separators);
/// The names of columns in a heading; empty where a line is none, as one that holds a damaged number.
std::vector<std::string_view> names_in(std::string_view text, std::size_t columns);
} // namespace mpm::records
