#include "solver/stages/energy_watch.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
// What may be left of a energy balance that is kept well:
// Of what the transfers take, the stress does work on during half a step: dt/2 f . dv, at most omega dt / 2
// of it, and the fastest motion of the grid has omega of about c_p/h, so C/2 with C the Courant number, 1/4
// as a rule. Of a wave's energy (omega dt)^2 is left at the ends of the energy balance: 1.5 % at the 26 cells
// a wavelength of C = 0.5 that waves need anyway; the elastic energy of a hypoelastic law is known to a third
// of the elastic strain, 0.1 %.
constexpr double transfer_share = 0.25, share = 0.02;
// An energy of a millionth of what gravity has stored in the ground is none.
constexpr double negligible = 1e-6;
constexpr double growth_share = 0.1;

double negligible_energy(const EnergyBalance& ledger)
{
  return negligible * ledger.elastic;
}
} // namespace

double closing_bound(const Energies& balance, const EnergyBalance& ledger)
{
  return share * largest_term(balance) + transfer_share * std::fabs(balance[Energy::transfer]) +
         negligible_energy(ledger);
}

void check_growth(const Domain& domain, const Energies& e)
{
  const double grown = unexplained_growth(e);
  const double settled = std::fabs(e[Energy::gravitational] - e[Energy::reaction]);
  const double sources =
      std::max({domain.energy.kinetic, e[Energy::incoming], std::fabs(e[Energy::free_field]), settled});
  if (!(grown > growth_share * sources + negligible_energy(domain.energy))) return;
  throw Diverged(fmt::format("{}: the energy has grown by {:.3g} J/m without a source by t = {:.3f} s, where "
                             "{:.3g} J/m were there or came in",
                             domain.name, grown, domain.time, sources));
}

void EnergyWatch::open()
{
  model_.for_each_domain([](Domain& domain, const std::string&) { open_energy_balance(domain); });
}

void EnergyWatch::check(double time)
{
  model_.for_each_domain(
      [&](Domain& domain, const std::string&)
      {
        const Energies e = energies_of(domain);
        check_growth(domain, e);
        const double left = residual(e), bound = closing_bound(e, domain.energy);
        if (std::fabs(left) <= bound || std::count(warned_.begin(), warned_.end(), domain.name)) return;
        warned_.push_back(domain.name);
        session_.log.warn(
            "{}: the energy balance does not close: {:.3g} J/m are left at t = {:.3f} s, more than the "
            "{:.3g} J/m that the time step explains; the largest term is {:.3g} J/m. Look at "
            "{}, and try a smaller {} or grid.spacing",
            domain.name, left, time, bound, largest_term(e),
            session_.options.seismic() ? "/energy of history.h5" : "energy in summary.json",
            session_.options.safety_key());
      });
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
  model_.for_each_domain(
      [&](Domain& domain, const std::string& column)
      {
        const Energies e = energies_of(domain);
        nlohmann::json terms;
        for (std::size_t k = 0; k < energy_terms.size(); ++k)
          terms[std::string(energy_terms[k].name)] = e.value[k];
        terms["residual"] = residual(e);
        if (column.empty())
          result.update(terms);
        else
          result[column + "_column"] = terms;
      });
  return result;
}
} // namespace mpm
