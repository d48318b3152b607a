#include "test/verification/cases.hpp"

#include "boundaries/mirrored_wall.hpp"
#include "io/case/units.hpp"
#include "solver/mpm/step.hpp"
#include "solver/stages/model.hpp"

#include <cmath>

namespace mpm::verification
{
namespace
{
constexpr double depth = 1, dam = 6; // m
constexpr double duration = 4;       // in sqrt(H / g)

/// Ritter's depth over the first one, at (x - dam) / (sqrt(g H) t).
double ritter(double s)
{
  return s < -1 ? 1 : s > 2 ? 0 : (2 - s) * (2 - s) / 9;
}

void hold_at_rest(Domain& domain, double density, double gravity)
{
  Particles& p = domain.particles;
  for (int k = 0; k < p.size(); ++k)
    p.stress_xx[k] = p.stress_yy[k] = p.stress_zz[k] = -density * gravity * (depth - p.y[k]);
}

/// Depth of water over bins of the reference, from the volume in each.
std::vector<double> depths(const Domain& domain, double bin, std::size_t count)
{
  std::vector<double> result(count, 0.0);
  const Particles& p = domain.particles;
  for (int k = 0; k < p.size(); ++k)
    if (const auto b = static_cast<std::size_t>(p.x[k] / bin); b < count) result[b] += p.volume[k] / bin;
  return result;
}
} // namespace

Findings run_dam_break(const std::filesystem::path& folder, double h)
{
  const Case case_file = load_case(folder / "case.yaml", {"grid.spacing=" + number_text(h) + " m"});
  Model model = make_model(case_file);
  Domain& domain = *model.main;
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 0, 1, true}));
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::x, 0, 1, true}));
  rebuild(domain);
  const Elastic& water = case_file.materials[0].elastic();
  const double gravity = case_file.static_stage.gravity, wave = std::sqrt(gravity * depth);
  domain.settings.gravity_y = -gravity;
  set_transfer(domain.settings, case_file.seismic);
  hold_at_rest(domain, water.density, gravity);
  const double dt = case_file.courant_number * h / water.pressure_speed(),
               end = duration * std::sqrt(depth / gravity);
  const long steps = std::lround(end / dt);
  Curve front{"front", "time / sqrt(H / g)", "way of the front / H", {}, {}, {}};
  double fastest = 0;
  for (long k = 0; k < steps; ++k)
  {
    domain.time = k * dt;
    step(domain, dt);
    if ((k + 1) % (steps / 50) != 0) continue;
    const double t = (k + 1) * dt;
    const double way = *std::max_element(domain.particles.x.begin(), domain.particles.x.end()) - dam;
    front.x.push_back(t * wave / depth);
    front.model.push_back(way / depth);
    front.reference.push_back(2 * wave * t / depth);
    fastest = std::max(fastest, way / (2 * wave * t));
  }
  constexpr double bin = 0.2;
  const double t = steps * dt;
  Curve profile{"depth at the end", "x (m)", "depth / H", {}, {}, {}};
  profile.model = depths(domain, bin, static_cast<std::size_t>(std::ceil((dam + 2 * wave * t) / bin)));
  double square = 0;
  for (std::size_t b = 0; b < profile.model.size(); ++b)
  {
    profile.x.push_back((b + 0.5) * bin);
    profile.reference.push_back(ritter((profile.x[b] - dam) / (wave * t)));
    square +=
        std::pow(profile.model[b] - profile.reference[b], 2) / static_cast<double>(profile.model.size());
  }
  return {{{"front", fastest}, {"profile", std::sqrt(square)}}, {front, profile}};
}
} // namespace mpm::verification
