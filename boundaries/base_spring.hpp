#pragma once

#include "boundaries/faces.hpp"

#include <array>
#include <vector>

namespace mpm
{
/// Displacement (m) of the free field's base below one side of the model, which stands at x (m).
struct FreeFieldBase
{
  double x;
  std::array<double, 2> displacement;
};

/// Displacement of the free field's base at x: linear between the sides, constant where there is only one;
/// `otherwise` where there is none.
std::array<double, 2> free_field_displacement(const std::vector<FreeFieldBase>& sides, double x,
                                              const std::array<double, 2>& otherwise);

/// How far the base has gone from where the free field's base goes.
struct BaseDrift
{
  std::array<std::array<double, 2>, 2> corner{}; ///< displacement of the left and the right end, m
  double rotation = 0;    ///< slope of the vertical displacement by least squares, anticlockwise, rad
  double greatest = 0;    ///< greatest displacement of a face, m
  double half_length = 0; ///< of the base, m
};

/// What keeps dashpots from drifting: on each face of impedance z a force (z / T) (s + r) towards the free
/// field,
///
///   ds/dt = (e - s) / (T / 2),   dr/dt = s / (10 T),
///
/// e being the face's distance from the free field. s is the spring, which lags; r is the slow part of the
/// reaction.
///
/// Dashpots alone give way to a lasting load F, such as the weight of ground that has slid, at the speed F /
/// z. With the spring the base goes by about F T / z, as far as without it in T seconds, and comes back as r
/// takes over the load: the static reaction learns the new weight. A wave of angular frequency w is reflected
/// by R = -X / (2 + X), X = (1 + 1 / (10 iwT)) / (iwT (1 + iwT/2)): |R| is 0.53 at w = 1 / T, 0.09 at pi / T
/// and 0.025 at 2 pi / T, near 1 / (1 + (wT)^2), where a spring without lag has 1 / sqrt(1 + (2wT)^2). Far
/// below the ground's own frequencies it is up to 1.16 (at w = 0.2 / T), which the loop of ground and base
/// damps all the same. Only what differs from the free field meets the spring: the motion that level ground
/// has in common with its columns does not.
class BaseSpring
{
public:
  /// `time` is T in s; 0: no spring.
  explicit BaseSpring(double time) : time_(time) {}
  bool acts() const { return time_ > 0; }
  /// Takes in the distance of each face from the free field over a step of dt s. Returns the spring's force
  /// on each face as the velocity of the far end of the face's dashpot, m/s.
  std::vector<std::array<double, 2>> follow(const std::vector<std::array<double, 2>>& distance, double dt);
  /// Forgets a face.
  void drop(std::size_t face);
  void visit_state(StateVisitor& visitor);
  /// Whether what was loaded is of so many faces, or of a spring that has not acted yet.
  bool fits(std::size_t faces) const
  {
    return stretch_.size() == reaction_.size() && (stretch_.empty() || stretch_.size() == faces);
  }

private:
  double time_;
  std::vector<std::array<double, 2>> stretch_;  ///< s by face, m
  std::vector<std::array<double, 2>> reaction_; ///< r by face, m
};
} // namespace mpm
