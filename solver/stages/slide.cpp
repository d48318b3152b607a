#include "solver/stages/slide.hpp"

#include "solver/stages/departures.hpp"
#include "solver/stages/outline.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
/// Displacement since the start of the shaking (m) and velocity (m/s).
struct Movement
{
  double ux, uy, vx, vy;
  double distance() const { return std::hypot(ux, uy); }
  double speed() const { return std::hypot(vx, vy); }
};

Movement motion_of(const Domain& domain, int k)
{
  const Particles& p = domain.particles;
  return {p.x[k] - p.reference_x[k], p.y[k] - p.reference_y[k], p.velocity_x[k], p.velocity_y[k]};
}

/// What the whole slope does with the earth below it: the lowest row of the left column. It is not the input
/// itself, which a base with soft soil above follows only in part.
Movement base_motion(const Model& model)
{
  if (!model.left) return {};
  return motion_of(*model.left->domain, model.left->particle_of_row(0));
}

/// What a does beyond b.
Movement relative(const Movement& a, const Movement& b)
{
  return {a.ux - b.ux, a.uy - b.uy, a.vx - b.vx, a.vy - b.vy};
}

/// Value below which a share of the values lies; one of them, without interpolation.
double percentile(std::vector<double> values, double share)
{
  if (values.empty()) return 0;
  const auto bound = values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
  std::nth_element(values.begin(), bound, values.end());
  return *bound;
}

constexpr double toe_reach = 2; ///< cells behind the toe, which hold the area of one or more

struct Placed
{
  double x, area; ///< m along the direction of the slide; m2
};

/// How far ground goes that lies together: the greatest x with `area` (m2) or more within `reach` (m) behind
/// it. Single particles that have flown on do not count, unless there is nothing else.
double front_of(std::vector<Placed> ground, double reach, double area)
{
  std::sort(ground.begin(), ground.end(), [](const Placed& a, const Placed& b) { return a.x > b.x; });
  double within = 0; // area of those from `k` on that are no more than `reach` behind it
  std::size_t end = 0;
  for (std::size_t k = 0; k < ground.size(); within -= ground[k++].area)
  {
    for (; end < ground.size() && ground[end].x >= ground[k].x - reach; ++end) within += ground[end].area;
    if (within >= area) return ground[k].x;
  }
  return ground.front().x;
}

/// Number for JSON, which has no NaN: null stands for none.
nlohmann::json number(double value)
{
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}
} // namespace

/// The component of v along u: (u . v) / |u|.
double MovedGround::advance() const
{
  const double length = std::hypot(displacement[0], displacement[1]);
  return length > 0 ? (displacement[0] * velocity[0] + displacement[1] * velocity[1]) / length : 0;
}

void Slide::Peak::raise(double other, double when, std::array<double, 2> position)
{
  if (other > value) *this = {other, when, position[0], position[1]};
}

void Slide::add_series(History& history, History::Clock clock)
{
  const Axis component{"component", {"x", "y"}};
  series_.area = history.add_series("slide/moved_area", "m2", {}, clock);
  series_.mass = history.add_series("slide/moved_mass", "kg/m", {}, clock);
  series_.displacement = history.add_series("slide/centre_of_mass_displacement", "m", {component}, clock);
  series_.velocity = history.add_series("slide/centre_of_mass_velocity", "m/s", {component}, clock);
  series_.toe = history.add_series("slide/toe", "m", {}, clock);
  series_.toe_advance = history.add_series("slide/toe_advance", "m", {}, clock);
  series_.velocity_99 = history.add_series("slide/peak_velocity", "m/s", {}, clock);
  series_.velocity_point = history.add_series("slide/point_velocity", "m/s", {}, clock);
  series_.point = history.add_series("slide/point", "m", {component}, clock);
  series_.left_area = history.add_series("slide/left_area", "m2", {}, clock);
  series_.left_mass = history.add_series("slide/left_mass", "kg/m", {}, clock);
}

