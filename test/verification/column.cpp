#include "test/verification/column.hpp"

#include "io/case/units.hpp"

#include <cmath>
#include <numbers>

namespace mpm::verification
{
Case case_at(const std::filesystem::path& folder, double spacing)
{
  return load_case(folder / "case.yaml", {"grid.spacing=" + number_text(spacing) + " m"});
}

std::shared_ptr<IncomingWave> wave_of(const Case& case_file)
{
  const MotionSettings& settings = case_file.seismic.motion;
  const auto load = [&](const std::optional<MotionSource>& source) -> std::optional<GroundMotion>
  {
    if (!source) return std::nullopt;
    MotionProcessing processing = settings.processing;
    processing.scale = source->scale;
    return make_ground_motion(read_record(source->record), processing);
  };
  auto wave = std::make_shared<IncomingWave>();
  wave->horizontal = load(settings.horizontal);
  wave->vertical = load(settings.vertical);
  return wave;
}

Trace shake_column(const Case& case_file, std::shared_ptr<const IncomingWave> wave, double every)
{
  Model model = make_model(case_file);
  add_seismic_boundaries(model, case_file, wave, false);
  FreeFieldColumn& column = *model.left;
  // A gauge on the ground surface; the outermost particle sits half a particle distance below it.
  column.domain->gauges.push_back({0.5 * case_file.grid.spacing, case_file.ground_height(0), 0, 0, 0, 0});
  const double dt = step_dividing(every, case_file.courant_number, *column.domain);
  const long stride = std::lround(every / dt), samples = std::lround(case_file.seismic.duration / every);
  Trace trace;
  trace.every = every;
  for (long k = 0; k < samples * stride; ++k)
  {
    column.advance(k * dt, dt);
    if ((k + 1) % stride != 0) continue;
    trace.x.push_back(column.domain->gauges[0].velocity_x);
    trace.y.push_back(column.domain->gauges[0].velocity_y);
  }
  return trace;
}

std::complex<double> transform(const std::vector<double>& samples, double every, double start,
                               double frequency)
{
  std::complex<double> sum = 0;
  for (std::size_t k = 0; k < samples.size(); ++k)
    sum += samples[k] *
           std::exp(std::complex<double>(0, -2 * std::numbers::pi * frequency * (start + k * every)));
  return sum * every;
}
} // namespace mpm::verification
