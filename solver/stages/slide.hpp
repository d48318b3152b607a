#pragma once
// Run-out: what of the ground has moved, since when, how far and how fast.

#include "io/case/case.hpp"
#include "io/results/history.hpp"
#include "solver/stages/model.hpp"

#include <nlohmann/json.hpp>

namespace mpm
{
/// The ground that has slid, `output.slide.moved` or more relative to the base, at one time.
struct MovedGround
{
  double area = 0;                      ///< of the undeformed ground, m2
  double mass = 0;                      ///< kg per m
  std::array<double, 2> displacement{}; ///< of the centre of mass, relative to the base, m
  std::array<double, 2> velocity{};     ///< of the centre of mass, relative to the base, m/s
  double toe = NAN;                     ///< farthest x of what lies together, see front_of, m
  double toe_advance = 0;               ///< from the x of the particle that was farthest at the start, m
  double velocity_99 = 0;               ///< 99th percentile of the particles' speed relative to the base, m/s
  double velocity_point = 0;            ///< greatest such speed, m/s
  std::array<double, 2> point{NAN, NAN}; ///< where, m

  /// Speed of the centre of mass in the direction of its displacement, m/s.
  double advance() const;
};

/// Measures of a slide. Motion counts relative to the base of the left free-field column, or to the grid
/// where the sides have none.
class Slide
{
public:
  static constexpr double early = 0.1; ///< share of the moved mass that makes the beginning of a slide

  Slide(const Model& model, const Case& case_file) : model_(model), case_file_(case_file) {}
  void add_series(History& history, History::Clock clock);
  /// Measures the state at `time` (s) and records it in the row that has begun.
  void sample(History& history, double time);
  const MovedGround& now() const { return now_; }
  double time() const { return time_; } ///< of the last sample, s

  /// When the slide began, s: `early` of the ground that has moved by now was out of place
  /// (SlideSettings::out_of_place) and did not come back. NaN: none has moved.
  double trigger_time() const;
  nlohmann::json summary() const;
  /// Writes `/outline` and the trigger time.
  void write(h5::File& file) const;

  void save(h5::Group& group) const;
  /// `Error` bad_input when it cannot be of a run that has come to `now` (s).
  void load(const h5::Group& group, double now);

private:
  struct Peak
  {
    double value = 0, time = NAN, x = NAN, y = NAN;
    void raise(double other, double when, std::array<double, 2> position = {NAN, NAN});
  };
  MovedGround measure() const;
  void note_out_of_place(double time);
  nlohmann::json peak(const Peak& peak) const;

  const Model& model_;
  const Case& case_file_;
  MovedGround now_;
  double time_ = 0;
  std::vector<double> out_of_place_since_; ///< by particle id, s; NaN: it is in place
  Peak area_, velocity_99_, velocity_point_;
  struct
  {
    History::Series area, mass, displacement, velocity, toe, toe_advance, velocity_99, velocity_point, point,
        left_area, left_mass;
  } series_{};
};
} // namespace mpm