void Slide::sample(History& history, double time)
{
  note_out_of_place(time);
  now_ = measure();
  area_.raise(now_.area, time);
  velocity_99_.raise(now_.velocity_99, time);
  velocity_point_.raise(now_.velocity_point, time, now_.point);
  time_ = time;
  history.record(series_.area, now_.area);
  history.record(series_.mass, now_.mass);
  history.record(series_.displacement, now_.displacement);
  history.record(series_.velocity, now_.velocity);
  history.record(series_.toe, now_.toe);
  history.record(series_.toe_advance, now_.toe_advance);
  history.record(series_.velocity_99, now_.velocity_99);
  history.record(series_.velocity_point, now_.velocity_point);
  history.record(series_.point, now_.point);
  const Departure left = departure(model_);
  history.record(series_.left_area, left.area);
  history.record(series_.left_mass, left.mass);
}

/// One pass over the particles. Sums of mass-weighted displacement and velocity become those of the centre of
/// mass; the toe is on the side to which that has moved.
MovedGround Slide::measure() const
{
  const Domain& main = *model_.main;
  const Particles& p = main.particles;
  const Movement base = base_motion(model_);
  MovedGround all;
  std::array<double, 2> before{INFINITY, -INFINITY}; // leftmost and rightmost x
  std::vector<Placed> places;
  std::vector<double> speeds;
  for (int k = 0; k < p.size(); ++k)
  {
    const Movement m = relative(motion_of(main, k), base);
    if (!(m.distance() >= case_file_.output.slide.moved)) continue; // nor what has diverged
    all.area += model_.reference_volume[p.id[k]];
    all.mass += p.mass[k];
    all.displacement[0] += p.mass[k] * m.ux;
    all.displacement[1] += p.mass[k] * m.uy;
    all.velocity[0] += p.mass[k] * m.vx;
    all.velocity[1] += p.mass[k] * m.vy;
    places.push_back({p.x[k], model_.reference_volume[p.id[k]]});
    before = {std::min(before[0], p.reference_x[k]), std::max(before[1], p.reference_x[k])};
    speeds.push_back(m.speed());
    if (speeds.size() > 1 && speeds.back() <= all.velocity_point) continue;
    all.velocity_point = speeds.back();
    all.point = {p.x[k], p.y[k]};
  }
  if (speeds.empty()) return all;
  for (auto* sum : {&all.displacement, &all.velocity})
    for (double& value : *sum) value /= all.mass;
  const bool right = all.displacement[0] >= 0;
  for (Placed& place : places) place.x *= right ? 1 : -1;
  const double h = main.grid.spacing;
  const double front = front_of(std::move(places), toe_reach * h, (1 - 1e-9) * h * h);
  all.toe = right ? front : -front;
  all.toe_advance = std::fabs(all.toe - before[right ? 1 : 0]);
  all.velocity_99 = percentile(std::move(speeds), 0.99);
  return all;
}

/// Keeps, for each particle, since when it is out of place; one that comes back starts anew. Between samples,
/// 0.1 s apart, the crossing is found from the distance d beyond the threshold and the rate (u . v) / |u|:
/// t - d / rate, but not before the last sample.
void Slide::note_out_of_place(double time)
{
  const Domain& main = *model_.main;
  const Movement base = base_motion(model_);
  const double threshold = case_file_.output.slide.out_of_place();
  out_of_place_since_.resize(model_.reference_volume.size(), NAN);
  for (int k = 0; k < main.particles.size(); ++k)
  {
    const Movement m = relative(motion_of(main, k), base);
    double& since = out_of_place_since_[main.particles.id[k]];
    const double far = m.distance();
    if (far < threshold) since = NAN;
    if (far < threshold || !std::isnan(since)) continue;
    const double rate = (m.ux * m.vx + m.uy * m.vy) / far;
    since = rate > 0 ? std::max(time_, time - (far - threshold) / rate) : time;
  }
}

