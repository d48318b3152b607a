#pragma once
// What a run of the ladder leaves behind: the table for people, everything for the plots.

#include "test/verification/ladder.hpp"

namespace mpm::verification
{
/// A row as a line of the Markdown table.
std::string table_line(const Row& row);

/// Writes RESULTS.md: a table over all cases, and what each norm is.
void write_table(const std::filesystem::path& folder, const std::vector<Result>& results);

/// Writes results.json: titles, rows and curves.
void write_curves(const std::filesystem::path& folder, const std::vector<Result>& results);
} // namespace mpm::verification
