#pragma once
// Inside the record reader: what is recorded and in which unit, as the case, the header and the file's name
// say.

#include "io/record_text.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mpm::records
{
/// A unit that records come in.
struct RecordUnit
{
  std::string_view name;
  Quantity quantity;
  double si; ///< SI value of one
};

/// What the words of a header say; line.number 0 where they say nothing.
struct Said
{
  const RecordUnit* unit = nullptr;
  std::optional<Quantity> quantity;
  Line line{{}, 0};
};

/// "ACCELERATION TIME SERIES IN UNITS OF G. FILTER POINTS: ...", "The units are (g)".
Said said_by_units_line(const std::vector<Line>& header);
/// "time (s), acceleration (m/s2)": the last bracket that holds a unit.
Said said_by_column_header(const Line& line);
/// Unit of a PEER file by its extension; null if it has another.
const RecordUnit* unit_by_extension(const std::string& file);
/// The unit to use, once case, header and extension have been found to agree.
RecordUnit agreed_unit(const RecordSource& source, const Said& said, const RecordUnit* by_extension);
} // namespace mpm::records
