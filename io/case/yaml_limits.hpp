#pragma once
// How much YAML is read. Text is cheap to write, and yaml-cpp takes hundreds of bytes for each value of it.

#include <yaml-cpp/mark.h>

#include <optional>
#include <string>

namespace mpm
{
inline constexpr int deepest_yaml = 20;         ///< levels; an alias that contains itself has no end
inline constexpr int most_yaml_nodes = 100'000; ///< aliases of aliases multiply

/// Where a text goes beyond these, aliases not unfolded; empty: nowhere. Takes no memory for what it passes.
/// Throws YAML::Exception where the text is no YAML.
std::optional<YAML::Mark> end_of_what_is_read(const std::string& text);
} // namespace mpm
