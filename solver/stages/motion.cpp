#include "solver/stages/motion.hpp"

#include "built_in.hpp"
#include "io/records/reader.hpp"
#include "io/results/history.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace mpm
{
namespace
{
constexpr double most_samples = 2e7; // of /motion, 800 MB
// Of the Arias intensity, pi/2g times the integral of a^2: as much lies outside the significant duration
// D5-95 at either end, so that a run which leaves out more cuts into the strong shaking.
constexpr double much = 0.05;

/// The program's own synthetic motion is kept as text in PEER's format, and read as any other.
Record read(const MotionSource& source)
{
  if (source.built_in()) return parse_record(built_in_motion, {.file = "built_in.AT2", .format = "peer"});
  return read_record(source.record);
}

std::string_view si_unit_of(Quantity quantity)
{
  if (quantity == Quantity::acceleration) return "m/s2";
  return quantity == Quantity::velocity ? "m/s" : "m";
}

/// Tells motions apart by what is made of them: the samples in SI units, scaled, and their processing. The
/// same motion from a file of another name, format or unit is then the same run, and another scale is
/// another.
std::string identity_of(const Record& record, const MotionProcessing& processing)
{
  std::vector<double> samples{record.dt};
  double greatest = 0;
  for (const double value : record.values)
  {
    samples.push_back(processing.scale * value);
    greatest = std::max(greatest, std::abs(samples.back()));
  }
  const std::string_view bytes(reinterpret_cast<const char*>(samples.data()),
                               samples.size() * sizeof(double));
  return fmt::format(
      "{} samples of {} s, {} up to {:.6g} {}, sha256 {}, {}, baseline {}, high_pass {} Hz, taper {} s",
      record.values.size(), record.dt, name_of(record.quantity), greatest, si_unit_of(record.quantity),
      sha256(bytes), name_of(processing.recorded_as), name_of(processing.baseline), processing.high_pass,
      taper_of(processing));
}

nlohmann::json json_of(const MotionMeasures& m)
{
  return {{"pga", m.pga},
          {"pga_time", m.pga_time},
          {"pgv", m.pgv},
          {"pgd", m.pgd},
          {"arias", m.arias},
          {"d5_95", m.d5_95},
          {"final_velocity", m.final_velocity},
          {"final_displacement", m.final_displacement}};
}

/// By which share a measure changed; null where there was none.
nlohmann::json change(double before, double after)
{
  return before > 0 ? nlohmann::json(after / before - 1) : nlohmann::json();
}

/// What summary.json tells of a component: the record, and what its correction changed. Measures are of the
/// kind of the record, before the halving of an outcrop, so that they can be compared with a catalogue's.
nlohmann::json facts_of(const Record& record, const MotionProcessing& processing, const MotionReport& report)
{
  const MotionMeasures &before = report.recorded, &after = report.corrected;
  const SpectralChange& spectrum = report.spectrum;
  return {{"source", record.source},
          {"component", record.component},
          {"unit", record.unit},
          {"quantity", name_of(record.quantity)},
          {"samples", record.values.size()},
          {"dt", record.dt},
          {"duration", record.dt * double(record.values.size() - 1)},
          {"scale", processing.scale},
          {"recorded_as", name_of(processing.recorded_as)},
          {"recorded", json_of(before)},
          {"corrected", json_of(after)},
          {"correction",
           {{"baseline", name_of(processing.baseline)},
            {"high_pass", processing.high_pass},
            {"taper", taper_of(processing)},
            {"pgv_change", change(before.pgv, after.pgv)},
            {"pgd_change", change(before.pgd, after.pgd)},
            {"arias_change", change(before.arias, after.arias)},
            {"spectrum_mean_change", spectrum.mean},
            {"spectrum_greatest_change", spectrum.greatest},
            {"spectrum_greatest_change_period", spectrum.period}}}};
}

/// The measures that an engineer looks at first, in one line.
std::string words(const MotionMeasures& m)
{
  return fmt::format(
      "PGA {:#.3g} g at {:.2f} s, PGV {:#.3g} m/s, PGD {:#.3g} m, Arias {:#.3g} m/s, D5-95 {:.1f} s",
      m.pga / standard_gravity, m.pga_time, m.pgv, m.pgd, m.arias, m.d5_95);
}

/// What baseline, filter and taper changed: they are to take drift away and to leave the shaking alone.
void report_correction(Session& session, const std::string& component, const MotionProcessing& processing,
                       const MotionReport& r)
{
  const MotionMeasures &before = r.recorded, &after = r.corrected;
  if (processing.baseline == Baseline::none && processing.high_pass == 0 && taper_of(processing) == 0)
    return session.log.info(
        "{} motion: not corrected; residual velocity {:.2e} m/s, residual displacement {:.2e} m", component,
        before.final_velocity, before.final_displacement);
  session.log.info(
      "{} motion: the correction changed PGV {:#.3g} -> {:#.3g} m/s, PGD {:#.3g} -> {:#.3g} m, Arias "
      "{:#.3g} -> {:#.3g} m/s, the 5 % spectrum by {:.2g} % on average and at most {:.2g} % (at {:.2g} s)",
      component, before.pgv, after.pgv, before.pgd, after.pgd, before.arias, after.arias,
      100 * r.spectrum.mean, 100 * r.spectrum.greatest, r.spectrum.period);
  session.log.info(
      "{} motion: residual velocity {:.2e} -> {:.2e} m/s, residual displacement {:.2e} -> {:.2e} m",
      component, before.final_velocity, after.final_velocity, before.final_displacement,
      after.final_displacement);
}

/// What the run is going to apply, and what it leaves out; notes the share that it leaves out.
void report_applied(Session& session, const std::string& component, const GroundMotion& motion,
                    nlohmann::json& facts)
{
  const double duration = session.case_file.seismic.duration;
  const Fade fade = planned_fade(session.case_file.seismic.motion);
  const MotionMeasures whole = measures_applied(motion, fade, motion.duration()),
                       applied = measures_applied(motion, fade, duration);
  const std::string source = facts["source"].get<std::string>();
  session.log.info("{} motion {} ({}) as applied until {:g} s{}: {}", component, source,
                   facts["recorded_as"].get<std::string>(), duration,
                   session.case_file.seismic.motion.end == MotionEnd::self_driven ? " if it goes on so long"
                                                                                  : "",
                   words(applied));
  const double beyond = whole.arias > 0 ? 1 - applied.arias / whole.arias : 0;
  facts["arias_share_beyond_end"] = beyond;
  if (beyond <= much) return;
  session.log.warn(
      "{} motion {}: {:.0f} % of its Arias intensity lie beyond the end of the run at {:g} s, more "
      "than {:.0f} %, and are not applied: PGA is {:#.3g} g of {:#.3g} g at {:.2f} s; set "
      "seismic.duration to 'record + 10 s' (the record has {:.1f} s), or cut the record",
      component, source, 100 * beyond, duration, 100 * much, applied.pga / standard_gravity,
      whole.pga / standard_gravity, whole.pga_time, motion.duration());
}

/// Reads one component, from the command line (`replacement`) or the case (`source`), and makes the wave of
/// it; notes facts, identity and title in `motion`. Empty: there is none.
std::optional<GroundMotion> load(Session& session, const std::string& component,
                                 std::optional<MotionSource> source, const std::string& replacement,
                                 Motion& motion)
{
  const Options& options = session.options;
  if (!replacement.empty())
  {
    source = MotionSource{};
    const std::string& part = component == "vertical" ? options.vertical_component : options.record_component;
    const std::string format = options.record_format.empty() ? "auto" : options.record_format;
    source->record = {replacement, format, options.record_dt, options.record_unit, std::nullopt, "", part};
  }
  if (!source) return std::nullopt;
  MotionProcessing processing = session.case_file.seismic.motion.processing;
  processing.scale = source->scale * options.scale;
  const Record record = read(*source);
  GroundMotion result;
  try
  {
    result = make_ground_motion(record, processing);
  }
  catch (const std::runtime_error& error) // a setting that does not fit the record
  {
    throw Error(exit_code::bad_input, error.what());
  }
  if (!record.component.empty())
    session.log.info("{} motion: component {} of {}", component, record.component, record.source);
  for (const std::string& note : record.notes) session.log.detail("{}", note);
  for (const std::string& warning : record.warnings) session.log.warn("{}", warning);
  report_correction(session, component, processing, result.report);
  for (const std::string& warning : result.report.warnings) session.log.warn("{}", warning);
  motion.facts[component] = facts_of(record, processing, result.report);
  motion.identity.push_back({"motion." + component, identity_of(record, processing)});
  const std::string name =
      source->built_in() ? "built_in" : std::filesystem::path(record.source).stem().string();
  motion.title += (motion.title.empty() ? "" : " + ") + name;
  return result;
}

/// Whether anything about a motion was given, by the case or on the command line.
bool motion_given(const Session& session)
{
  const Options& options = session.options;
  return !options.motion.empty() || !options.vertical.empty() || options.scale != 1 ||
         session.case_file.seismic.motion.given;
}

/// Refuses a record whose step is so small that a run cannot hold what it applies.
void check_samples(const Session& session, const IncomingWave& wave)
{
  const double step = common_step(wave), duration = session.case_file.seismic.duration;
  if (step == 0 || duration / step < most_samples) return;
  throw Error(
      exit_code::bad_input,
      fmt::format(
          "seismic.duration: {:g} s in steps of {:g} s, which the records ask for, are more samples than "
          "{:g}; mend the time step or the duration, or resample them",
          duration, step, most_samples));
}

/// Whether two motions are one record, however scaled.
bool are_one(const GroundMotion& a, const GroundMotion& b)
{
  if (a.dt != b.dt || a.acceleration.size() != b.acceleration.size()) return false;
  const auto product = [](const GroundMotion& p, const GroundMotion& q)
  { return std::inner_product(p.acceleration.begin(), p.acceleration.end(), q.acceleration.begin(), 0.0); };
  const double shared = product(a, b);
  constexpr double rounding = 1e-9;
  return shared != 0 && shared * shared >= (1 - rounding) * product(a, a) * product(b, b);
}

/// `seismic.duration: record + 10 s`: the run's length is known when the records are.
void settle_duration(Session& session, const IncomingWave& wave)
{
  SeismicSettings& seismic = session.case_file.seismic;
  if (std::isnan(seismic.after_record)) return;
  seismic.duration = wave.records_end() + seismic.after_record;
  session.log.info("seismic.duration: {:g} s of record and {:g} s after it, {:g} s", wave.records_end(),
                   seismic.after_record, seismic.duration);
}
} // namespace

nlohmann::json Motion::summary(double until) const
{
  nlohmann::json result = facts;
  for (const auto& [component, motion] :
       {std::pair{"horizontal", &wave->horizontal}, std::pair{"vertical", &wave->vertical}})
    if (*motion) result[component]["applied"] = json_of(measures_applied(**motion, wave->fade, until));
  return result;
}

void report_what_was_applied(Session& session, const Motion& motion, double until)
{
  const IncomingWave& wave = *motion.wave;
  for (const auto& [component, part] :
       {std::pair{"horizontal", &wave.horizontal}, std::pair{"vertical", &wave.vertical}})
    if (*part)
      session.log.info("{} motion as applied: {}", component,
                       words(measures_applied(**part, wave.fade, until)));
}

/// In this order: records are read and corrected, the run's length may follow from them, and what is applied
/// until then is reported.
Motion load_motion(Session& session)
{
  const SeismicSettings& seismic = session.case_file.seismic;
  const MotionSettings& settings = seismic.motion;
  const Options& options = session.options;
  Motion motion;
  motion.facts = nlohmann::json::object();
  motion.wave = std::make_shared<IncomingWave>();
  IncomingWave& wave = *motion.wave;
  if (seismic.base == BaseKind::fixed)
  {
    if (motion_given(session))
      session.log.warn("seismic.base: a fixed base takes no motion: what is given of one is not applied");
  }
  else
  {
    wave.horizontal = load(session, "horizontal", settings.horizontal, options.motion, motion);
    wave.vertical = load(session, "vertical", settings.vertical, options.vertical, motion);
    if (wave.horizontal && wave.vertical && are_one(*wave.horizontal, *wave.vertical))
      session.log.warn("motion: horizontal and vertical are the same record: the ground is shaken along one "
                       "line; is the vertical one another component's?");
    wave.fade = planned_fade(settings);
    settle_duration(session, wave);
    check_samples(session, wave);
    if (settings.end == MotionEnd::time && settings.end_time > seismic.duration)
      session.log.warn(
          "seismic.motion.end: {:g} s is after the end of the run at {:g} s: the motion is not ended, "
          "but cut there",
          settings.end_time, seismic.duration);
    if (options.scale != 1) motion.title += fmt::format(" x {}", options.scale);
  }
  if (wave.horizontal) report_applied(session, "horizontal", *wave.horizontal, motion.facts["horizontal"]);
  if (wave.vertical) report_applied(session, "vertical", *wave.vertical, motion.facts["vertical"]);
  return motion;
}

// `end: 12 s` means that nothing comes any more at 12 s.
Fade planned_fade(const MotionSettings& settings)
{
  return settings.end == MotionEnd::time ? Fade{settings.end_time - Fade::length} : Fade{};
}

// Samples are those of the upgoing wave; 1 / share makes them the record's kind again, twice that of an
// outcrop.
MotionMeasures measures_applied(const GroundMotion& motion, const Fade& fade, double until)
{
  const GroundMotion samples =
      sampled(motion, fade, motion.straight_step(), std::min(until, motion.duration()));
  return measure(samples.velocity, samples.acceleration, samples.dt, 1 / motion.report.share);
}

/// The step is one at which acceleration may be taken as straight between samples, so that a reader can
/// integrate it to the velocities beside it.
void write_motion(h5::File& file, const IncomingWave& wave, double step, double until)
{
  if (const double common = common_step(wave); common > 0) step = common;
  std::array<GroundMotion, 2> parts;
  for (int k = 0; k < 2; ++k)
    if (const auto& motion = k == 0 ? wave.horizontal : wave.vertical)
      parts[k] = sampled(*motion, wave.fade, step, until);
  History history;
  const Axis component{"component", {"x", "y"}};
  const History::Series velocity = history.add_series("motion/upgoing_velocity", "m/s", {component}),
                        acceleration = history.add_series("motion/upgoing_acceleration", "m/s2", {component});
  const std::size_t rows = sample_count(step, until);
  for (std::size_t i = 0; i < rows; ++i)
  {
    const auto at = [i](const std::vector<double>& series) { return series.empty() ? 0 : series[i]; };
    history.start_row(step * double(i));
    history.record(velocity, std::array{at(parts[0].velocity), at(parts[1].velocity)});
    history.record(acceleration, std::array{at(parts[0].acceleration), at(parts[1].acceleration)});
  }
  history.save(file);
  if (const auto& motion = wave.horizontal ? wave.horizontal : wave.vertical)
    file.attribute("recorded_as",
                   name_of(motion->report.share < 1 ? RecordedAs::outcrop : RecordedAs::upgoing), "motion");
}
} // namespace mpm
