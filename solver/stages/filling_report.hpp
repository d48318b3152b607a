#pragma once

#include "io/run_folder/log.hpp"
#include "solver/stages/fill.hpp"

namespace mpm
{
/// Compares the filled ground with the drawn one, region by region. Warns of layers that are lost in part,
/// that have more than a few per cent more or less area than drawn, or are too thin to yield as they should,
/// and of a base without ground. Throws Error (bad_input) when a region that the case draws has no particle
/// at all.
void report_filling(Log& log, const Case& case_file, const Filling& filling);
} // namespace mpm
