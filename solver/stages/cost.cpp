#include "solver/stages/cost.hpp"

#include "solver/mpm/parallel.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace mpm
{
namespace
{
constexpr int warm_up = 10;         // steps: the first sorts, the next fill the caches
constexpr int group = 5;            // steps that are timed together
constexpr int least_groups = 10;    // however long they take
constexpr double long_enough = 0.6; // s

double median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}
} // namespace

double processor_seconds()
{
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

StepCost probe(Model& model, const Clock& clock)
{
  using Wall = std::chrono::steady_clock;
  const auto seconds_since = [](Wall::time_point start)
  { return std::chrono::duration<double>(Wall::now() - start).count(); };
  int step = 0;
  const auto advance_by = [&](int steps)
  {
    for (const int end = step + steps; step < end; ++step) advance(model, step * clock.dt, clock.dt);
  };
  advance_by(warm_up);
  std::vector<double> wall, processor;
  const auto begin = Wall::now();
  while (static_cast<int>(wall.size()) < least_groups || seconds_since(begin) < long_enough)
  {
    const auto start = Wall::now();
    const double before = processor_seconds();
    advance_by(group);
    wall.push_back(seconds_since(start) / group);
    processor.push_back((processor_seconds() - before) / (group * parallel::threads()));
  }
  return {median(wall), median(processor)};
}

double stage_time(const Occasions& occasions, double step, double serial, double particles)
{
  // Measured on one thread with 13 000 to 72 000 particles. Ground that yields returns to its strength, is
  // averaged and filtered where it flows, and is sorted more often: README.md.
  constexpr double sample = 1.5, look = 0.5; // steps
  constexpr double written = 1.2e-9;         // s a byte
  constexpr double flows = 0.2;              // of a step, if all ground did
  const double bytes = occasions.frames * occasions.frame_bytes + occasions.states * occasions.state_bytes;
  return step * (static_cast<double>(occasions.steps) - occasions.skipped) *
             (1 + flows * occasions.yielding) +
         serial * (sample * occasions.samples + look * occasions.looks) + written * bytes * particles;
}
} // namespace mpm
