#include "test/verification/column.hpp"

#include "io/units.hpp"

#include <cmath>
#include <numbers>

namespace mpm::verification
{
Case scene_at(const std::filesystem::path& folder, double spacing)
{
  return load_case(folder / "case.yaml", {"grid.spacing=" + number_text(spacing) + " m"});
}

std::shared_ptr<IncomingWave> wave_of(const Case& scene)
{
  const MotionSettings& settings = scene.seismic.motion;
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

double step_dividing(double every, const Case& scene, const Domain& domain)
{
  const double most = scene.safety * scene.grid.spacing / greatest_wave_speed(domain);
  return every / std::ceil(every / most);
}

Trace shake_column(const Case& scene, std::shared_ptr<const IncomingWave> wave, double every)
{
  Model model = make_model(scene);
  add_seismic_boundaries(model, scene, wave, false);
  FreeFieldColumn& column = *model.left;
  column.domain->flip_blend = scene.seismic.flip_blend;
  // A gauge on the ground surface; the outermost particle sits half a particle distance below it.
  column.domain->tracers.push_back({0.5 * scene.grid.spacing, scene.ground_height(0), 0, 0, 0, 0});
  const double dt = step_dividing(every, scene, *column.domain);
  const long stride = std::lround(every / dt), samples = std::lround(scene.seismic.duration / every);
  Trace trace;
  trace.every = every;
  for (long k = 0; k < samples * stride; ++k)
  {
    column.advance(k * dt, dt);
    if ((k + 1) % stride != 0) continue;
    trace.x.push_back(column.domain->tracers[0].velocity_x);
    trace.y.push_back(column.domain->tracers[0].velocity_y);
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
