#pragma once

#include "solver/stages/energy_watch.hpp"

namespace mpm
{
/// The static stage: gravity ramp, local damping, elastic equilibrium, then plastic equilibrium (METHODS
/// section 3).
class Relaxation
{
public:
  Relaxation(Session& session, Model& model);
  /// Opens the energy balances: at the first step, not after a restart.
  void start() { energy_.open(); }
  void load(const h5::File& file);
  /// Steps until the case's criteria hold; returns the exit code. Writes final.h5 on success.
  int run(Clock& clock);

private:
  enum class Phase
  {
    elastic, ///< gravity grows, nothing yields
    plastic, ///< the laws may yield
  };
  void step(Clock& clock, bool measure);
  void check(const Clock& clock);
  bool converged(const Clock& clock);
  void report(const Clock& clock);
  void save(const std::string& name, const Clock& clock);
  std::string failure() const;
  void set_phase(Phase phase);

  Session& session_;
  Model& model_;
  EnergyWatch energy_;
  Phase phase_ = Phase::elastic;
  double weight_ = 0; ///< potential energy scale, J per m
  double unbalanced_ = 1, kinetic_ = 1;
  std::int64_t held_ = 0; ///< checks in a row at which all criteria held
  bool plasticity_ = false;
};
} // namespace mpm
