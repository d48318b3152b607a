#pragma once
// Inside the record reader: what headers and comments say of unit, quantity and time step, and whether case,
// header and file name agree.

#include "io/records/text.hpp"
#include "io/records/units.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mpm::records
{
/// A unit that a line names without saying whose it is.
struct Mention
{
  RecordUnit unit;
  Line line;
};

/// What the words of a header say; line.number 0 where they say nothing.
struct Said
{
  std::optional<RecordUnit> unit;
  std::string unknown; ///< a unit that is stated and not known, as written
  std::optional<Quantity> quantity;
  Line line{{}, 0};
  std::optional<Mention>
      mention; ///< where nothing states the unit, it may not contradict the one that is taken
};

/// The unit that lines of prose state: "ACCELERATION TIME SERIES IN UNITS OF G. FILTER POINTS: ...", "The
/// units are (g)", "Velocity (cm/s)". A line that names the recorded quantity goes before a title that merely
/// holds the word units; instruments and peaks have units of their own. Refuses lines that contradict each
/// other.
Said said_by(const RecordSource& source, const std::vector<Line>& lines);

/// The unit that the name of a column states: "acc (g)", "NS [cm/s2]", "a_g", "gal".
Said said_by_column(const Line& line, std::string_view name);

/// A number with the unit of a time step behind or before it.
struct StatedStep
{
  double seconds;
  bool has_unit;
  std::string unknown; ///< the word behind the number, where it is no unit
};

/// Takes ".01000 SEC", "(ms) = 10", "= 100 Hz" from the front; a bare number is in s, or in Hz if `rate`.
std::optional<StatedStep> take_step(std::string_view text, bool rate = false);

/// A time step that a line states.
struct SaidStep
{
  double seconds;
  bool has_unit;
  std::string unknown; ///< the word behind the number, where it is no unit
  Line line;
};
/// Refuses a step of 1 and more without a unit: 10 is ms, or a count.
void refuse_bare_step(const RecordSource& source, const Line& line, double step);
/// All of "dt = 0.01 s", "sampling rate: 100 Hz", "Sampling interval (ms) 10".
std::vector<SaidStep> steps_said_by(const std::vector<Line>& lines);

/// Unit of a PEER file by its extension; empty if it has another.
std::optional<RecordUnit> unit_by_extension(const std::string& file);
/// The unit to use, once case, header and extension have been found to agree.
RecordUnit agreed_unit(const RecordSource& source, const Said& said,
                       const std::optional<RecordUnit>& by_extension);
/// dt of the file in s, or the case's where that agrees to within `tolerance` (relative).
double agreed_dt(const RecordSource& source, const Line& line, double dt, double tolerance);
/// Refuses if a header line states another dt (0.1 %).
void check_steps(const RecordSource& source, const std::vector<Line>& lines, double dt);
} // namespace mpm::records
