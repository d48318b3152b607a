#pragma once
// Inputs that people give: regular files of a bounded size, read whole.

#include <cstddef>
#include <filesystem>
#include <string>

namespace mpm
{
/// Greatest sizes in bytes; nothing that a person or an archive writes comes near them.
inline constexpr std::size_t most_of_case = std::size_t(16) << 20;
inline constexpr std::size_t most_of_surface = std::size_t(16) << 20;
inline constexpr std::size_t most_of_record = std::size_t(256) << 20;

/// What a file holds, or why it is not read.
struct InputText
{
  std::string text;
  std::string problem; ///< "is a folder", "no such file", ...; empty: `text` is the whole file
};

/// Why `path` is no file to read from: missing, a folder, a pipe, a device, not permitted; empty if it is
/// one. Never waits, as opening a pipe would.
std::string why_no_input(const std::filesystem::path& path);

/// Reads a regular file of at most `most` bytes.
InputText read_input(const std::filesystem::path& path, std::size_t most);
} // namespace mpm
