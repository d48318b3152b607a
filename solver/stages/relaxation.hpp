#pragma once

#include "solver/stages/clock.hpp"
#include "solver/stages/energy_watch.hpp"
#include "solver/stages/resume.hpp"
#include "solver/stages/summary.hpp"

#include <optional>

namespace mpm
{
/// The undeformed ground between walls, with the inertia and the clock of the static stage.
Model make_static_model(const Case& case_file, Clock& clock);

/// The static stage: dynamic relaxation to equilibrium under gravity.
///
/// Gravity grows smoothly over `static.ramp` while local damping takes a share of every unbalanced force
/// (`static.damping`; Cundall, "Distinct element models of rock and soil structure", in Analytical and
/// Computational Methods in Engineering Rock Mechanics, 1987). Nothing yields until the elastic ground is at
/// rest: a wave of the ramp would else leave plastic strains that no slope under its own weight has. Then the
/// laws may yield, and the ground settles again.
///
/// It is at rest when, over 100 steps,
///
///     unbalanced = sum |f| / (sum |f_int| + sum |f_ext|)  <  static.until.unbalanced
///     kinetic    = kinetic energy / potential energy      <  static.until.kinetic
class Relaxation
{
public:
  Relaxation(Session& session, Model& model);
  /// Opens the energy balances: at the first step, not after a restart.
  void start() { energy_.open(); }
  /// Takes up what a state tells of the stage; model and clock are loaded already. `Error` bad_input.
  void load(const h5::File& state, const Clock& clock);
  /// Steps until the case's criteria hold; returns the exit code: done with final.h5, interrupted with a
  /// checkpoint, or not_converged by `static.until.at_most`.
  int run(Clock& clock, Start start);
  /// When elastic ground was at rest, and when all was, s.
  struct Ends
  {
    double elastic = 0, all = 0;
  };
  /// Steps until the criteria hold and writes nothing; empty where they do not within `most` steps, or the
  /// ground comes apart. To see how long it takes, on a model of few particles.
  std::optional<Ends> settle(Clock& clock, std::int64_t most);

private:
  enum class Phase
  {
    elastic, ///< gravity grows, nothing yields
    plastic, ///< the laws may yield
  };
  enum class Ended
  {
    converged,
    out_of_time,
    interrupted, ///< with a checkpoint
  };
  int run_to_end(Clock& clock, Start start, const Summary& summary);
  Ended loop(Clock& clock, Progress& progress);
  double gravity_at(double time) const;
  bool is_good() const;
  void step(Clock& clock, bool measure);
  void check(const Clock& clock);
  bool converged(const Clock& clock);
  void report(const Clock& clock) const;
  void save(const std::string& name, const Clock& clock);
  Moment moment(const Clock& clock) const;
  nlohmann::json facts() const;
  std::string failure() const;
  void set_phase(Phase phase);

  Session& session_;
  Model& model_;
  EnergyWatch energy_;
  Phase phase_ = Phase::elastic;
  double weight_ = 0;                   ///< potential energy of the ground above its base, J per m
  double unbalanced_ = 1, kinetic_ = 1; ///< ratios at the last check
  std::int64_t held_ = 0;               ///< checks in a row at which all criteria held
  bool plasticity_ = false;             ///< whether any law can yield
};
} // namespace mpm
