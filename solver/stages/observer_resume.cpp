// What a run has written down, taken up again: it must be what a run of this case writes until then.

#include "io/results/checkpoint_layout.hpp"
#include "io/results/frames.hpp"
#include "solver/stages/observer.hpp"

#include <cmath>

namespace mpm
{
namespace
{
[[noreturn]] void refuse(const h5::Group& group, const std::string& name, const std::string& what)
{
  throw Error(exit_code::bad_input, fmt::format("{}: {}; use another file", group.where(name), what));
}

/// A file may be whole and yet be put together of two runs: rows with a gap would make a history that no run
/// wrote. Times of samples that are taken from the start on, never further apart than `most` (s), until
/// `now`.
void check_times(const h5::Group& group, const std::string& name, const std::vector<double>& times,
                 double most, double now)
{
  const double apart = most * (1 + 1e-9);
  if (times.empty() || times.front() != 0) refuse(group, name, "does not begin at the start of the run");
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k] > times[k - 1] && times[k] <= times[k - 1] + apart))
      refuse(group, name, fmt::format("goes from t = {} s to t = {} s", times[k - 1], times[k]));
  if (!(times.back() <= now && times.back() + apart > now))
    refuse(group, name, fmt::format("ends at t = {} s, the state is of t = {} s", times.back(), now));
}

/// Whether the file is there and whole, and was written with this digest.
bool is_frame(const std::filesystem::path& file, const std::string& digest)
{
  try
  {
    std::string found;
    open_complete(file, &found);
    return found == digest;
  }
  catch (const Error&)
  {
    return false;
  }
}
} // namespace

void Observer::load(const h5::File& file, const Clock& clock, double first_step)
{
  const h5::Group group = file.open_group(checkpoint::output);
  const OutputSettings& output = session_.case_file.output;
  history_.load(group.open_group("history"));
  check_times(group, "history", history_.times(fast_), output.gauges.every + first_step, clock.time());
  check_times(group, "history", history_.times(slow_), slide_every + first_step, clock.time());
  last_velocity_ = group.read_doubles("gauge_velocity");
  last_time_ = group.attribute_double("gauge_time");
  const std::size_t gauges = output.gauges.points.size();
  if (model_.main->gauges.size() != gauges || last_velocity_.size() != 2 * gauges ||
      last_time_ != history_.times(fast_).back())
    refuse(group, "gauge_velocity", "is that of other gauges");
  for (std::size_t k = 0; k < last_velocity_.size(); ++k)
    if (!std::isfinite(last_velocity_[k]) && !std::isnan(model_.main->gauges[k / 2].x))
      refuse(group, "gauge_velocity", "is not finite");
  for (Side& side : sides_) side.envelope.load(group.open_group("columns/" + side.name), last_time_);
  slide_.load(group.open_group("slide"), clock.time());
  const std::vector<double> times = group.read_doubles("frame_times");
  check_times(group, "frame_times", times, output.frames.every + first_step, clock.time());
  load_frames(times, group.read_strings("frame_digests"));
}

void Observer::load_frames(const std::vector<double>& times, const std::vector<std::string>& digests)
{
  const std::filesystem::path& folder = session_.folder->path();
  for (std::size_t k = 0; k < times.size(); ++k)
  {
    const std::string name = frame_name(static_cast<std::int64_t>(k));
    const std::string digest = k < digests.size() ? digests[k] : "";
    if (!is_frame(folder / name, digest))
      throw Error(
          exit_code::folder_taken,
          fmt::format("{}: {} is missing, damaged or another run's; put it back, or start anew with --fresh",
                      folder.string(), name));
    frames_.push_back({name, times[k], digest});
  }
}

std::vector<std::string> Observer::files() const
{
  std::vector<std::string> names{"history.h5", "frames.hdf.series"};
  for (const WrittenFrame& frame : frames_) names.push_back(frame.name);
  return names;
}
} // namespace mpm
