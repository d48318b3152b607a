#pragma once
// Inside the record reader: the first line of a table, which may tell what follows instead of being a value.

#include "io/records/statements.hpp"

namespace mpm::records
{
/// "400 0.01" or "400": a first line of number of values and time step, as many programs that take records
/// write it. Its numbers count what follows, and are written as counts where the others are not.
struct FirstLine
{
  std::size_t count = 0; ///< 0: an ordinary line
  double dt = NAN;       ///< s
};

/// What the first of the lines with numbers is. Refuses one that looks like a count and is none: read as a
/// value it would be a spike at the beginning of the motion.
FirstLine first_line(const RecordSource& source, const std::vector<Line>& data);

/// Refuses a first value that is the time step the case gives, and is written otherwise than the second.
void refuse_step_as_value(const RecordSource& source, const std::vector<Line>& data);
} // namespace mpm::records
