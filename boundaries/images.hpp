#pragma once

#include "solver/mpm/domain.hpp"
#include "solver/mpm/tile.hpp"

#include <array>
#include <span>

namespace mpm
{
/// Cells beside a wall or side whose particles have images beyond it. Particles inside reach the ghost nodes
/// up to two cells out, and such a node is balanced only if all images that reach it are there: those up to
/// two cells further out.
inline constexpr int image_cells = 4;

/// What an image brings to the nodes, f_i = -Sigma grad N_i + w N_i - a m N_i with the acceleration a of its
/// row; as many numbers as a vector has (Pairs).
struct alignas(64) ImageLoad
{
  double stress_x[2]{}, stress_y[2]{}; ///< Sigma column by column, N m per m: V sigma of a ghost row; S sigma
                                       ///< M V of a mirrored particle, not symmetric behind a no-slip wall
  double weight[2]{};                  ///< S m g, N per m
  double mass = 0; ///< of the ghost row that it stands for, kg per m; 0 when it has no dynamics
  double unused = 0;
};

/// A point beyond a wall or side that stands for the ground there. It has a fixed offset from its parent, a
/// particle of the model, and so goes where that goes; it has no motion of its own.
struct Image
{
  std::int64_t parent = 0;        ///< particle id
  std::array<double, 2> offset{}; ///< from the parent, m
  BlockIndex block{};             ///< in which it stood at the last sort
  int load = 0;                   ///< which of the loads it brings
};

/// What a step needs of an image.
struct BoundImage
{
  double offset_x, offset_y; ///< as Image::offset
  int parent;                ///< index of the particle
  int load;                  ///< as Image::load
};

/// Images and the loads that they bring, grouped by grid block as particles are.
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
  /// Adds the images' forces to nodes that hold mass of particles, and returns their sum (N per m): there is
  /// no ground to move at the others. Images with sleeping ground all around them are left out: the nodes
  /// that they reach do not move.
  std::array<double, 2> add_forces(Domain& domain, const Rows& rows);
  /// Power of those forces with the nodes' mean velocity in the step, W per m; after the equation of motion.
  double power(const Grid& grid) const;
  /// Their work in the step, J per m.
  double work(const Grid& grid, double dt) const;

  /// What of a loaded list cannot be, in words; empty: nothing. `loads` is how many there will be.
  std::string problem(const Grid& grid, const Particles& particles, std::size_t loads) const;
  /// Saves or loads the list, without the loads, under names that begin with `prefix`.
  void visit_list(StateVisitor& visitor, const std::string& prefix);
  /// Likewise the loads' stress and weight.
  void visit_loads(StateVisitor& visitor, const std::string& prefix);

private:
  /// The images in one grid block.
  struct ImageBlock
  {
    BlockIndex block;
    Neighbours around;
    int begin, end; ///< its images in the list
    bool hidden;    ///< see add_forces
    PairTile force; ///< of the last step, N per m
  };
  /// Forces of a block's images, into its tile.
  template <bool inertia>
  void scatter(const Grid& grid, const Particles& particles, ImageBlock& block, const Rows& rows) const;
  /// Adds a block's tile to the nodes that hold mass, and returns the sum.
  static std::array<double, 2> gather(Grid& grid, const ImageBlock& block);
  std::vector<BoundImage> bound_; ///< as the list
  std::vector<ImageBlock> blocks_;
  parallel::Group work_; ///< indices in blocks_, and what they cost
};
} // namespace mpm
