#pragma once

#include "boundaries/free_field.hpp"
#include "solver/stages/fill.hpp"
#include "solver/stages/part.hpp"

namespace mpm
{
/// A case ready to step: the ground and its free-field columns (none where the sides are not free-field).
struct Model
{
  std::unique_ptr<Domain> main; ///< the ground between the sides
  std::unique_ptr<FreeFieldColumn> left, right;
  std::vector<double> reference_volume;    ///< of the undeformed ground, by particle id, m3 per m
  Filling filling;                         ///< without its seeds, which have become particles
  std::vector<const FreeFieldSide*> sides; ///< of `main`; none before the switch
  CompliantBase* base = nullptr;           ///< of `main`; null on a fixed base and before the switch

  /// A domain and what it stands for.
  struct Member
  {
    Part part;
    Domain* domain;
  };
  /// The ground and the columns that there are.
  std::vector<Member> domains() const;
  /// Column of a side; null where it has none.
  FreeFieldColumn* column(Edge side) const { return (side == Edge::left ? left : right).get(); }
};

/// The undeformed ground: particles fill the regions, no stress, no boundaries yet.
Model make_model(const Case& case_file);

/// The walls of the static stage: a base that holds, sides that let the ground slide along them. The columns
/// have a base only.
void add_static_boundaries(Model& model, const Case& case_file);

/// How velocities and stresses pass between particles and grid from the shaking on: `seismic.transfer` and
/// `seismic.filter`.
void set_transfer(StepSettings& step, const SeismicSettings& seismic);

/// The switch from statics to shaking: walls leave, and their reaction stays as images, frozen in that state
/// (../../boundaries/README.md); particles come to rest; base and sides become what the case's seismic
/// section says. With `restarting`, the boundaries are left empty for a checkpoint to fill.
void add_seismic_boundaries(Model& model, const Case& case_file, std::shared_ptr<const IncomingWave> wave,
                            bool restarting);

/// Where the columns' bases stand now; empty without columns.
std::vector<FreeFieldBase> free_field_base(const Model& model);

/// Time T of the base's spring in s, 0 for none: the case's, or the ground's longest period. Of a wave of
/// frequency f a spring reflects 1 / (1 + (2 pi f T)^2) of the amplitude (see BaseSpring), so that of what
/// the ground answers to it is no more than 1 / (1 + (2 pi)^2) = 2.5 %.
double spring_time(const Case& case_file);

/// By how much sigma_xx of the model's outermost particles differs from their rows in the side's column: mean
/// difference over mean column stress; 0 without a column. For the static state, before the switch.
double side_stress_mismatch(const Model& model, const Case& case_file, Edge side);

/// Looks at the particles of the ground and the columns (check_particles). Throws Diverged.
void check_health(const Model& model);

/// A step from `time` over `dt` s: of the columns, on two threads if there are two, then of the ground, whose
/// sides need the columns' motion over the step.
void advance(Model& model, double time, double dt);
} // namespace mpm
