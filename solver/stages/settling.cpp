#include "solver/stages/settling.hpp"

#include "io/case/profiles.hpp"
#include "solver/stages/relaxation.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
constexpr double few = 3000;             // particles of the finer grid
constexpr double ratio = 1.75;           // of the coarser cells to the finer: a third of the particles
constexpr std::int64_t patience = 20000; // steps, some seconds
constexpr double fewest = 8;             // cells between the sides, whose walls must not meet

/// Cell size with which there are few particles, and every layer still has some, m.
double coarse_spacing(const Case& case_file, double particles)
{
  const double h = case_file.grid.spacing, layer = scales_of(case_file).layer.value;
  return std::max(h, std::min({h * std::sqrt(particles / few), layer, case_file.domain.width() / fewest}));
}

/// The two phases of the static stage of the case on other cells; empty: it does not settle on them.
std::optional<Relaxation::Ends> ends_on(const Session& session, double spacing)
{
  Options options = session.options;
  options.verbosity = Verbosity::silent;
  options.overrides.push_back(fmt::format("grid.spacing={:.15g} m", spacing));
  try
  {
    Session tried(options);
    Clock clock;
    Model model = make_static_model(tried.case_file, clock);
    Relaxation relaxation(tried, model);
    const std::int64_t most = steps_in(tried.case_file.static_stage.until.at_most, clock.dt);
    return relaxation.settle(clock, std::min(most, patience));
  }
  catch (const Error&)
  {
    return {}; // a grid as coarse as that does not suit the case
  }
}

/// The nearest cell size of which a whole number lies between the sides, m.
double whole(const Case& case_file, double spacing)
{
  const double width = case_file.domain.width();
  return width / std::max(1.0, std::round(width / spacing));
}
} // namespace

double time_to_fade(double damping, double period, double share)
{
  const double swing = period / 4 * (1 / std::sqrt(1 - damping) + 1 / std::sqrt(1 + damping));
  return swing * std::log(share) / std::log(std::sqrt((1 - damping) / (1 + damping)));
}

double carried_over(Tried coarse, Tried finer, double spacing)
{
  const double power =
      std::clamp(std::log(coarse.time / finer.time) / std::log(coarse.spacing / finer.spacing), 0.0, 1.0);
  return finer.time * std::pow(spacing / finer.spacing, power);
}

Settling expected_settling(const Session& session, double particles)
{
  const Case& case_file = session.case_file;
  const double h = case_file.grid.spacing, ramp = case_file.static_stage.ramp,
               finer = whole(case_file, coarse_spacing(case_file, particles)),
               coarse = whole(case_file, ratio * finer);
  const auto found = ends_on(session, finer);
  if (!found) return {.spacing = finer};
  if (finer <= h * (1 + 1e-9)) return {found->all, true, finer};
  const double at_rest = found->elastic - ramp, yielding = found->all - found->elastic;
  // Without the coarser one all of it is taken for the grid's.
  const auto before = ends_on(session, coarse);
  const double elastic = before && at_rest > 0 && before->elastic > ramp
                             ? carried_over({coarse, before->elastic - ramp}, {finer, at_rest}, h)
                             : at_rest * h / finer;
  const double plastic = yielding * h / finer;
  return {ramp + elastic + plastic, true, finer};
}
} // namespace mpm
