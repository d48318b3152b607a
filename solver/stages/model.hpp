#pragma once

#include "boundaries/free_field.hpp"
#include "solver/stages/fill.hpp"

namespace mpm
{
/// A case ready to step: the model and its free-field columns (none where the sides are not free-field).
struct Model
{
  std::unique_ptr<Domain> main;
  std::unique_ptr<FreeFieldColumn> left, right;
  std::vector<double> reference_volume; ///< by particle id, m3 per m
  Filling filling;                      ///< without its seeds, which have become particles
  std::vector<const FreeFieldSide*> sides;
  CompliantBase* base = nullptr; ///< of `main`; null on a fixed base and before the switch

  /// f(domain, name) for the model ("" as name) and each column ("left", "right").
  template <class Function>
  void for_each_domain(const Function& f)
  {
    f(*main, std::string());
    if (left) f(*left->domain, std::string("left"));
    if (right) f(*right->domain, std::string("right"));
  }
};

/// The undeformed ground: particles fill the regions, no stress, no boundaries yet.
Model make_model(const Case& case_file);

/// Kinematic walls of the static stage: no-slip base, slip sides (METHODS section 2).
void add_static_boundaries(Model& model, const Case& case_file);

/// The switch: walls leave and their reaction stays (METHODS section 3); particles come to rest; base and
/// sides become what the case's seismic section says. With `restarting`, the boundaries are left empty for a
/// checkpoint to fill.
void add_seismic_boundaries(Model& model, const Case& case_file, std::shared_ptr<const IncomingWave> wave,
                            bool restarting);

/// Where the columns' bases stand now; empty without columns.
std::vector<FreeFieldBase> free_field_base(const Model& model);

/// Time T of the base's spring in s, 0 for none: the case's, or the ground's longest period, so that what the
/// ground answers to is reflected by no more than 1 / (1 + (2 pi)^2) = 2.5 % of its amplitude (see
/// BaseSpring).
double spring_time(const Case& case_file);

/// By how much sigma_xx of the model's outermost particles differs from their rows in the side's column: mean
/// difference over mean column stress; 0 without a column. For the static state, before the switch.
double side_stress_mismatch(const Model& model, const Case& case_file, Edge edge);

/// Advances columns, then the model, from `time` over `dt` s.
void advance(Model& model, double time, double dt);

/// Greatest pressure-wave speed of the case as it is now, m/s: rho = m/V, V of what is torn apart being the
/// volume that it has when it has closed, since it carries no stress before.
double greatest_wave_speed(const Domain& domain);

/// Makes inertial masses so large that pressure waves are as slow in every material as in the slowest one: a
/// static stage then settles in fewer steps, to the same equilibrium, since weights stay as they are.
void scale_masses(Model& model);
} // namespace mpm
