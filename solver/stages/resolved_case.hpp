#pragma once

#include "io/case/case.hpp"
#include "solver/stages/command_line.hpp"

namespace mpm
{
/// The case with every default written out, and with the records and the scale of the command line in it, as
/// YAML that load_case reads back to the same settings. `--print-case` prints it, case-resolved.yaml and
/// every checkpoint hold it.
std::string resolved_case(const Case& case_file, const Options& options);
} // namespace mpm
