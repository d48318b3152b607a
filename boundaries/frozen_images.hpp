#pragma once

#include "boundaries/images.hpp"
#include "boundaries/mirrored_wall.hpp"

namespace mpm
{
/// Images of all particles within image_cells of the walls, with the corners' products; each has a load of
/// its own, with the stress and weight that the mirrored particle has now.
Images make_images(const Domain& domain, std::span<const Wall> walls);

/// The static reaction of walls that have gone. In the static stage's equilibrium f_i + S f_i* = 0 at every
/// node, f_i* being that of its mirror node: the wall's force on the ground is what the images of particles
/// beyond it add. So these images are made at the switch, with the stress and weight of that moment, and from
/// then on move with their parents: the ground is in equilibrium to rounding at the switch, and close to it
/// wherever it moves. Forces on boundary nodes, as in the paper, would stay behind as soon as the ground has
/// moved by a fraction of a cell.
///
/// What the images' sum over the nodes loses when the ground has moved over the grid, nodes without mass
/// carrying nothing, is given back as a uniform acceleration of the domain: spread over the faces it would do
/// harm.
class FrozenImages final : public Boundary
{
public:
  explicit FrozenImages(Images images) : images_(std::move(images)) {}
  std::string_view name() const override { return "images"; }
  void sort(const Domain& domain) override { images_.sort(domain.grid, domain.particles); }
  void bind(const Domain& domain) override;
  void release(const Particles& particles) override { images_.release(particles); }
  void add_forces(Domain& domain, double dt) override;
  void measure_work(const Domain& domain, double dt, Energies& now) const override;
  void visit_state(StateVisitor& visitor) override;
  std::string state_problem(const Domain& domain) const override;

private:
  Images images_;
  std::vector<std::array<double, 2>> resultant_; ///< one entry, of the first step, N per m
  /// One entry: uniform acceleration of the last step, m/s2.
  std::vector<std::array<double, 2>> correction_{{}};
  double mass_ = 0; ///< of the domain, kg per m
};
} // namespace mpm
