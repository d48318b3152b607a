#pragma once

#include "io/hdf5.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
/// Share of FLIP in the particles' velocities over a run: the case's (`seismic.flip_blend`) while the ground
/// shakes; once ground has slid it fades to none, since FLIP keeps velocities that the grid does not see,
/// which a run-out would carry along.
class FlipBlend
{
public:
  static constexpr double fade = 1; ///< s

  explicit FlipBlend(double share) : share_(share) {}
  /// Whether ground has slid by `time` (s).
  void note(bool slid, double time)
  {
    if (slid && std::isnan(slid_)) slid_ = time;
  }
  double at(double time) const
  {
    return std::isnan(slid_) ? share_ : share_ * std::clamp(1 - (time - slid_) / fade, 0.0, 1.0);
  }
  void save(h5::Group& group) const { group.attribute("slid", slid_); }
  void load(const h5::Group& group) { slid_ = group.attribute_double("slid"); }

private:
  double share_;
  double slid_ = NAN; ///< since when, s
};
} // namespace mpm
