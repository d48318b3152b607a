#pragma once

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
  /// Warns, once a domain, when a energy balance does not close; throws Diverged when energy has grown
  /// without a source.
  void check(double time);
  /// Tells the log where the energy went, in the model.
  void report() const;
  /// Terms and residuals in J per m, for summary.json.
  nlohmann::json summary() const;

private:
  Session& session_;
  Model& model_;
  std::vector<std::string> warned_; ///< domains
};

/// Largest residual of a energy balance that closes, J per m.
double closing_bound(const Energies& balance, const EnergyBalance& ledger);

/// Throws Diverged when more energy than a tenth of all that was there and was brought has come from nowhere.
void check_growth(const Domain& domain, const Energies& balance);
} // namespace mpm
