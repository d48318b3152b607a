#pragma once

#include "io/case/case.hpp"
#include "io/results/hdf5.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
/// Share of FLIP in the particles' velocities over a run: the case's (`seismic.flip_blend`) while the ground
/// shakes. Once ground has slid it fades to none, since FLIP keeps velocities that the grid does not see,
/// which a run-out would carry along; FlipEnds::never keeps it, for zones of so few cells that affine
/// transfers alone would hold the slide back as a viscosity does.
class FlipBlend
{
public:
  static constexpr double fade = 1; ///< s

  FlipBlend(double share, FlipEnds ends) : share_(share), ends_(ends) {}
  /// Whether ground has slid by `time` (s).
  void note(bool slid, double time)
  {
    if (slid && ends_ == FlipEnds::on_slide && std::isnan(slid_)) slid_ = time;
  }
  /// The share at `time` (s).
  double at(double time) const
  {
    return std::isnan(slid_) ? share_ : share_ * std::clamp(1 - (time - slid_) / fade, 0.0, 1.0);
  }
  void save(h5::Group& group) const { group.attribute("slid", slid_); }
  /// `Error` bad_input when it cannot be of a run that has come to `now` (s).
  void load(const h5::Group& group, double now)
  {
    slid_ = group.attribute_double("slid");
    if (slid_ < 0 || slid_ > now)
      throw Error(exit_code::bad_input, group.where() + ": the ground slid at a time that has not come");
  }

private:
  double share_;
  FlipEnds ends_;
  double slid_ = NAN; ///< since when, s
};
} // namespace mpm
