#pragma once

#include <array>
#include <chrono>
#include <string_view>

namespace mpm
{
/// The phases of a step whose wall time is measured.
enum class Phase
{
  columns, ///< both free-field columns, before the model's own step
  sort,
  scatter,    ///< (a) particles to grid
  boundaries, ///< forces of images, dashpots, sides and springs, and their work
  grid,       ///< (b) equation of motion, walls
  gather,     ///< (c) and (d) grid to particles, strains, stresses
};
inline constexpr std::array<std::string_view, 6> phase_names{"columns",    "sort", "scatter",
                                                             "boundaries", "grid", "gather"};

/// Wall time spent in each phase, s.
class PhaseTimes
{
public:
  void start() { last_ = Watch::now(); }
  /// The time since the last phase ended, or the start, was spent in `phase`.
  void end(Phase phase)
  {
    const auto now = Watch::now();
    seconds_[static_cast<int>(phase)] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  const std::array<double, phase_names.size()>& seconds() const { return seconds_; }

private:
  using Watch = std::chrono::steady_clock;
  Watch::time_point last_;
  std::array<double, phase_names.size()> seconds_{};
};
} // namespace mpm
