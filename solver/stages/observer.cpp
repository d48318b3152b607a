#include "solver/stages/observer.hpp"

#include "io/results/checkpoint_layout.hpp"
#include "io/results/frames.hpp"
#include "solver/mpm/health.hpp"
#include "solver/stages/interfaces.hpp"
#include "solver/stages/motion.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
/// Since the start of the stage, m.
std::array<double, 2> displacement_of(const Domain& domain, int k)
{
  const Particles& p = domain.particles;
  return {p.x[k] - p.reference_x[k], p.y[k] - p.reference_y[k]};
}

std::array<double, 2> velocity_of(const Domain& domain, int k)
{
  return {domain.particles.velocity_x[k], domain.particles.velocity_y[k]};
}

/// A field of a frame by its name, for all particles in their order: displacement, velocity, what each
/// particle has (particle_fields), or a history variable of a law, 0 where the particle's law has none.
/// Vectors have three components, as VTK wants them.
Frame::Field frame_field(const Domain& domain, const std::string& name)
{
  const Particles& p = domain.particles;
  const int count = p.size();
  const auto vector = [&](const auto& of)
  {
    std::vector<double> values;
    for (int k = 0; k < count; ++k)
    {
      const auto [x, y] = of(domain, k);
      values.insert(values.end(), {x, y, 0});
    }
    return values;
  };
  if (name == "displacement") return {name, "m", 3, vector(displacement_of)};
  if (name == "velocity") return {name, "m/s", 3, vector(velocity_of)};
  for (const ParticleField& field : particle_fields)
  {
    if (field.name != name) continue;
    Frame::Field result{name, std::string(field.unit), field.components, {}};
    for (int k = 0; k < count; ++k)
      for (int c = 0; c < field.components; ++c) result.values.push_back((p.*field.data[c])[k]);
    if (name == "stress") result.component_names = {"xx", "yy", "zz", "xy"};
    return result;
  }
  // A history variable: each material keeps those of its own particles.
  Frame::Field result{name, "1", 1, std::vector<double>(count, 0.0)};
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    const Material& material = domain.materials[m];
    for (std::size_t f = 0; f < material.state.size(); ++f)
    {
      if (material.state_fields()[f].name != name) continue;
      result.unit = material.state_fields()[f].unit;
      std::copy(material.state[f].begin(), material.state[f].end(),
                result.values.begin() + domain.material_begin[m]);
    }
  }
  return result;
}

/// p = -tr(sigma) / 3 and q = sqrt(3 J2) out of the stresses of a frame.
std::vector<Frame::Field> invariants_of(const Frame::Field& stress)
{
  Frame::Field p{"p", "Pa", 1,
                 {},  {},   "mean pressure -(xx + yy + zz) / 3 of the stress: compression is positive"};
  Frame::Field q{"q", "Pa", 1, {}, {}, "Mises stress sqrt(3 J2)"};
  for (std::size_t k = 0; k < stress.values.size(); k += 4)
  {
    const double* s = &stress.values[k];
    const Deviator deviator(s[0], s[1], s[2], s[3]);
    p.values.push_back(-deviator.mean);
    q.values.push_back(deviator.mises());
  }
  return {p, q};
}
} // namespace

Observer::Observer(Session& session, Model& model, const IncomingWave& wave)
    : session_(session), model_(model), wave_(wave), slide_(model, session.case_file)
{
  add_series();
}

/// Names every series of history.h5, before its first row; a checkpoint's must be the same.
void Observer::add_series()
{
  const Axis component{"component", {"x", "y"}};
  fast_ = 0;
  slow_ = history_.add_clock();
  const auto& points = session_.case_file.output.gauges.points;
  if (!points.empty())
  {
    Axis gauge{"gauge", {}};
    for (const GaugePoint& point : points) gauge.labels.push_back(point.name);
    displacement_ = history_.add_series("gauges/displacement", "m", {gauge, component}, fast_);
    velocity_ = history_.add_series("gauges/velocity", "m/s", {gauge, component}, fast_);
    acceleration_ = history_.add_series("gauges/acceleration", "m/s2", {gauge, component}, fast_);
  }
  for (const Edge side : both_sides)
  {
    const FreeFieldColumn* column = model_.column(side);
    if (!column) continue;
    const std::string group = fmt::format("free_field/{}/", side_name(side));
    sides_.push_back({column, history_.add_series(group + "surface_displacement", "m", {component}, fast_),
                      history_.add_series(group + "surface_velocity", "m/s", {component}, fast_),
                      history_.add_series(group + "base_displacement", "m", {component}, fast_),
                      history_.add_series(group + "base_velocity", "m/s", {component}, fast_)});
  }
  slide_.add_series(history_, slow_);
  add_energy_series();
  if (session_.case_file.seismic.base == BaseKind::fixed) return;
  corner_ =
      history_.add_series("base/corner_displacement", "m", {{"corner", {"left", "right"}}, component}, slow_);
  rotation_ = history_.add_series("base/rotation", "rad", {}, slow_);
  greatest_drift_ = history_.add_series("base/greatest_displacement", "m", {}, slow_);
}

