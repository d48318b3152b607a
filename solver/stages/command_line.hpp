#pragma once
// The command line of both programs.

#include "io/run_folder/log.hpp"

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mpm
{
/// What the command line asks for.
struct Options
{
  std::string program; ///< mpm-static or mpm-seismic
  std::string command; ///< as it was typed
  std::filesystem::path case_file, out, from;
  std::string motion, vertical; ///< records that replace the case's
  double record_dt = NAN;       ///< s, of a record on the command line that does not tell it
  std::string record_unit;      ///< likewise
  std::string record_format;    ///< of such records; empty: found out
  std::string record_component, vertical_component; ///< of files on the command line that hold several
  double scale = 1;
  std::string profile; ///< one of the case's profiles; empty: none
  std::vector<std::string> overrides;
  int threads = 0;     ///< 0: as many as the machine has
  double max_wall = 0; ///< s, 0: no limit
  bool check = false, print_case = false, fresh = false;
  Verbosity verbosity = Verbosity::normal;

  bool seismic() const { return program == "mpm-seismic"; }
  /// The name of the program's stage in logs and results.
  const char* stage() const { return seismic() ? "seismic" : "static"; }
  /// The case's key for the Courant number of this stage.
  const char* courant_key() const { return seismic() ? "time_step.courant_number" : "static.courant_number"; }
};

/// Fills `options`, whose `program` says which options there are. Returns an exit code when the command line
/// already answers everything (--help, --version); throws Error(usage) where it cannot be followed as given:
/// what is unknown, empty, no decimal number, given twice or without what it applies to.
std::optional<int> parse_command_line(int argc, char** argv, Options& options, const std::string& version);
} // namespace mpm
