#include "solver/stages/energy_watch.hpp"

#include "solver/mpm/health.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
// What may be left of an energy balance that is kept well.
//
// Of what the transfers take, the stress does work on during half a step: dt/2 f . dv, at most omega dt / 2
// of it. The fastest motion of the grid has omega of about c_p / h, so that this is C/2 with C the Courant
// number, 1/4 as a rule.
constexpr double transfer_share = 0.25;
// Of a wave's energy (omega dt)^2 is left at the ends of the balance: 1.5 % at C = 0.5 and the 26 cells a
// wavelength that waves need anyway. The elastic energy of a hypoelastic law is known to a third of the
// elastic strain, 0.1 %.
constexpr double share = 0.02;
// A millionth of the elastic energy that gravity has stored in the ground is none.
constexpr double negligible = 1e-6;
// What has come from nowhere, of all that was there and came in, before a run has diverged.
constexpr double growth_share = 0.1;

/// Below that a share says nothing: ground at rest has a residual of rounding alone.
double negligible_energy(const EnergyBalance& opening)
{
  return negligible * opening.elastic;
}

/// Of a step beyond the limit the sum that symplectic Euler keeps tells nothing: its part at the middle of
/// the step takes away what the motion gains. But what moves and what has been radiated must have been there
/// or have come in, whatever the stress holds.
void check_motion(const Domain& domain, const Energies& e)
{
  const EnergyBalance& opening = domain.energy;
  const double used = opening.kinetic + e[Energy::kinetic] + e[Energy::radiated_base] +
                      e[Energy::radiated_sides] + e[Energy::departed];
  const double there = opening.kinetic + opening.elastic + e[Energy::incoming];
  const double available = there + e[Energy::reaction] + e[Energy::free_field] - e[Energy::gravitational];
  const double turned_over = there + std::fabs(e[Energy::reaction]) + std::fabs(e[Energy::free_field]) +
                             std::fabs(e[Energy::gravitational]);
  if (used <= available + growth_share * turned_over + negligible_energy(opening)) return;
  throw Diverged(
      fmt::format("{}: {:.3g} J/m are in motion or have been radiated by t = {:.3f} s, where the energy has "
                  "grown to no more than {:.3g} J/m; the fastest is {}",
                  domain.name, used, domain.time, available, fastest_particle(domain)));
}
} // namespace

double closing_bound(const Energies& balance, const EnergyBalance& opening)
{
  return share * largest_term(balance) + transfer_share * std::fabs(balance[Energy::transfer]) +
         negligible_energy(opening);
}

/// Sources are what was there at the opening, what the wave and the columns brought, and what gravity did
/// less what the static reaction held back.
void check_growth(const Domain& domain, const Energies& e)
{
  const double grown = unexplained_growth(e);
  const double settled = std::fabs(e[Energy::gravitational] - e[Energy::reaction]);
  const double sources =
      std::max({domain.energy.kinetic, e[Energy::incoming], std::fabs(e[Energy::free_field]), settled});
  if (!(grown <= growth_share * sources + negligible_energy(domain.energy))) // true of no number too
    throw Diverged(
        fmt::format("{}: the energy has grown by {:.3g} J/m without a source by t = {:.3f} s, where "
                    "{:.3g} J/m were there or came in; the fastest is {}",
                    domain.name, grown, domain.time, sources, fastest_particle(domain)));
  check_motion(domain, e);
}

void EnergyWatch::open()
{
  for (const auto& [part, domain] : model_.domains()) open_energy_balance(*domain);
}

void EnergyWatch::check_growth() const
{
  for (const auto& [part, domain] : model_.domains()) mpm::check_growth(*domain, energies_of(*domain));
}

void EnergyWatch::check(double time)
{
  for (const auto& [part, domain] : model_.domains())
  {
    const Energies e = energies_of(*domain);
    mpm::check_growth(*domain, e);
    const double left = residual(e), bound = closing_bound(e, domain->energy);
    if (std::fabs(left) <= bound || std::count(warned_.begin(), warned_.end(), part)) continue;
    warned_.push_back(part);
    session_.log.warn(
        "{}: the energy balance does not close: {:.3g} J/m are left at t = {:.3f} s, more than the "
        "{:.3g} J/m that the time step explains; the largest term is {:.3g} J/m. Look at "
        "{}, and try a smaller {} or grid.spacing",
        domain->name, left, time, bound, largest_term(e),
        session_.options.seismic() ? "/energy of history.h5" : "energy in summary.json",
        session_.options.courant_key());
  }
}

void EnergyWatch::report() const
{
  const Energies e = energies_of(*model_.main);
  std::string text;
  for (std::size_t k = 0; k < energy_terms.size(); ++k)
    if (e.value[k] != 0) text += fmt::format("{} {:.4g}, ", energy_terms[k].name, e.value[k]);
  const double largest = largest_term(e);
  session_.log.info("energy in J/m: {}residual {:.2g} ({:.2g} % of the largest term)", text, residual(e),
                    largest > 0 ? 100 * std::fabs(residual(e)) / largest : 0);
}

nlohmann::json EnergyWatch::summary() const
{
  nlohmann::json result;
  for (const auto& [part, domain] : model_.domains())
  {
    const Energies e = energies_of(*domain);
    nlohmann::json terms;
    for (std::size_t k = 0; k < energy_terms.size(); ++k)
      terms[std::string(energy_terms[k].name)] = e.value[k];
    terms["residual"] = residual(e);
    if (is_column(part))
      result[std::string(side_name(part)) + "_column"] = terms;
    else
      result.update(terms);
  }
  return result;
}
} // namespace mpm
