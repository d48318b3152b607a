#include "solver/stages/occasions.hpp"

#include "io/case/profiles.hpp"
#include "io/case/size.hpp"
#include "io/run_folder/log.hpp"
#include "solver/mpm/rest.hpp"

#include <cmath>

namespace mpm
{
Occasions occasions_of(const Case& case_file, const IncomingWave* wave, double dt, double duration)
{
  Occasions all;
  all.steps = steps_in(duration, dt);
  all.looks = static_cast<double>(all.steps) / 100;
  all.states = 1;
  all.state_bytes = checkpoint_bytes(1, case_file);
  if (wave == nullptr) return all;
  all.samples = 1 + std::ceil(duration / slide_every);
  all.frames = 1 + std::ceil(duration / case_file.output.frames.every);
  all.frame_bytes = frame_bytes(case_file);
  all.yielding = scales_of(case_file).yielding;
  if (case_file.seismic.rest_below > 0)
    all.skipped = std::max(0.0, duration - wave->end() - Rest::window) / dt * (1 - all.yielding);
  return all;
}

std::string time_text(double seconds)
{
  return seconds < 100 ? fmt::format("{:.3g} s", seconds) : duration_text(seconds);
}
} // namespace mpm
