#include "test/verification/cases.hpp"

#include "io/units.hpp"
#include "solver/mpm/step.hpp"
#include "solver/stages/model.hpp"

#include <cmath>

namespace mpm::verification
{
namespace
{
constexpr double height = 5;         // m
constexpr double elastic_time = 1.5; // s: gravity grows over a half of it, elastic
constexpr double plastic_time = 2;   // s, after which the cut must have come to rest or be on its way
constexpr double gone = 0.005;       // of the height: twice what yielding alone moves a cut that stands
constexpr double exact = 3.8;        // middle of the bounds of limit analysis

void run(Domain& domain, double gravity, double ramp, double duration, double dt)
{
  for (long k = 0; k * dt < duration; ++k)
  {
    const double s = ramp > 0 ? std::min(1.0, k * dt / ramp) : 1;
    domain.gravity_y = -gravity * s * s * s * (10 + s * (6 * s - 15));
    domain.time = k * dt;
    step(domain, dt);
  }
}

/// The cut at rest under gravity while it is elastic; strengths are tried from there.
struct Cut
{
  Model model;
  Particles settled;
  double gravity, dt;
};

Cut settle(const Case& scene)
{
  Cut cut{make_model(scene), {}, scene.statics.gravity, 0};
  add_static_boundaries(cut.model, scene);
  Domain& domain = *cut.model.main;
  cut.dt = scene.safety * scene.grid.spacing / greatest_wave_speed(domain);
  domain.plastic = false;
  run(domain, cut.gravity, 0.5 * elastic_time, elastic_time, cut.dt);
  domain.plastic = true;
  domain.damping = 0; // it would hold back a failing cut
  cut.settled = domain.particles;
  return cut;
}

/// Greatest displacement from the elastic state, over the height, of clay of shear strength rho g H / number.
double displacement(Cut& cut, double number)
{
  Domain& domain = *cut.model.main;
  auto& clay = std::get<VonMises>(domain.materials[0].law);
  clay.peak = clay.residual = std::sqrt(3.0) * clay.density * cut.gravity * height / number;
  domain.particles = cut.settled;
  domain.materials[0].state[0].assign(cut.settled.size(), 0.0);
  sort_particles(domain);
  const std::vector<int> before = domain.place;
  const Particles start = domain.particles;
  run(domain, cut.gravity, 0, plastic_time, cut.dt);
  const Particles& p = domain.particles;
  double greatest = 0;
  for (std::size_t id = 0; id < before.size(); ++id)
    greatest = std::max(greatest, std::hypot(p.x[domain.place[id]] - start.x[before[id]],
                                             p.y[domain.place[id]] - start.y[before[id]]));
  return greatest / height;
}
struct Search
{
  Curve curve;
  double number; ///< at failure
};

Search find_failure(const std::filesystem::path& folder, double spacing, const std::string& averaged)
{
  Cut cut = settle(load_case(folder / "case.yaml", {"grid.spacing=" + number_text(spacing) + " m",
                                                    "grid.volume_average=" + averaged}));
  Curve curve{"displacement, volume change of " +
                  std::string(averaged == "cell" ? "the cell" : "each particle"),
              "rho g H / s_u",
              "displacement / H",
              {},
              {},
              {}};
  double stands = 3.5, falls = 4.5;
  while (falls - stands > 0.04) // 1 % of the answer
  {
    const double number = 0.5 * (stands + falls), moved = displacement(cut, number);
    curve.x.push_back(number);
    curve.model.push_back(moved);
    curve.reference.push_back(gone);
    (moved < gone ? stands : falls) = number;
  }
  return {curve, 0.5 * (stands + falls)};
}
} // namespace

Findings run_vertical_cut(const std::filesystem::path& folder, double spacing)
{
  const Search each = find_failure(folder, spacing, "none"), cell = find_failure(folder, spacing, "cell");
  return {{{"number", std::fabs(each.number / exact - 1)},
           {"number, averaged", std::fabs(cell.number / exact - 1)}},
          {each.curve, cell.curve}};
}
} // namespace mpm::verification