void Observer::add_energy_series()
{
  for (const auto& [part, domain] : model_.domains())
  {
    const std::string group = group_in("energy", part) + "/";
    EnergySeries series{domain, {}, 0};
    for (std::size_t k = 0; k < energy_terms.size(); ++k)
      series.terms[k] = history_.add_series(group + std::string(energy_terms[k].name), "J/m", {}, slow_);
    series.residual = history_.add_series(group + "residual", "J/m", {}, slow_);
    energy_series_.push_back(series);
  }
}

void Observer::place_gauges()
{
  const Case& case_file = session_.case_file;
  Domain& main = *model_.main;
  // A gauge belongs to the material point that was at its position in the undeformed ground: it moves by what
  // the nearest particle has settled, and its displacement counts from there.
  for (const GaugePoint& point : case_file.output.gauges.points)
  {
    const double y = std::min(point.y, case_file.ground_height(point.x));
    if (y < point.y)
      session_.log.info("gauge {}: {:.3f} m above the ground, moved down to y = {:.3f} m", point.name,
                        point.y - y, y);
    const Particles& p = main.particles;
    int nearest = 0;
    const auto distance = [&](int k) { return std::hypot(p.reference_x[k] - point.x, p.reference_y[k] - y); };
    for (int k = 1; k < p.size(); ++k)
      if (distance(k) < distance(nearest)) nearest = k;
    const auto [ux, uy] = displacement_of(main, nearest);
    main.gauges.push_back({point.x + ux, y + uy, point.x + ux, y + uy, 0, 0, kink_at(case_file, point.x, y)});
  }
}

void Observer::look(const Clock& clock, bool first)
{
  const OutputSettings& output = session_.case_file.output;
  if (first || clock.passed(output.gauges.every)) sample_gauges(clock);
  if (first || clock.passed(slide_every)) sample_slide(clock);
  if (first || clock.passed(output.frames.every)) write_frame(clock);
}

/// The end of a run is a sample and a frame, whatever the intervals: pictures and summary show the same
/// state.
void Observer::look_last(const Clock& clock)
{
  if (history_.times(slow_).back() < clock.time()) sample_slide(clock);
  if (frames_.back().time < clock.time()) write_frame(clock);
}

/// Displacement, velocity and, from the last sample's velocity, the mean acceleration since then: of a step
/// it would hold the noise of the grid. Surface and base of the columns go with them.
void Observer::sample_gauges(const Clock& clock)
{
  history_.start_row(clock.time(), fast_);
  std::vector<double> u, v, a;
  for (const Gauge& gauge : model_.main->gauges)
  {
    u.insert(u.end(), {gauge.x - gauge.reference_x, gauge.y - gauge.reference_y});
    v.insert(v.end(), {gauge.velocity_x, gauge.velocity_y});
  }
  const double interval = clock.time() - last_time_;
  for (std::size_t k = 0; k < v.size(); ++k)
    a.push_back(last_velocity_.empty() || interval <= 0 ? 0 : (v[k] - last_velocity_[k]) / interval);
  if (!u.empty())
  {
    history_.record(displacement_, u);
    history_.record(velocity_, v);
    history_.record(acceleration_, a);
  }
  last_velocity_ = v;
  last_time_ = clock.time();
  for (const Side& side : sides_)
  {
    const Domain& column = *side.column->domain;
    const int top = side.column->particle_of_row(side.column->rows() - 1),
              bottom = side.column->particle_of_row(0);
    history_.record(side.surface_displacement, displacement_of(column, top));
    history_.record(side.surface_velocity, velocity_of(column, top));
    history_.record(side.base_displacement, displacement_of(column, bottom));
    history_.record(side.base_velocity, velocity_of(column, bottom));
  }
}

void Observer::sample_slide(const Clock& clock)
{
  history_.start_row(clock.time(), slow_);
  slide_.sample(history_, clock.time());
  sample_energy();
  sample_base();
}