/// The time by which the first tenth of the mass that has slid by now was out of place: the crest of a slide
/// may move seconds before its body, and single particles long before.
double Slide::trigger_time() const
{
  const Domain& main = *model_.main;
  const Particles& p = main.particles;
  const Movement base = base_motion(model_);
  std::vector<std::pair<double, double>> left; // when, mass
  double mass = 0;
  for (int k = 0; k < p.size() && !out_of_place_since_.empty(); ++k)
  {
    if (relative(motion_of(main, k), base).distance() < case_file_.output.slide.moved ||
        std::isnan(out_of_place_since_[p.id[k]]))
      continue;
    left.push_back({out_of_place_since_[p.id[k]], p.mass[k]});
    mass += p.mass[k];
  }
  for (const Departed& one : main.departed) // it has moved, if anything has
  {
    if (out_of_place_since_.empty() || std::isnan(out_of_place_since_[one.particle])) continue;
    left.push_back({out_of_place_since_[one.particle], one.mass});
    mass += one.mass;
  }
  std::sort(left.begin(), left.end());
  double gone = 0;
  for (const auto& [time, part] : left)
    if ((gone += part) >= early * mass) return time;
  return NAN;
}

nlohmann::json Slide::peak(const Peak& peak) const
{
  nlohmann::json result{{"value", peak.value}, {"time", number(peak.time)}};
  if (!std::isnan(peak.x)) result["position"] = {peak.x, peak.y};
  return result;
}

nlohmann::json Slide::summary() const
{
  const Outline line = outline_of(*model_.main, case_file_);
  const auto change = [](const Outline::Change& c) {
    return nlohmann::json{{"height", c.height}, {"x", number(c.x)}};
  };
  return {{"trigger_time", number(trigger_time())},
          {"moved_area", now_.area},
          {"moved_mass", now_.mass},
          {"left_area", departure(model_).area},
          {"left_mass", departure(model_).mass},
          {"greatest_moved_area", peak(area_)},
          {"centre_of_mass_displacement", now_.displacement},
          {"toe", number(now_.toe)},
          {"toe_advance", now_.toe_advance},
          {"peak_velocity", peak(velocity_99_)},
          {"point_velocity", peak(velocity_point_)},
          {"outline_rise", change(line.greatest_rise())},
          {"outline_fall", change(line.greatest_fall())}};
}

void Slide::write(h5::File& file) const
{
  const Outline line = outline_of(*model_.main, case_file_);
  h5::Group group = file.create_group("outline");
  group.write("x", std::span<const double>(line.x), {line.x.size()}, "m");
  for (const auto& [name, height] : {std::pair{"start", &line.start}, std::pair{"end", &line.end}})
  {
    group.write(name, std::span<const double>(*height), {height->size()}, "m");
    group.attach_scale(name, "x", 0);
  }
  file.attribute("trigger_time", trigger_time(), "slide");
}

void Slide::save(h5::Group& group) const
{
  group.write("departure", std::span<const double>(out_of_place_since_), {out_of_place_since_.size()}, "s");
  std::vector<double> peaks;
  for (const Peak* p : {&area_, &velocity_99_, &velocity_point_})
    peaks.insert(peaks.end(), {p->value, p->time, p->x, p->y});
  group.write("peaks", std::span<const double>(peaks), {3, 4}, "1");
  group.attribute("time", time_);
}

void Slide::load(const h5::Group& group, double now)
{
  const auto refuse = [&](const std::string& name)
  { throw Error(exit_code::bad_input, group.where(name) + ": no run leaves that; use another file"); };
  out_of_place_since_ = group.read_doubles("departure");
  for (const double time : out_of_place_since_)
    if (time < 0 || time > now) refuse("departure");
  if (out_of_place_since_.size() != std::size_t(model_.main->particles.size())) refuse("departure");
  const std::vector<double> peaks = group.read_doubles("peaks");
  if (peaks.size() != 12) refuse("peaks");
  std::size_t k = 0;
  for (Peak* p : {&area_, &velocity_99_, &velocity_point_})
  {
    *p = {peaks[k], peaks[k + 1], peaks[k + 2], peaks[k + 3]};
    if (!(p->value >= 0) || p->time < 0 || p->time > now) refuse("peaks");
    k += 4;
  }
  time_ = group.attribute_double("time");
  if (!(time_ >= 0 && time_ <= now)) refuse("time");
  now_ = measure();
}
} // namespace mpm
