#pragma once
// Inside the record reader: formats of public archives. One file of code a format; all are in one table.

#include "io/records/formats.hpp"

#include <array>
#include <span>

namespace mpm::records
{
/// A file's lines as they are, empty ones too, for formats of fixed columns.
using Lines = std::span<const Line>;

/// A format of an archive.
struct Archive
{
  std::string_view key;   ///< in the case: `format: knet`
  std::string_view title; ///< in messages
  /// Whether a file is of this format; `head` is its beginning in lower case.
  bool (*recognise)(std::string_view head, Lines lines);
  /// Throws Error bad_input where the file is damaged, contradicts itself or holds what is not read.
  Record (*read)(const RecordSource& source, Lines lines);
};

/// All that are read.
std::span<const Archive> archives();
/// The archive whose format a file has; null if it is none's.
const Archive* archive_of(std::string_view text, Lines lines);
/// Refuses, by name, formats that are known but not read.
void refuse_foreign(const RecordSource& source, std::string_view text, Lines lines);

// One pair a format, see Archive.

bool is_knet(std::string_view head, Lines lines);
Record read_knet(const RecordSource& source, Lines lines);
bool is_esm(std::string_view head, Lines lines);
Record read_esm(const RecordSource& source, Lines lines);
bool is_smc(std::string_view head, Lines lines);
Record read_smc(const RecordSource& source, Lines lines);
bool is_cosmos(std::string_view head, Lines lines);
Record read_cosmos(const RecordSource& source, Lines lines);
bool is_csmip(std::string_view head, Lines lines);
Record read_csmip(const RecordSource& source, Lines lines);
bool is_cwb(std::string_view head, Lines lines);
Record read_cwb(const RecordSource& source, Lines lines);
bool is_geonet(std::string_view head, Lines lines);
Record read_geonet(const RecordSource& source, Lines lines);
bool is_bhrc(std::string_view head, Lines lines);
Record read_bhrc(const RecordSource& source, Lines lines);

// What the formats share.

/// What a file says of one component.
struct Channel
{
  std::string component; ///< as the file names it
  RecordUnit unit;
  double dt;                  ///< s
  std::size_t line;           ///< index of the line that says so, for messages
  std::vector<double> values; ///< in `unit`
  std::optional<double> peak; ///< in `unit`, as stated; its sign does not count
  double peak_tolerance = 0;  ///< what rounding in print makes of it, in `unit`
};

/// The record of a channel, once its peak and what the case says of it agree with it.
Record record_of(const RecordSource& source, Lines lines, std::string_view format, Channel channel);
/// The index of the component asked for among those of a file, or of its only one.
std::size_t chosen_component(const RecordSource& source, const std::vector<std::string>& components);

/// The number behind the first `key` of a line (any case): "DURATION =  49.920"; empty if there is none.
std::optional<double> number_behind(std::string_view line, std::string_view key);
/// The number behind the first `key` with the unit behind it, in SI: "Max  =   .079 g , at"; empty if either
/// is missing.
std::optional<double> quantity_behind(std::string_view line, std::string_view key);
/// The same of a whole number above zero; refuses anything else.
std::size_t count_behind(const RecordSource& source, const Line& line, std::string_view key);
/// Text behind the first `key` of a line (any case); empty if there is none.
std::string_view text_behind(std::string_view line, std::string_view key);
/// Numbers in columns of `width` characters, as Fortran writes them, on lines of `per_line`, from line `at`;
/// moves `at` behind them. Refuses damaged and missing ones; empty fields are none.
std::vector<double> fixed_numbers(const RecordSource& source, Lines lines, std::size_t& at, std::size_t count,
                                  std::size_t width, std::size_t per_line);
/// Refuses a line of numbers behind the last of those that a header counts.
void check_end(const RecordSource& source, Lines lines, std::size_t at);
/// "(8F10.5)", "(1E15.6)": numbers a line and their width; empty if the text holds no such format.
struct FortranFormat
{
  std::size_t per_line, width;
};
std::optional<FortranFormat> fortran_format(std::string_view text);
} // namespace mpm::records
