#pragma once

#include "boundaries/mirrored_wall.hpp"

#include <Eigen/Core>

#include <array>
#include <span>

namespace mpm
{
/// A massless image of a particle beyond a wall that has gone: it moves with its parent and keeps the stress
/// that the mirrored particle had, so that the wall's reaction stays (METHODS section 3, option d).
struct Image
{
  std::int64_t parent = 0;                          ///< particle id
  Eigen::Vector2d offset = Eigen::Vector2d::Zero(); ///< from the parent, m
  Eigen::Matrix2d stress =
      Eigen::Matrix2d::Zero(); ///< S sigma M V, N m per m; not symmetric behind a no-slip wall
  Eigen::Vector2d weight = Eigen::Vector2d::Zero(); ///< S m g, N per m
  BlockIndex block{};                               ///< where it stood at the last sort
  double mass = 0; ///< of the ghost row that it stands for, kg per m; 0 when it has no dynamics
};

/// Images of all particles within four cells of the walls, with the corners' products.
std::vector<Image> make_images(const Domain& domain, std::span<const Wall> walls);

/// Saves or loads images, under names that begin with `prefix`.
void visit_images(StateVisitor& visitor, std::string prefix, std::vector<Image>& images);

/// Finds the block in which each image stands now.
void place_images(const Domain& domain, std::vector<Image>& images);

/// Images sorted by grid block, as the coloured scatter wants them.
class ImageBlocks
{
public:
  /// Groups `images`, whose order stays the caller's, by their block.
  void bind(const Domain& domain, const std::vector<Image>& images);

  struct Extra
  {
    /// Stress tensors times volume (N m per m) to be added, by image; empty for none.
    std::span<const Eigen::Matrix2d> stress;
    /// Acceleration of the ghost's mass by grid row, m/s2: acceleration[row - first_row]; empty for none.
    std::span<const std::array<double, 2>> acceleration;
    int first_row = 0;
  };
  /// Adds the images' forces to nodes that hold real mass, and returns their sum (N per m).
  std::array<double, 2> add_forces(Domain& domain, const std::vector<Image>& images, const Extra& extra);
  /// Work of those forces in the step, J per m; after the equation of motion.
  double work(const Domain& domain, double dt) const;

private:
  struct ImageHome
  {
    BlockIndex block;
    Neighbours around;
    int begin, end;
    PairTile force; ///< of the last step, N per m
  };
  /// Forces of a home's images, into its tile.
  void scatter(const Domain& domain, ImageHome& home, const std::vector<Image>& images,
               const Extra& extra) const;
  /// Adds a home's tile to the nodes that hold real mass, and returns the sum.
  std::array<double, 2> gather(Grid& grid, const ImageHome& home) const;
  std::vector<int> order_;
  std::vector<ImageHome> homes_;
  std::array<parallel::Group, 4> colours_;
};

/// The static reaction of walls that have gone. What the images lose in resultant when the body has moved
/// over the grid is given back as a uniform acceleration (METHODS section 3).
class FrozenImages final : public Boundary
{
public:
  explicit FrozenImages(std::vector<Image> images) : images_(std::move(images)) {}
  std::string_view name() const override { return "images"; }
  void sort(const Domain& domain) override { place_images(domain, images_); }
  void bind(const Domain& domain) override;
  void add_forces(Domain& domain, double dt) override;
  void measure_work(const Domain& domain, double dt, Energies& now) const override;
  void visit_state(StateVisitor& visitor) override;

private:
  std::vector<Image> images_;
  std::vector<std::array<double, 2>> resultant_; ///< one entry, of the first step, N per m
  ImageBlocks blocks_;
  std::vector<std::array<double, 2>> correction_{
      {}};          ///< one entry: uniform acceleration of the last step, m/s2
  double mass_ = 0; ///< of the domain, kg per m
};
} // namespace mpm
