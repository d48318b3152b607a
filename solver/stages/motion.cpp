#include "solver/stages/motion.hpp"

#include "built_in.hpp"
#include "io/record_reader.hpp"

#include <cmath>

namespace mpm
{
namespace
{
struct Source
{
  Record record;
  std::string digest;
};

Source read(const MotionSource& source)
{
  if (source.built_in())
    return {parse_record(built_in_motion, {.file = "built_in.AT2", .format = "peer"}),
            sha256(built_in_motion)};
  return {read_record(source.record), sha256_file(source.record.file)};
}

void report(Session& session, const std::string& component, const Record& record, const GroundMotion& motion)
{
  const MotionReport& r = motion.report;
  session.log.info("{} motion {}: PGA {:.3f} g at {:.2f} s, PGV {:.3f} m/s, PGD {:.3f} m, Arias {:.2f} m/s, "
                   "D5-95 {:.1f} s",
                   component, record.source, r.pga / standard_gravity, r.pga_time, r.pgv, r.pgd, r.arias,
                   r.d5_95);
  session.log.info(
      "{} motion: residual velocity {:.2e} -> {:.2e} m/s, residual displacement {:.2e} -> {:.2e} m",
      component, r.raw_residual_velocity, r.residual_velocity, r.raw_residual_displacement,
      r.residual_displacement);
  if (!record.component.empty())
    session.log.info("{} motion: component {} of {}", component, record.component, record.source);
  for (const std::string& note : record.notes) session.log.detail("{}", note);
  for (const std::string& warning : record.warnings) session.log.warn("{}", warning);
  for (const std::string& warning : r.warnings) session.log.warn("{}", warning);
}

/// What the user told of a record, for the identity of the run: the same file in another unit is another
/// motion.
std::string told_of(const RecordSource& source)
{
  return (source.unit.empty() ? "" : ", unit " + source.unit) +
         (source.component.empty() ? "" : ", component " + source.component);
}

std::optional<GroundMotion> load(Session& session, const std::string& component,
                                 std::optional<MotionSource> source, const std::string& replacement,
                                 Motion& motion)
{
  const Options& options = session.options;
  if (!replacement.empty())
  {
    source = MotionSource{};
    const std::string& part = component == "vertical" ? options.vertical_component : options.record_component;
    source->record = {replacement, "auto", options.record_dt, options.record_unit, std::nullopt, "", part};
  }
  if (!source) return std::nullopt;
  const MotionSettings& settings = session.scene.seismic.motion;
  MotionProcessing processing = settings.processing;
  processing.scale = source->scale * options.scale;
  const Source read_source = read(*source);
  const Record& record = read_source.record;
  GroundMotion result;
  try
  {
    result = make_ground_motion(record, processing);
  }
  catch (const std::runtime_error& error)
  {
    throw Error(exit_code::bad_input, error.what());
  }
  report(session, component, record, result);
  motion.identity.push_back(
      {"motion." + component,
       fmt::format("sha256 {}, dt {} s, scale {}{}", read_source.digest, record.dt, processing.scale,
                   replacement.empty() ? "" : told_of(source->record))});
  const std::string name =
      source->built_in() ? "built_in" : std::filesystem::path(record.source).stem().string();
  motion.title += (motion.title.empty() ? "" : " + ") + name;
  return result;
}
} // namespace

Motion load_motion(Session& session)
{
  const MotionSettings& settings = session.scene.seismic.motion;
  Motion motion;
  motion.wave = std::make_shared<IncomingWave>();
  motion.wave->horizontal = load(session, "horizontal", settings.horizontal, session.options.motion, motion);
  motion.wave->vertical = load(session, "vertical", settings.vertical, session.options.vertical, motion);
  if (settings.end == MotionEnd::time) motion.wave->fade.start = settings.end_time - Fade::length;
  if (session.options.scale != 1) motion.title += fmt::format(" x {}", session.options.scale);
  return motion;
}
} // namespace mpm
