#pragma once

#include "boundaries/mirrored_wall.hpp"

#include <Eigen/Core>

#include <array>
#include <span>

namespace mpm
{
/// What an image brings to the nodes; as many numbers as a vector has (Pairs).
struct alignas(64) ImageLoad
{
  double stress_x[2]{}, stress_y[2]{}; ///< V sigma column by column, N m per m; not symmetric behind a
                                       ///< no-slip wall: S sigma M V
  double weight[2]{};                  ///< S m g, N per m
  double mass = 0; ///< of the ghost row that it stands for, kg per m; 0 when it has no dynamics
  double unused = 0;
};

/// A massless image of a particle beyond a wall that has gone: it moves with its parent (METHODS section 3,
/// option d).
struct Image
{
  std::int64_t parent = 0;                          ///< particle id
  Eigen::Vector2d offset = Eigen::Vector2d::Zero(); ///< from the parent, m
  BlockIndex block{};                               ///< where it stood at the last sort
  int load = 0;                                     ///< which of the loads it brings
};

/// What a step needs of an image.
struct BoundImage
{
  double offset_x, offset_y; ///< as Image::offset
  int parent;                ///< where it stands among the particles
  int load;                  ///< as Image::load
};

/// Images and the loads that they bring, grouped by grid block.
class Images
{
public:
  std::vector<Image> list; ///< any order; bind() sorts it by block, then as the parents stand
  std::vector<ImageLoad> loads;

  /// Forgets images whose parents have left.
  void release(const Particles& particles);
  /// The particles were sorted: finds the block in which each image stands now.
  void sort(const Grid& grid, const Particles& particles);
  /// Finds the parents again, and groups the images by their blocks.
  void bind(const Grid& grid, const Particles& particles);

  /// Motion of the ghosts' mass by grid row, m/s2: acceleration[row - first_row]; empty for none.
  struct Rows
  {
    std::span<const std::array<double, 2>> acceleration;
    int first_row = 0;
  };
  /// Adds the images' forces to nodes that hold real mass, and returns their sum (N per m). Images with
  /// sleeping ground all around them are left out: the nodes that they reach do not move.
  std::array<double, 2> add_forces(Domain& domain, const Rows& rows);
  /// Work of those forces in the step, J per m; after the equation of motion.
  double work(const Grid& grid, double dt) const;

  /// What of a loaded list cannot be, in words; empty: nothing. `loads` is how many there will be.
  std::string problem(const Grid& grid, const Particles& particles, std::size_t loads) const;
  /// Saves or loads the list, without the loads, under names that begin with `prefix`.
  void visit_list(StateVisitor& visitor, const std::string& prefix);
  /// Likewise the loads' stress and weight.
  void visit_loads(StateVisitor& visitor, const std::string& prefix);

private:
  struct ImageHome
  {
    BlockIndex block;
    Neighbours around;
    int begin, end;
    bool hidden;    ///< see add_forces
    PairTile force; ///< of the last step, N per m
  };
  /// Forces of a occupied block's images, into its tile.
  template <bool inertia>
  void scatter(const Grid& grid, const Particles& particles, ImageHome& occupied, const Rows& rows) const;
  /// Adds a occupied block's tile to the nodes that hold real mass, and returns the sum.
  static std::array<double, 2> gather(Grid& grid, const ImageHome& occupied);
  std::vector<BoundImage> bound_; ///< as the list
  std::vector<ImageHome> homes_;
  parallel::Group work_; ///< occupied blocks and what they cost
};

/// Images of all particles within four cells of the walls, with the corners' products; each has a load of its
/// own, with the stress and weight that the mirrored particle has now.
Images make_images(const Domain& domain, std::span<const Wall> walls);

/// The static reaction of walls that have gone. What the images lose in resultant when the body has moved
/// over the grid is given back as a uniform acceleration (METHODS section 3).
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
  std::vector<std::array<double, 2>> correction_{
      {}};          ///< one entry: uniform acceleration of the last step, m/s2
  double mass_ = 0; ///< of the domain, kg per m
};
} // namespace mpm
