#pragma once

#include "boundaries/compliant_base.hpp"
#include "boundaries/images.hpp"

namespace mpm
{
/// In-plane stress of a row of particles times their volume, N m per m.
struct RowStress
{
  double xx = 0, yy = 0, xy = 0;
};

/// A free-field column, the level ground beside the model: a domain one cell wide and wrapped, which makes it
/// a column of ground in one dimension (Grid::wrapped), with the rows, materials and base of the model's
/// outermost column of particles. It makes each step before the model does, feels nothing of the model, and
/// keeps what the model's side needs.
class FreeFieldColumn
{
public:
  /// `side` is where the model's side stands, m.
  FreeFieldColumn(std::unique_ptr<Domain> domain, double side);

  /// Advances the column over the step that the model will make next, keeping the stress at the step's start.
  void advance(double time, double dt);

  /// Row of particles whose reference height is nearest to y (m).
  int row_near(double y) const;
  int rows() const { return static_cast<int>(ids_.size()); }
  /// V sigma (N m per m) of the rows as they are now.
  std::vector<RowStress> stress_of_rows() const;
  /// Displacement of the lowest row as it is now, and the side below which it stands.
  FreeFieldBase base() const;

  std::unique_ptr<Domain> domain;
  const CompliantBase* compliant_base = nullptr; ///< of the domain; null on a fixed base
  std::vector<RowStress> stress;                 ///< of the rows, at the step's start
  std::vector<std::array<double, 2>> velocity;   ///< of the grid rows, mean of the step's start and end, m/s
  std::vector<std::array<double, 2>> acceleration; ///< of the grid rows, m/s2
  int first_row = 0;                               ///< grid row of the first entry

  /// Where the particle of a row stands; the first row is at the base, the last one at the surface.
  int particle_of_row(int row) const { return domain->particles.index_of[ids_[row]]; }

private:
  void note_motion(double dt);
  double side_;
  std::vector<std::int64_t> ids_; ///< from the bottom up
};

/// A free-field side. The paper (eqs. 5 and 6) puts on the face with the outward normal n the traction
///
///   t = (sigma_col - sigma_col,static) n + eta_p (v_col - v)_n + eta_s (v_col - v)_t,
///
/// printed with the signs of a right side. The dashpots act here node by node, against the velocity of the
/// column's node in the same row, as both grids have the same rows. The column's dynamic stress acts as that
/// of the ground itself would: ghost rows beyond the face carry it, with their inertia, so that a level model
/// moves as its column does, where tractions on the face would leave a per mille of difference. The static
/// part is that of the frozen images. Without a column it is a quiet side: dashpots against the ground at
/// rest.
class FreeFieldSide final : public Boundary
{
public:
  /// At `edge`, left or right; `column` is null at a quiet side.
  FreeFieldSide(Edge edge, const FreeFieldColumn* column, std::shared_ptr<const IncomingWave> wave)
      : edge_(edge), column_(column), wave_(std::move(wave))
  {
  }
  /// At the switch: the side stands at `position` (m), the base at `bottom`; `size` is the particle distance.
  void begin(const Domain& domain, double position, double bottom, double size);

  std::string_view name() const override { return edge_ == Edge::left ? "left" : "right"; }
  bool absorbs() const override { return true; }
  void sort(const Domain& domain) override { ghosts_.sort(domain.grid, domain.particles); }
  void bind(const Domain& domain) override { ghosts_.bind(domain.grid, domain.particles); }
  void release(const Particles& particles) override;
  void add_forces(Domain& domain, double dt) override;
  void measure_work(const Domain& domain, double dt, Energies& now) const override;
  void visit_state(StateVisitor& visitor) override;
  std::string state_problem(const Domain& domain) const override;
  Edge edge() const { return edge_; }
  /// The faces, from the bottom up.
  const std::vector<Face>& faces() const { return faces_; }
  /// Greatest distance by which a face and its column have moved apart, m.
  double separation(const Particles& particles) const;

private:
  void load_ghosts();
  void add_ghost_base(Domain& domain, double dt);
  double ghost_base_power(const Domain& domain, double dt) const;
  std::array<double, 2> column_velocity(int row) const;
  /// What the dashpots below the column met at a row of nodes, m/s.
  std::array<double, 2> base_velocity(int row) const;

  Edge edge_;
  const FreeFieldColumn* column_;
  std::shared_ptr<const IncomingWave> wave_;
  std::vector<Face> faces_;
  std::vector<Face> ghost_base_;         ///< base dashpots below the ghost rows
  FaceNodes nodes_, ghost_nodes_;        ///< of both, in the last step
  Images ghosts_;                        ///< their loads are those of the column's rows
  std::vector<RowStress> static_stress_; ///< of the column's rows at the switch
};
} // namespace mpm
