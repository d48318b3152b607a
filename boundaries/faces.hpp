#pragma once

#include "solver/mpm/domain.hpp"
#include "solver/mpm/spline.hpp"

#include <span>

namespace mpm
{
/// The piece of an outer face that belongs to a particle of the outer row, and its viscous dashpot. It moves
/// with the particle, half a particle distance outside it, where the ground ends: the internal forces of a
/// uniform stress add up to its traction there, and not at the particle.
struct Face
{
  std::int64_t particle;       ///< id
  double offset_x, offset_y;   ///< from the particle to the face, m
  double dashpot_x, dashpot_y; ///< impedance times area, N s/m per m
};

/// Whether a particle so far (m) from an outer face belongs to the row along it: that row stands half a
/// particle distance `size` inside, the next one and a half.
inline bool in_outer_row(double distance, double size)
{
  return distance <= 0.75 * size;
}

/// Faces of the outer row of particles at `edge`, whose line is at `position` (m); `size` is the particle
/// distance h/n. Impedances rho c are those of each particle's own material (eqs. 4, 5).
std::vector<Face> find_faces(const Domain& domain, Edge edge, double position, double size);

/// What of the faces' dashpots acts at one grid node.
struct FaceNode
{
  int node, column, row;       ///< index in the node fields, column and row of the grid
  double dashpot_x, dashpot_y; ///< N s/m per m
  double drive_x, drive_y;     ///< force of the dashpots' own far ends, N per m
};

/// The nodes around faces, each of them once, with the sums of what acts there.
class FaceNodes
{
public:
  /// Spreads the dashpots of `faces` over the 16 nodes around each, where they stand now: c_i = sum
  /// N_i(x_face) c. Face k has a far end of its own that moves with `far_end`[k], m/s; empty for none.
  void spread(const Grid& grid, const Particles& particles, const std::vector<Face>& faces,
              std::span<const std::array<double, 2>> far_end = {});

  const FaceNode& operator[](std::size_t k) const { return nodes_[k]; }
  std::size_t size() const { return nodes_.size(); }
  auto begin() const { return nodes_.begin(); }
  auto end() const { return nodes_.end(); }

private:
  /// Sums at the 16 nodes of one cell's stencil, of the faces that stand in that cell one after the other.
  struct Cell
  {
    int i, j;                                      ///< first node
    alignas(64) double dashpot[32]{}, drive[32]{}; ///< (x, y) after (x, y), as in FaceNode
  };
  /// Which of nodes_ are the 16 of a cell, -1 where there is no node.
  struct Slots
  {
    int i, j;
    std::array<int, 16> at;
  };
  /// Finds the nodes of the cells anew, in an order that goes by the cells alone.
  void lay_out(const Grid& grid);

  std::vector<FaceNode> nodes_;
  std::vector<Cell> cells_;  ///< of the last step
  std::vector<Slots> slots_; ///< of each cell
  int built_ = 0;            ///< Grid::built when they were found
};

/// What of loaded faces cannot be, in words; empty: nothing.
std::string faces_problem(const std::vector<Face>& faces, const Particles& particles, double spacing);
/// Whether the particle of a face has left.
inline bool has_left(const Particles& particles, const Face& face)
{
  return particles.index_of[face.particle] < 0;
}

/// Saves or loads faces, under names that begin with `prefix`.
void visit_faces(StateVisitor& visitor, std::string prefix, std::vector<Face>& faces);
} // namespace mpm
