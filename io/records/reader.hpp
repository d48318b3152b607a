#pragma once
// Reads acceleration, velocity and displacement records as archives and spreadsheets write them.

#include "boundaries/ground_motion/ground_motion.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace mpm
{
/// A record as a case names it. What the file says itself may be left out; what both say has to agree.
struct RecordSource
{
  std::string file;
  /// One of record_formats(): auto, peer (a header line with NPTS and DT), column (one value a line),
  /// two_column (time, value) or an archive's.
  std::string format = "auto";
  double dt = NAN;                  ///< s; NaN: from the file
  std::string unit;                 ///< g, gal, m/s2, cm/s, ... (records::parse_unit); empty: from the file
  std::optional<Quantity> quantity; ///< empty: that of the unit
  std::string origin;               ///< where the record can be had, told when the file is missing
  std::string component;            ///< of a file that holds several; empty: its only one
};

/// What a record's format can be called, auto first.
std::vector<std::string> record_formats();
/// Whether records may come in this unit, as "cm/s2", "G/10" or "in/sec".
bool is_record_unit(std::string_view text);

/// Reads source.file. Throws Error: input_missing where the file cannot be read, bad_input where it is no
/// record.
Record read_record(const RecordSource& source);

/// Reads a record from text, e.g. one kept in a result file; source.file serves the messages and, by its
/// extension (.AT2, .VT2, .DT2), the quantity of a PEER record.
Record parse_record(std::string_view text, const RecordSource& source);

/// A record as a file in PEER's format, for programs that read no other: what it is of, then its values in g,
/// cm/s or cm, to 9 digits.
std::string peer_text(const Record& record);
} // namespace mpm
