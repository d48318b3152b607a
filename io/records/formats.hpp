#pragma once
// Inside the record reader: what its formats have in common.

#include "io/records/statements.hpp"

#include <array>
#include <span>

namespace mpm::records
{
/// A record in SI of values in `unit`. Refuses fewer than two.
Record finished(const RecordSource& source, std::string format, const RecordUnit& unit, double dt,
                std::vector<double> values);
/// Refuses a component asked for of a file that does not name its own.
void refuse_component(const RecordSource& source);

/// A PEER header.
struct PeerHeader
{
  std::size_t line;  ///< index of the line with NPTS and DT
  std::size_t count; ///< NPTS
  double dt;         ///< s
};
/// "NPTS=  4000, DT= .01000 SEC" or "4164    0.0100    NPTS, DT", among the first lines; empty if there is no
/// such word.
std::optional<PeerHeader> peer_header(const RecordSource& source, const std::vector<Line>& lines);
/// The values that a PEER header announces; what follows them has to be padding.
Record read_peer(const RecordSource& source, const std::vector<Line>& lines, const PeerHeader& header);

/// One column of values, or time and columns of values, below at most one heading. Comments begin with # or
/// %.
Record read_table(const RecordSource& source, const std::vector<Line>& lines);

/// Rows of values one after the other below lines of text, as SHAKE's input motions; dt and unit as the case
/// says.
Record read_rows(const RecordSource& source, const std::vector<Line>& lines);
} // namespace mpm::records
