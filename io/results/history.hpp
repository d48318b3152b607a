#pragma once
// Time series of a run: gauges, free field, energies, slide. Held in memory and written whole, so that
// rows cannot be torn; kept in the checkpoint, so that a resumed run goes on without a gap or a double.

#include "io/results/files.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mpm
{
/// Named positions along a dimension: {"gauge", {"crest", "toe"}}, {"component", {"x", "y"}}.
struct Axis
{
  std::string name;                ///< of the dimension, and of the dataset with its labels
  std::vector<std::string> labels; ///< one for each index
};

/// Series are added first, then rows. Series on one clock are sampled together; a group of the file has
/// one clock, and gets its `time` and axes as dimension scales (xarray opens it with `group=`).
class History
{
public:
  using Series = std::size_t; ///< handle of a series
  using Clock = std::size_t;  ///< handle of a clock; 0 is there from the start

  /// A clock for series that are sampled at other times.
  Clock add_clock();
  /// `path` is GROUP/NAME, as "gauges/velocity" or "free_field/left/surface_velocity". Without axes: a
  /// scalar.
  Series add_series(const std::string& path, const std::string& unit, std::vector<Axis> axes = {},
                    Clock clock = 0);

  /// Begins the row of a time (s) later than the last one's. What is not recorded in it stays NaN.
  void start_row(double time, Clock clock = 0);
  /// Fills the last row: as many values as the axes have labels, taken together, the last axis fastest.
  void record(Series, std::span<const double> values);
  void record(Series, double value);

  std::size_t rows(Clock clock = 0) const { return clocks_[clock].size(); }
  const std::vector<double>& times(Clock clock = 0) const { return clocks_[clock]; }
  /// All rows of a series, one after the other.
  const std::vector<double>& values(Series series) const { return all_[series].values; }

  /// One layout for history.h5 and for a group of the checkpoint.
  void save(h5::Group& group) const;
  /// Takes the rows from a file whose series and axes are the ones added here; refuses another.
  void load(const h5::Group& group);
  /// `more` adds what is no series over time.
  void write(const std::filesystem::path&, const Provenance&,
             const std::function<void(h5::File&)>& more = {}) const;

private:
  struct Record
  {
    std::string group; ///< path in the file
    std::string name;
    std::string unit;
    std::vector<Axis> axes;
    Clock clock;
    std::size_t width; ///< values in a row
    std::vector<double> values;

    std::string path() const { return group + "/" + name; }
  };
  void check_new(const Record&) const;
  void save_record(h5::Group&, const Record&) const;
  std::vector<double> load_times(const h5::Group&, const Record&) const;

  std::vector<std::vector<double>> clocks_{1}; ///< times of the rows, s
  std::vector<Record> all_;                    ///< in the order in which they were added
};
} // namespace mpm
