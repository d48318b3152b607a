#include "solver/stages/observer.hpp"

#include "io/results/checkpoint_layout.hpp"
#include "solver/mpm/health.hpp"
#include "solver/stages/frame_fields.hpp"
#include "solver/stages/interfaces.hpp"
#include "solver/stages/motion.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
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
                      history_.add_series(group + "base_velocity", "m/s", {component}, fast_),
                      ColumnEnvelope(*column, session_.case_file.grid.particle_spacing()),
                      std::string(side_name(side))});
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
  for (Side& side : sides_)
  {
    side.envelope.sample(clock.time());
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

void Observer::write_frame(const Clock& clock)
{
  check_particles(*model_.main); // throws Diverged: what has diverged is not drawn
  const std::string name = frame_name(static_cast<std::int64_t>(frames_.size()));
  const Frame frame = frame_of(*model_.main, session_.case_file, clock);
  frames_.push_back(
      {name, clock.time(), mpm::write_frame(*session_.folder / name, frame, session_.provenance())});
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
  for (const Side& side : sides_)
  {
    h5::Group column = group.create_group("columns/" + side.name);
    side.envelope.save(column);
  }
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
                   write_gauge_places(file);
                   for (const Side& side : sides_)
                   {
                     h5::Group group = file.open_group("free_field/" + side.name);
                     side.envelope.write(group);
                   }
                 });
}

/// Where the gauges stood at the start, as coordinates of their series.
void Observer::write_gauge_places(h5::File& file) const
{
  const std::vector<Gauge>& gauges = model_.main->gauges;
  if (gauges.empty()) return;
  std::vector<double> x, y;
  for (const Gauge& gauge : gauges)
  {
    x.push_back(gauge.reference_x);
    y.push_back(gauge.reference_y);
  }
  for (const auto& [name, values] : {std::pair{"gauges/gauge_x", &x}, std::pair{"gauges/gauge_y", &y}})
  {
    file.write(name, *values, {}, "m");
    file.attach_scale(name, "gauges/gauge", 0);
  }
  for (const char* name : {"gauges/displacement", "gauges/velocity", "gauges/acceleration"})
    file.attribute("coordinates", "gauge_x gauge_y", name);
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
