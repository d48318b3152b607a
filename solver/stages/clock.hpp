#pragma once

#include "solver/mpm/domain.hpp"

#include <cmath>
#include <cstdint>

namespace mpm
{
/// Number of the step and time of a stage: t = t_0 + (k - k_0) dt with k_0 the step at which dt was chosen,
/// so that no rounding piles up over 1e5 steps and a resumed run has the same times to the last bit.
struct Clock
{
  double dt = 0;               ///< s
  std::int64_t step = 0;       ///< k
  double start_time = 0;       ///< t_0, s
  std::int64_t start_step = 0; ///< k_0

  double time() const { return start_time + static_cast<double>(step - start_step) * dt; } ///< s

  /// Goes on in steps of another length (s) from the present time.
  void change_step(double new_dt)
  {
    start_time = time();
    start_step = step;
    dt = new_dt;
  }

  /// Whether a multiple of `every` (s) was reached in the last step.
  bool passed(double every) const
  {
    constexpr double rounding = 1e-6; // of an interval: t = k dt may fall short of a multiple by a bit
    const auto multiples = [every](double t) { return std::floor(t / every + rounding); };
    return multiples(time()) > multiples(time() - dt);
  }
};

/// Whether a run of so many seconds is over; the duration is a multiple of the step as a rule.
inline bool is_over(double time, double duration)
{
  constexpr double rounding = 1e-9; // of the duration
  return time >= duration * (1 - rounding);
}

/// Steps of dt (s) that such a run takes.
inline std::int64_t steps_in(double duration, double dt)
{
  auto steps = static_cast<std::int64_t>(duration / dt);
  for (steps = steps > 1 ? steps - 2 : 0; !is_over(static_cast<double>(steps) * dt, duration);) ++steps;
  return steps;
}

/// The same failure, which tells also after how many steps it was found.
inline Diverged after_steps(const Diverged& failure, const Clock& clock)
{
  return Diverged(failure.what() + (", after " + std::to_string(clock.step)) + " steps");
}
} // namespace mpm
