#pragma once

#include "solver/stages/model.hpp"
#include "solver/stages/session.hpp"

namespace mpm
{
/// Keeps an eye on the energy balances of the model and its columns: they must close, and energy must not
/// come from nowhere.
class EnergyWatch
{
public:
  EnergyWatch(Session& session, Model& model) : session_(session), model_(model) {}
  /// Opens the energy balances at the start of a stage.
  void open();
  /// Warns, once a domain, when an energy balance does not close; throws Diverged when energy has grown
  /// without a source.
  void check(double time);
  /// Throws Diverged when energy has grown without a source; warns of nothing.
  void check_growth() const;
  /// Tells the log where the energy went, in the model.
  void report() const;
  /// Terms and residuals in J per m, for summary.json.
  nlohmann::json summary() const;

private:
  Session& session_;
  Model& model_;
  std::vector<Part> warned_; ///< of a balance that does not close
};

/// Largest residual (J per m) of a balance that closes: 2 % of its largest term, and a quarter of what the
/// transfers between particles and grid took. `opening` is what was there when the balance was opened.
double closing_bound(const Energies& balance, const EnergyBalance& opening);

/// Throws Diverged when more energy than a tenth of all that was there and was brought has come from nowhere,
/// or when more than that is in motion and has been radiated.
void check_growth(const Domain& domain, const Energies& balance);
} // namespace mpm
