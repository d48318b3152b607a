#pragma once
// Keys of the case file that have been given a better name.

#include <algorithm>
#include <array>
#include <string_view>

namespace mpm
{
struct RenamedKey
{
  std::string_view before, now; ///< key paths
};

inline constexpr std::array renamed_keys{
    RenamedKey{"time_step.safety", "time_step.courant_number"},
    RenamedKey{"static.safety", "static.courant_number"},
    RenamedKey{"seismic.flip_blend", "seismic.transfer"},
    RenamedKey{"seismic.flip_ends", "seismic.filter.time"},
};

/// What a key is called that has had the path `before`; empty: it was none.
constexpr std::string_view name_now(std::string_view before)
{
  const auto found = std::ranges::find(renamed_keys, before, &RenamedKey::before);
  return found == renamed_keys.end() ? std::string_view() : found->now;
}
} // namespace mpm
