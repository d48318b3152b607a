#pragma once

#include "boundaries/faces.hpp"
#include "boundaries/ground_motion.hpp"

#include <memory>

namespace mpm
{
/// The upgoing wave that enters at the base: S (horizontal) and P (vertical) part, each of them optional.
struct IncomingWave
{
  std::optional<GroundMotion> horizontal, vertical;

  std::array<double, 2> velocity(double t) const
  {
    return {horizontal ? horizontal->upgoing_velocity(t) : 0, vertical ? vertical->upgoing_velocity(t) : 0};
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
