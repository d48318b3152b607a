// A row is added to all series of a clock at once, filled with NaN, so that a series that is not recorded at
// some time has a hole there instead of being shifted. Saving writes every group with its own `time` and
// axes: xarray opens a group by itself and knows nothing of its neighbours.

#include "io/results/history.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mpm
{
namespace
{
/// The program calls this class in a way that makes no history: a bug, not bad input.
[[noreturn]] void misuse(const std::string& path, const std::string& what)
{
  throw Error(exit_code::bug, fmt::format("history: {}: {}; report this", path, what));
}

/// The file holds another run's history.
[[noreturn]] void other_history(const h5::Group& group, const std::string& path, const std::string& what)
{
  throw Error(exit_code::bad_input, fmt::format("{}: {}; resume with the case that wrote it, or start anew",
                                                group.where(path), what));
}
} // namespace

History::Clock History::add_clock()
{
  clocks_.emplace_back();
  return clocks_.size() - 1;
}

History::Series History::add_series(const std::string& path, const std::string& unit, std::vector<Axis> axes,
                                    Clock clock)
{
  const std::size_t start = path.starts_with('/') ? 1 : 0;
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos || slash <= start) misuse(path, "a series lives in a group");

  Record record{
      path.substr(start, slash - start), path.substr(slash + 1), unit, std::move(axes), clock, 1, {}};
  for (const auto& axis : record.axes) record.width *= axis.labels.size();
  check_new(record);
  all_.push_back(std::move(record));
  return all_.size() - 1;
}

// What a group shares in the file, its clock and its axes, all its series must share here.
void History::check_new(const Record& record) const
{
  if (record.clock >= clocks_.size()) misuse(record.path(), "it has no clock");
  if (rows(record.clock) > 0) misuse(record.path(), "rows have begun without it");
  for (const auto& other : all_)
  {
    if (other.group != record.group) continue;
    if (other.name == record.name) misuse(record.path(), "added twice");
    if (other.clock != record.clock) misuse(record.path(), "its group has another clock");
    for (const auto& axis : record.axes)
      for (const auto& known : other.axes)
        if (known.name == axis.name && known.labels != axis.labels)
          misuse(record.path(), "its group has another " + axis.name);
  }
}

void History::start_row(double time, Clock clock)
{
  auto& times = clocks_[clock];
  if (!times.empty() && !(time > times.back()))
    misuse("time", fmt::format("a row at {} s after one at {} s", time, times.back()));
  times.push_back(time);
  for (auto& record : all_)
    if (record.clock == clock) record.values.resize(times.size() * record.width, NAN);
}

void History::record(Series series, std::span<const double> values)
{
  Record& record = all_[series];
  if (values.size() != record.width)
    misuse(record.path(), fmt::format("{} values in a row of {}", values.size(), record.width));
  if (rows(record.clock) == 0) misuse(record.path(), "no row has begun");
  std::copy(values.begin(), values.end(), record.values.end() - std::ptrdiff_t(record.width));
}

void History::record(Series series, double value)
{
  record(series, std::span(&value, 1));
}

// Times and labels are written with the first series of a group and attached as HDF5 dimension scales to
// every one, which is how netCDF-4, and with it xarray, finds coordinates.
void History::save_record(h5::Group& group, const Record& record) const
{
  const std::string time = record.group + "/time";
  const auto& times = clocks_[record.clock];
  if (!group.exists(time)) group.write(time, times, {}, "s");

  std::vector<hsize_t> dims = {times.size()};
  for (const auto& axis : record.axes) dims.push_back(axis.labels.size());
  group.write(record.path(), record.values, dims, record.unit);
  group.attach_scale(record.path(), time, 0);

  for (unsigned i = 0; i < record.axes.size(); ++i)
  {
    const std::string scale = record.group + "/" + record.axes[i].name;
    if (!group.exists(scale)) group.write_strings(scale, record.axes[i].labels);
    group.attach_scale(record.path(), scale, i + 1);
  }
}

void History::save(h5::Group& group) const
{
  for (const auto& record : all_) save_record(group, record);
}

// A run can only go on with the series it would have made itself: same names, same axes, same labels in the
// same order.
std::vector<double> History::load_times(const h5::Group& group, const Record& record) const
{
  if (!group.exists(record.path())) other_history(group, record.path(), "it is missing");
  auto times = group.read_doubles(record.group + "/time");
  std::vector<hsize_t> dims = {times.size()};
  for (const auto& axis : record.axes)
  {
    if (group.read_strings(record.group + "/" + axis.name) != axis.labels)
      other_history(group, record.path(), "it was sampled at another " + axis.name);
    dims.push_back(axis.labels.size());
  }
  if (group.shape(record.path()) != dims) other_history(group, record.path(), "it has another shape");
  return times;
}

// Into copies first: a file that is refused half way leaves the history as it was.
void History::load(const h5::Group& group)
{
  std::vector<std::vector<double>> clocks(clocks_.size());
  std::vector<bool> known(clocks_.size());
  std::vector<Record> all = all_;
  for (auto& record : all)
  {
    auto times = load_times(group, record);
    if (known[record.clock] && times != clocks[record.clock])
      other_history(group, record.path(), "its times differ from those of the other series");
    known[record.clock] = true;
    clocks[record.clock] = std::move(times);
    record.values = group.read_doubles(record.path());
  }
  clocks_ = std::move(clocks);
  all_ = std::move(all);
}

void History::write(const std::filesystem::path& path, const Provenance& provenance,
                    const std::function<void(h5::File&)>& more) const
{
  write_file_atomically(path,
                        [&](h5::File& file)
                        {
                          write_provenance(file, provenance, "seismpm-history/1");
                          save(file);
                          if (more) more(file);
                        });
}
} // namespace mpm
