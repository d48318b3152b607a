#pragma once

#include "io/results/history.hpp"
#include "solver/stages/clock.hpp"
#include "solver/stages/column_envelope.hpp"
#include "solver/stages/session.hpp"
#include "solver/stages/slide.hpp"

namespace mpm
{
/// What a seismic run writes down while it goes: gauges, free field, slide, energy, frames.
class Observer
{
public:
  Observer(Session& session, Model& model, const IncomingWave& wave);
  /// Places the gauges in the ground, as it stands after the static stage.
  void place_gauges();
  /// Looks at the state that the clock has just reached; `first` at the start of the stage.
  void look(const Clock& clock, bool first);
  /// Looks at the end of the stage, where it is not due anyway: slide and frame.
  void look_last(const Clock& clock);
  /// Adds /output to a checkpoint: all rows so far, and which frames the folder holds.
  void save(h5::File& file) const;
  /// Takes up what was written down until the state that the clock has reached; `first_step` is the case's dt
  /// (s). `Error` bad_input when no run of the case wrote that, folder_taken when a frame of it is not in the
  /// folder any more.
  void load(const h5::File& file, const Clock& clock, double first_step);
  /// Names of the files that it has written.
  std::vector<std::string> files() const;
  /// Writes history.h5, the motion as applied until `until` s, and frames.hdf.series.
  void write(double until) const;
  const Slide& slide() const { return slide_; }
  /// Peaks for the summary.
  nlohmann::json summary() const;

private:
  /// A free-field column and its series.
  struct Side
  {
    const FreeFieldColumn* column;
    History::Series surface_displacement, surface_velocity, base_displacement, base_velocity;
    ColumnEnvelope envelope;
    std::string name;
  };
  /// The energy balance of a domain as series.
  struct EnergySeries
  {
    const Domain* domain;
    std::array<History::Series, energy_terms.size()> terms;
    History::Series residual;
  };
  void add_series();
  void add_energy_series();
  void sample_gauges(const Clock& clock);
  void sample_slide(const Clock& clock);
  void sample_energy();
  void sample_base();
  void write_frame(const Clock& clock);
  void write_frame_times() const;
  void write_gauge_places(h5::File& file) const;

  Session& session_;
  Model& model_;
  const IncomingWave& wave_;
  History history_;
  History::Clock fast_ = 0, slow_ = 0; ///< of gauges and columns; of slide, energy and base
  History::Series displacement_ = 0, velocity_ = 0, acceleration_ = 0;
  Slide slide_;
  std::vector<EnergySeries> energy_series_;
  History::Series corner_ = 0, rotation_ = 0, greatest_drift_ = 0;
  std::vector<Side> sides_;
  std::vector<double> last_velocity_; ///< of the gauges at their last sample, m/s
  double last_time_ = 0;              ///< of that sample, s
  struct WrittenFrame
  {
    std::string name;
    double time; ///< s
    std::string digest;
  };
  /// The frames of these times (s) and digests, which must be in the folder.
  void load_frames(const std::vector<double>& times, const std::vector<std::string>& digests);
  std::vector<WrittenFrame> frames_;
};
} // namespace mpm
