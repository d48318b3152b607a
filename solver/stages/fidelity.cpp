#include "solver/stages/fidelity.hpp"

#include "boundaries/ground_motion/spectrum.hpp"
#include "solver/stages/motion.hpp"

#include <algorithm>

namespace mpm
{
namespace
{
constexpr double tolerance = 0.01; // of the speed, and as damping ratio
constexpr double much = 0.10;      // of the Arias intensity: the scatter that engineers accept in it

/// A kind of wave and the component of the motion that sends it up.
struct Kind
{
  const char* name;
  const char* component;
  double (Elastic::*speed)() const;
  std::optional<GroundMotion> IncomingWave::*motion;
};
constexpr std::array kinds{Kind{"S", "horizontal", &Elastic::shear_speed, &IncomingWave::horizontal},
                           Kind{"P", "vertical", &Elastic::pressure_speed, &IncomingWave::vertical}};

/// Sets what the grid carries beside what the motion brings, for one kind of wave in one material.
void report_share(Session& session, const Material& material, const Kind& kind, double limit,
                  const MotionSpectrum& spectrum, nlohmann::json& facts)
{
  const double share = spectrum.share_above(limit);
  facts["arias_share_above"] = share;
  if (share <= much)
    return session.log.info("{}: {:.2g} % of the {} motion's Arias intensity lies above that", material.name,
                            100 * share, kind.component);
  // Both limits go with 1 / h as long as the Courant number stays.
  const double fine = session.case_file.grid.spacing * limit / spectrum.frequency_with_above(much);
  session.log.warn(
      "{}: {:.0f} % of the {} motion's Arias intensity lies above {:.1f} Hz, more than {:.0f} %: the "
      "grid delays and damps these {} waves; cells of {:.2g} m would carry all but {:.0f} %",
      material.name, 100 * share, kind.component, limit, 100 * much, kind.name, fine, 100 * much);
}
} // namespace

Resolution resolution_of(const Case& case_file, double dt)
{
  const SeismicSettings& seismic = case_file.seismic;
  return {case_file.grid.spacing, dt, seismic.transfer == Transfer::flip, seismic.filter.time,
          seismic.inertia == Inertia::consistent};
}

void report_wave_fidelity(Session& session, double dt, const IncomingWave* wave)
{
  const SeismicSettings& seismic = session.case_file.seismic;
  const Resolution resolution{session.case_file.grid.spacing, dt, wave && seismic.transfer == Transfer::flip,
                              seismic.filter.time, wave && seismic.inertia == Inertia::consistent};
  const GridSettings& grid = session.case_file.grid;
  nlohmann::json& facts = session.facts["resolution"];
  facts = {{"spacing", grid.spacing}, {"particles_per_cell", grid.particles_per_cell}};
  std::array<std::optional<MotionSpectrum>, kinds.size()> spectra;
  for (std::size_t k = 0; wave && k < kinds.size(); ++k)
    if (const auto& motion = wave->*kinds[k].motion)
      spectra[k].emplace(sampled(*motion, planned_fade(seismic.motion), motion->dt,
                                 std::min(seismic.duration, motion->duration())));
  for (const Material& material : session.case_file.materials)
  {
    const Elastic& e = material.elastic();
    session.log.info("{}: density {} kg/m3, c_s {:.1f} m/s, c_p {:.1f} m/s", material.name, e.density,
                     e.shear_speed(), e.pressure_speed());
    if (const std::string note = std::visit([](const auto& law) { return law.note(); }, material.law);
        !note.empty())
      session.log.info("{}: {}", material.name, note);
    for (std::size_t k = 0; k < kinds.size(); ++k)
    {
      const double speed = (e.*kinds[k].speed)();
      const double phase = phase_limit(resolution, speed, tolerance),
                   damping = damping_limit(resolution, speed, tolerance), limit = std::min(phase, damping);
      session.log.info(
          "{}: {} waves within {:.0f} % of their speed to {:.1f} Hz, less than {:.0f} % numerical "
          "damping to {:.1f} Hz: carried to {:.1f} Hz",
          material.name, kinds[k].name, 100 * tolerance, phase, 100 * tolerance, damping, limit);
      nlohmann::json& found = facts["materials"][material.name][kinds[k].name];
      found = {{"speed", speed}, {"phase_limit", phase}, {"damping_limit", damping}, {"carried_to", limit}};
      if (spectra[k]) report_share(session, material, kinds[k], limit, *spectra[k], found);
    }
  }
  if (wave && seismic.transfer == Transfer::apic && session.case_file.courant_number < usual_courant_number)
    session.log.warn("time_step.courant_number: {} is below {}: waves lose the same in every step, so that "
                     "numerical damping "
                     "is {:.2g} times that of {}; a smaller step is not a more accurate one (map courant of "
                     "cases/verification/ATLAS.md)",
                     session.case_file.courant_number, usual_courant_number,
                     usual_courant_number / session.case_file.courant_number, usual_courant_number);
}
} // namespace mpm