void Observer::sample_energy()
{
  for (const EnergySeries& series : energy_series_)
  {
    const Energies e = energies_of(*series.domain);
    for (std::size_t k = 0; k < energy_terms.size(); ++k) history_.record(series.terms[k], e.value[k]);
    history_.record(series.residual, residual(e));
  }
}

/// The base relative to the free field.
void Observer::sample_base()
{
  if (!model_.base) return;
  const BaseDrift drift = model_.base->drift(model_.main->particles, free_field_base(model_));
  const auto& [left, right] = drift.corner;
  history_.record(corner_, std::array{left[0], left[1], right[0], right[1]});
  history_.record(rotation_, drift.rotation);
  history_.record(greatest_drift_, drift.greatest);
}

/// A frame needs position, material and volume of each particle, whatever fields the case asks for: pictures
/// draw particles as large as they are.
void Observer::write_frame(const Clock& clock)
{
  const Domain& main = *model_.main;
  check_particles(main); // throws Diverged: what has diverged is not drawn
  Frame frame;
  frame.time = clock.time();
  frame.step = clock.step;
  for (int k = 0; k < main.particles.size(); ++k)
    frame.points.insert(frame.points.end(), {main.particles.x[k], main.particles.y[k], 0});
  std::vector<std::string> fields = session_.case_file.output.frames.fields;
  if (std::find(fields.begin(), fields.end(), "volume") == fields.end()) fields.push_back("volume");
  for (const std::string& name : fields) frame.fields.push_back(frame_field(main, name));
  if (const auto stress = std::find(fields.begin(), fields.end(), "stress"); stress != fields.end())
    for (Frame::Field& field : invariants_of(frame.fields[stress - fields.begin()]))
      frame.fields.push_back(std::move(field));
  frame.ids = main.particles.id;
  frame.materials.resize(main.particles.size());
  for (std::size_t m = 0; m < main.materials.size(); ++m)
    std::fill(frame.materials.begin() + main.material_begin[m],
              frame.materials.begin() + main.material_begin[m + 1],
              main.materials[m].origin < 0 ? m : main.materials[m].origin); // a mixture is its owner's
  for (const Material& material : session_.case_file.materials) frame.material_names.push_back(material.name);
  const std::string name = frame_name(static_cast<std::int64_t>(frames_.size()));
  const std::string digest = mpm::write_frame(*session_.folder / name, frame, session_.provenance());
  frames_.push_back({name, clock.time(), digest});
  write_frame_times();
}

void Observer::save(h5::File& file) const
{
  h5::Group group = file.create_group(checkpoint::output);
  h5::Group rows = group.create_group("history");
  history_.save(rows);
  std::vector<double> times;
  std::vector<std::string> digests;
  for (const WrittenFrame& frame : frames_)
  {
    times.push_back(frame.time);
    digests.push_back(frame.digest);
  }
  group.write("frame_times", std::span<const double>(times), {times.size()}, "s");
  group.write_strings("frame_digests", digests);
  group.write("gauge_velocity", std::span<const double>(last_velocity_), {last_velocity_.size()}, "m/s");
  group.attribute("gauge_time", last_time_);
  h5::Group slide = group.create_group("slide");
  slide_.save(slide);
}

/// The list by which ParaView opens all frames as one series in time.
void Observer::write_frame_times() const
{
  std::vector<std::pair<std::string, double>> times;
  for (const WrittenFrame& frame : frames_) times.push_back({frame.name, frame.time});
  write_series(session_.folder->path(), times);
}

void Observer::write(double until) const
{
  write_frame_times();
  history_.write(*session_.folder / "history.h5", session_.provenance(),
                 [&](h5::File& file)
                 {
                   write_motion(file, wave_, session_.case_file.output.gauges.every, until);
                   slide_.write(file);
                 });
}

nlohmann::json Observer::summary() const
{
  nlohmann::json gauges;
  const auto& points = session_.case_file.output.gauges.points;
  for (std::size_t g = 0; g < points.size(); ++g)
  {
    const Gauge& gauge = model_.main->gauges[g];
    gauges[points[g].name] = {{"displacement", {gauge.x - gauge.reference_x, gauge.y - gauge.reference_y}}};
  }
  nlohmann::json result{{"slide", slide_.summary()}, {"gauges", gauges}};
  if (!model_.base) return result;
  const BaseDrift drift = model_.base->drift(model_.main->particles, free_field_base(model_));
  result["base"] = {{"corner_displacement", {{"left", drift.corner[0]}, {"right", drift.corner[1]}}},
                    {"rotation", drift.rotation},
                    {"greatest_displacement", drift.greatest},
                    {"spring_time", spring_time(session_.case_file)}};
  return result;
}
} // namespace mpm
