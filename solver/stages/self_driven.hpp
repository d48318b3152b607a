#pragma once

#include "solver/stages/slide.hpp"

namespace mpm
{
/// Decides when a slide goes on without the shaking (`seismic.motion.end: self_driven`): `output.slide.area`
/// or more has slid, and its centre of mass has advanced at `least_speed` or more, relative to the base, for
/// `hold` without a break. Shaking turns round within half a period, which is shorter than `hold` for all but
/// the longest periods of a record, and a block that only shaking moves stops with it. So `hold` goes with
/// the motion and is the same for every size of model, while the speed goes with the distance that counts as
/// slid: within `hold` the slide advances by as much as puts ground out of place.
class SelfDriven
{
public:
  static constexpr double hold = 1; ///< s

  explicit SelfDriven(const SlideSettings& slide) : slide_(slide) {}
  double least_speed() const { return slide_.out_of_place() / hold; } ///< m/s
  /// Looks at a sample of the slide; whether it is the one that decides. Once decided it stays so.
  bool decide(const MovedGround& moved, double time);
  /// When it was decided, s; NaN: not yet.
  double decided() const { return decided_; }

  void save(h5::Group& group) const;
  /// `Error` bad_input when it cannot be of a run that has come to `now` (s).
  void load(const h5::Group& group, double now);

private:
  SlideSettings slide_;
  double since_ = NAN; ///< since when the criterion holds, s
  double decided_ = NAN;
};
} // namespace mpm
