#pragma once

#include "boundaries/faces.hpp"
#include "boundaries/ground_motion.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>

namespace mpm
{
/// How a wave ends before its record does: its velocity fades like a cosine over `length` from `start` on.
struct Fade
{
  static constexpr double length = 0.5;                   ///< s
  double start = std::numeric_limits<double>::infinity(); ///< s

  double end() const { return start + length; }
  /// What is left of the velocity at `t` in s.
  double share(double t) const
  {
    const double s = std::clamp((t - start) / length, 0.0, 1.0);
    return 0.5 + 0.5 * std::cos(std::numbers::pi * s);
  }
};

/// The upgoing wave that enters at the base: S (horizontal) and P (vertical) part, each of them optional.
struct IncomingWave
{
  std::optional<GroundMotion> horizontal, vertical;
  Fade fade;

  std::array<double, 2> velocity(double t) const
  {
    const double share = fade.share(t);
    return {horizontal ? share * horizontal->upgoing_velocity(t) : 0,
            vertical ? share * vertical->upgoing_velocity(t) : 0};
  }
};

/// Compliant base (paper eq. 4): viscous dashpots on the bottom row whose far end moves with twice the
/// upgoing velocity; the static reaction is that of the frozen images.
class CompliantBase final : public Boundary
{
public:
  /// `faces` is empty when a checkpoint is going to be loaded.
  CompliantBase(std::vector<Face> faces, std::shared_ptr<const IncomingWave> wave)
      : faces_(std::move(faces)), wave_(std::move(wave))
  {
  }
  std::string_view name() const override { return "base"; }
  bool absorbs() const override { return true; }
  void add_forces(Domain& domain, double dt) override;
  void measure_work(const Domain& domain, double dt, Energies& now) const override;
  void visit_state(StateVisitor& visitor) override { visit_faces(visitor, "face_", faces_); }

private:
  std::vector<Face> faces_;
  std::shared_ptr<const IncomingWave> wave_;
};
} // namespace mpm
