#pragma once
// FOLDER/finished.json: that the run is finished, and by which files. It is written last and removed first.

#include <filesystem>
#include <string>
#include <vector>

namespace mpm
{
inline constexpr const char* finish_mark = "finished.json";

/// Writes the mark with size and SHA-256 of each of the files (names in `folder`). `Error` write_failed when
/// one of them is not there or not whole.
void write_finish_mark(const std::filesystem::path& folder, const std::vector<std::string>& names);

bool has_finish_mark(const std::filesystem::path& folder);

/// In what the files differ from those that the mark names, in words; empty: they are all there and whole.
std::string broken_mark(const std::filesystem::path& folder);

/// Takes the mark away for good, also should the machine stop now. `Error` write_failed.
void remove_finish_mark(const std::filesystem::path& folder);
} // namespace mpm
