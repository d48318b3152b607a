#include "solver/stages/offers.hpp"

#include "io/case/profiles.hpp"
#include "io/case/size.hpp"
#include "io/common/memory.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/stages/expected_error.hpp"
#include "solver/stages/fidelity.hpp"
#include "solver/stages/occasions.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
constexpr const char* columns = "{:<12} {:>9} {:>11} {:>8} {:>10} {:>12} {:>8} {:>6} {:>8}";

/// A number with blanks between thousands.
std::string counted(double value)
{
  std::string text = fmt::format("{:.0f}", value);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), " ");
  return text;
}

/// Cost of a particle and step beside that of the default method with 2 x 2 particles a cell, on one thread:
/// more particles share a cell's work, and the paper's method has no filters and no second pass.
double relative_cost(const Case& case_file, bool seismic)
{
  const double per_cell = case_file.grid.particles_per_cell;
  const double nodes = 1 + 1.6 / (per_cell * per_cell);
  const bool lean = !seismic || case_file.seismic.transfer == Transfer::apic;
  return nodes * (lean ? 0.77 : 1);
}

/// The step of other settings, from that of the chosen ones: it goes with the cells and the Courant number.
double step_of_other(const Session& session, const Case& other, double dt)
{
  const Case& own = session.case_file;
  const bool seismic = session.options.seismic();
  const double courant = seismic ? other.courant_number / own.courant_number
                                 : other.static_stage.courant_number / own.static_stage.courant_number;
  const double step = dt * courant * other.grid.spacing / own.grid.spacing;
  return seismic ? other.output.gauges.every / std::ceil(other.output.gauges.every / step * (1 - 1e-9))
                 : step;
}

/// How long the stage takes with other cells, s of model time: what the static stage takes after its ramp
/// goes with the cells, see expected_settling().
double duration_of_other(const Session& session, const Case& other, double duration)
{
  if (session.options.seismic()) return duration;
  const double after = duration - session.case_file.static_stage.ramp;
  return other.static_stage.ramp + after * other.grid.spacing / session.case_file.grid.spacing;
}

/// Frequency to which S waves are carried in the softest ground, Hz.
double carried(const Case& case_file, double dt)
{
  const Resolution r = resolution_of(case_file, dt);
  const double speed = scales_of(case_file).softest;
  return std::min(phase_limit(r, speed, 0.01), damping_limit(r, speed, 0.01));
}

/// Settings, what they cost and what errors they are likely to make.
struct Offer
{
  std::string name;
  double spacing, particles, memory;
  std::int64_t steps;
  double seconds;
  double carried = NAN;               ///< Hz, of S waves in the softest ground
  ExpectedError waves{NAN, "motion"}; ///< of a stage that has one
  ExpectedError run_out;
};

Offer offer_of(const Session& session, const std::string& name, const Case& other, const Chosen& chosen)
{
  const bool seismic = session.options.seismic(), own = &other == &session.case_file;
  CaseSize size = expected_size(other);
  if (own) size.particles = chosen.particles;
  const double dt = own ? chosen.dt : step_of_other(session, other, chosen.dt);
  const double each = own ? 1 : relative_cost(other, seismic) / relative_cost(session.case_file, seismic);
  const double times = each * size.particles / chosen.particles;
  const Occasions all =
      occasions_of(other, chosen.wave, dt, duration_of_other(session, other, chosen.duration));
  Offer offer{name, other.grid.spacing, size.particles, memory_needed(size, other), all.steps, 0};
  offer.seconds = chosen.before * size.particles / chosen.particles +
                  stage_time(all, chosen.step.undisturbed() * times,
                             chosen.step.processor * times * parallel::threads(), size.particles);
  if (seismic) offer.carried = carried(other, dt);
  if (chosen.wave) offer.waves = expected_wave_error(other, dt, *chosen.wave);
  offer.run_out = expected_run_out_error(other);
  return offer;
}

std::string frequency_text(double hertz)
{
  return hertz < 10 ? fmt::format("{:.2g} Hz", hertz) : fmt::format("{:.0f} Hz", hertz);
}

void log_row(Session& session, const Offer& offer, bool with_waves)
{
  session.log.info(columns, offer.name, fmt::format("{:.4g} m", offer.spacing), counted(offer.particles),
                   bytes_text(offer.memory), counted(static_cast<double>(offer.steps)),
                   time_text(offer.seconds), std::isnan(offer.carried) ? "" : frequency_text(offer.carried),
                   with_waves ? offer.waves.letter() : ' ', offer.run_out.letter());
}

std::string share_text(const ExpectedError& error)
{
  return error.unknown.empty() ? fmt::format("{:.2g} %", 100 * error.share)
                               : fmt::format("not known: {}", error.unknown);
}
} // namespace

void report_offers(Session& session, const Chosen& chosen)
{
  const bool with_waves = chosen.wave != nullptr;
  const Case& own = session.case_file;
  session.log.info(columns, "", "cells", "particles", "memory", "steps", "time", "S to",
                   with_waves ? "waves" : "", "run-out");
  const Offer first = offer_of(session, own.profile.empty() ? "as it is" : own.profile + " *", own, chosen);
  log_row(session, first, with_waves);
  std::vector<std::string> overrides = own.overrides;
  std::erase_if(overrides, [](const std::string& text) { return text.starts_with("grid.spacing="); });
  for (const StandardProfile& profile : standard_profiles)
  {
    const std::string name(profile.name);
    if (name == own.profile) continue;
    try
    {
      Case other = load_case(own.path, overrides, name);
      other.seismic.duration = own.seismic.duration; // that goes with the record
      log_row(session, offer_of(session, name, other, chosen), with_waves);
    }
    catch (const Error& error)
    {
      const std::string why = error.what();
      session.log.info("{:<12} cannot be had: {}", name, why.substr(0, why.find('\n')));
    }
  }
  if (chosen.step.disturbed()) session.log.info("times: without what else this machine does now");
  session.log.info(
      "errors: A below {:g} %, B below {:g} %, C below {:g} %, D more, ? not known; in the first row {}"
      "run-out {}",
      100 * error_classes[0], 100 * error_classes[1], 100 * error_classes[2],
      with_waves ? "waves " + share_text(first.waves) + ", " : "", share_text(first.run_out));
}
} // namespace mpm
