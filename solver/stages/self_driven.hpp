#pragma once

#include "solver/stages/slide.hpp"

namespace mpm
{
/// Decides when a slide goes on without the shaking (`seismic.motion.end: self_driven`): ground of
/// `least_area` has moved more than `Slide::moved`, and its centre of mass has advanced at `least_speed` or
/// more, relative to the base, for `hold` without a break. Shaking turns round within half a period, which is
/// shorter than `hold` for all but the longest periods of a record, and a block that only shaking moves stops
/// with it.
class SelfDriven
{
public:
  static constexpr double least_area = 10;   ///< m2
  static constexpr double least_speed = 0.1; ///< m/s
  static constexpr double hold = 1;          ///< s

  /// Looks at a sample of the slide; whether it is the one that decides. Once decided it stays so.
  bool decide(const MovedGround& moved, double time);
  /// When it was decided, s; NaN: not yet.
  double decided() const { return decided_; }

  void save(h5::Group& group) const;
  /// `Error` bad_input when it cannot be of a run that has come to `now` (s).
  void load(const h5::Group& group, double now);

private:
  double since_ = NAN; ///< since when the criterion holds, s
  double decided_ = NAN;
};
} // namespace mpm
