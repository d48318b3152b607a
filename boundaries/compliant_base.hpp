#pragma once

#include "boundaries/base_spring.hpp"
#include "boundaries/face_columns.hpp"
#include "boundaries/ground_motion/incoming_wave.hpp"

#include <memory>

namespace mpm
{
/// Compliant base (paper eq. 4): the face moves with v = v_up + v_down on rock that carries both waves on, so
/// that its traction is rho c (v_up - v_down) = rho c (2 v_up - v): dashpots of the impedance rho c, c = c_s
/// along the face and c_p across it, whose far ends move with twice the upgoing velocity. The motion of a
/// rock outcrop is 2 v_up, too. The static reaction is that of the frozen images. A spring, where there is
/// one, keeps the base from drifting away from the free field.
class CompliantBase final : public Boundary
{
public:
  /// `faces` is empty when a checkpoint is going to be loaded.
  CompliantBase(std::vector<Face> faces, std::shared_ptr<const IncomingWave> wave, BaseSpring spring)
      : faces_(std::move(faces)), wave_(std::move(wave)), spring_(std::move(spring))
  {
  }
  std::string_view name() const override { return "base"; }
  bool absorbs() const override { return true; }
  void release(const Particles& particles) override;
  void add_forces(Domain& domain, double dt) override;
  /// Comes after walls have folded the nodes' masses and dashpots.
  void constrain(Grid& grid) override;
  void apply_dashpots(Grid& grid, double dt) override;
  void measure_work(const Domain& domain, double dt, Energies& now) const override;
  void visit_state(StateVisitor& visitor) override;
  std::string state_problem(const Domain& domain) const override;
  /// Velocity that the dashpots of a free-field column's base met at a row of nodes in the last step, m/s;
  /// with consistent inertia only.
  std::array<double, 2> met_velocity(const Grid& grid, int row) const;
  /// Where the free field's base stands at the start of the step to come; without columns the free field goes
  /// where the input takes it.
  void follow(std::vector<FreeFieldBase> free_field) { free_field_ = std::move(free_field); }
  /// From the left to the right.
  const std::vector<Face>& faces() const { return faces_; }
  /// How far the base stands from a free field now.
  BaseDrift drift(const Particles& particles, const std::vector<FreeFieldBase>& free_field) const;

private:
  std::array<double, 2> distance(const Particles& particles, const std::vector<FreeFieldBase>& free_field,
                                 const Face& face) const;
  /// Velocity of the spring's far end behind each face, m/s; empty without a spring.
  std::vector<std::array<double, 2>> stretch_spring(const Particles& particles, double dt);

  std::vector<Face> faces_; ///< from the left to the right
  FaceNodes nodes_;         ///< of the last step
  FaceColumns columns_;     ///< likewise
  std::shared_ptr<const IncomingWave> wave_;
  BaseSpring spring_;
  std::vector<FreeFieldBase> free_field_;
  std::vector<std::array<double, 2>> input_{{}}; ///< one entry: integral of twice the upgoing velocity, m
};
} // namespace mpm
