// Gauges at interfaces: against closed forms, after large strain and across a restart.

#include "io/results/domain_state.hpp"
#include "solver/stages/interfaces.hpp"
#include "test/domains.hpp"
#include "test/stages/ground.hpp"

#include <catch2/catch.hpp>

#include <complex>

using namespace mpm;
using namespace mpm::test;
using Complex = std::complex<double>;

namespace
{
constexpr double every = 0.005, period = 16; // s; of the samples, and after which the closed form repeats

/// rock, stiff and soft ground up to `heights` (m), in a column that P or S waves come up.
struct Site
{
  std::array<double, 3> heights;
  double stiff_young = 100e6; ///< Pa
  bool shear = true;
  std::string interfaces = "averaged";
};

Case case_of(const Site& site, double spacing, double half_width)
{
  const auto [rock, stiff, top] = site.heights;
  std::string text = level_ground(spacing, 3, 2 * half_width, rock, top, 0);
  const auto insert = [&](const std::string& before, const std::string& what)
  { text.insert(text.find(before), what); };
  const auto width = 2 * half_width;
  insert("  ground: {",
         fmt::format("  middle: {{points: [[0 m, {} m], [{} m, {} m]]}}\n", stiff, width, stiff));
  insert("  - {material: soil, above: rockhead", "  - {material: soil, above: middle, below: ground}\n");
  text.replace(text.find("{material: soil, above: rockhead, below: ground}"), 48,
               "{material: stiff, above: rockhead, below: middle}");
  insert("  soil: {", fmt::format("  stiff: {{model: elastic, density: 2000 kg/m3, young_modulus: {} Pa, "
                                  "poisson_ratio: 0.3}}\n",
                                  site.stiff_young));
  insert(", particles_per_cell", ", interfaces: " + site.interfaces);
  insert("duration: 1 s", "inertia: consistent\n  ");
  return case_from(text);
}

/// Motion at a height for an upgoing wave of amplitude 1 at the bottom, at the angular frequency w:
/// (u, tau) led down from the surface, u = 1 and tau = 0, through the layers.
Complex closed_form(const Case& case_file, const Site& site, double height, double w)
{
  Complex u = 1, tau = 0, there = 1;
  for (int m = 2; m >= 0; --m)
  {
    const Elastic& law = case_file.materials[m].elastic();
    const double modulus = site.shear ? law.shear_modulus() : law.p_modulus();
    const double k = w * std::sqrt(law.density / modulus);
    const double top = site.heights[m], bottom = m > 0 ? site.heights[m - 1] : 0;
    const auto down = [&](double d)
    {
      return std::pair{u * std::cos(k * d) + tau * std::sin(k * d) / (modulus * k),
                       tau * std::cos(k * d) - u * modulus * k * std::sin(k * d)};
    };
    if (height <= top && height >= bottom) there = down(top - height).first;
    std::tie(u, tau) = down(top - bottom);
    if (m == 0) return there / (0.5 * (u + tau / (Complex(0, 1) * modulus * k)));
  }
  return 0;
}

/// Velocities of the closed form at a height under an upgoing pulse, from `every` on.
std::vector<double> reference(const Case& case_file, const Site& site, const GroundMotion& motion,
                              double height, int samples)
{
  std::vector<double> v(samples, 0.0);
  const int frequencies = static_cast<int>(std::lround(40 * period));
  for (int f = 1; f < frequencies; ++f)
  {
    const double w = 2 * std::numbers::pi * f / period;
    Complex spectrum = 0;
    for (std::size_t k = 0; k < motion.velocity.size(); ++k)
      spectrum += motion.velocity[k] * std::exp(Complex(0, -w * motion.dt * static_cast<double>(k)));
    spectrum *= 2 * motion.dt / period * closed_form(case_file, site, height, w);
    for (int k = 0; k < samples; ++k) v[k] += (spectrum * std::exp(Complex(0, w * every * (k + 1)))).real();
  }
  return v;
}

/// Root mean squares of the gauges' errors over those of the closed form.
std::vector<double> errors(const Site& site, double spacing, const std::vector<double>& heights)
{
  const Case case_file = case_of(site, spacing, spacing);
  Model model = make_model(case_file);
  IncomingWave wave;
  const double length = 0.3; // s: holds little above 8 Hz, eleven cells of 1 m a wave in the soil
  GroundMotion motion = pulse(0.01, length, 2);
  // A pulse has a mean, which the closed form's series leaves out: its derivative has none.
  for (std::size_t k = motion.velocity.size(); k-- > 0;)
    motion.velocity[k] = 0.01 * length * motion.acceleration[k];
  for (std::size_t k = 0; k < motion.velocity.size(); ++k)
  {
    const double next = k + 1 < motion.velocity.size() ? motion.velocity[k + 1] : 0,
                 last = k > 0 ? motion.velocity[k - 1] : 0;
    motion.acceleration[k] = (next - last) / (2 * motion.dt);
  }
  (site.shear ? wave.horizontal : wave.vertical) = motion;
  add_seismic_boundaries(model, case_file, std::make_shared<IncomingWave>(wave), false);
  FreeFieldColumn& column = *model.left;
  for (const double y : heights)
    column.domain->gauges.push_back(
        {spacing / 2, y, spacing / 2, y, 0, 0, kink_at(case_file, spacing / 2, y)});
  const double dt = step_dividing(every, case_file.courant_number, *column.domain);
  const long stride = std::lround(every / dt);
  const int samples = 300;
  std::vector<std::vector<double>> found(heights.size());
  for (long k = 0; k < samples * stride; ++k)
  {
    column.advance(k * dt, dt);
    if ((k + 1) % stride != 0) continue;
    for (std::size_t g = 0; g < heights.size(); ++g)
    {
      const Gauge& gauge = column.domain->gauges[g];
      found[g].push_back(site.shear ? gauge.velocity_x : gauge.velocity_y);
    }
  }
  std::vector<double> result;
  for (std::size_t g = 0; g < heights.size(); ++g)
  {
    const std::vector<double> exact = reference(case_file, site, motion, heights[g], samples);
    double apart = 0, all = 0;
    for (int k = 0; k < samples; ++k)
    {
      apart += std::pow(found[g][k] - exact[k], 2);
      all += std::pow(exact[k], 2);
    }
    result.push_back(std::sqrt(apart / all));
  }
  return result;
}
} // namespace

TEST_CASE("A gauge on an interface reads the ground's motion with order 2", "[stages]")
{
  const bool shear = GENERATE(true, false);
  const Site site{{10, 15, 20}, 100e6, shear};
  // On both interfaces, half a cell beside them, in between, and 1 m below the surface.
  const std::vector<double> heights{10, 15, 9.75, 10.25, 14.5, 15.5, 12.5, 19};
  const std::vector<double> coarse = errors(site, 1, heights), fine = errors(site, 0.5, heights);
  for (std::size_t g = 0; g < heights.size(); ++g)
  {
    INFO((shear ? "S" : "P") << " waves at " << heights[g] << " m: " << coarse[g] << " and " << fine[g]);
    CHECK(coarse[g] < 0.05);
    CHECK(fine[g] < 0.022);
    // Order 1.8 or better; where the finer error is below the floor of 0.25 % other errors of the method take
    // part. The floor was set after trial runs.
    CHECK((coarse[g] > 3.5 * fine[g] || fine[g] < 0.0025));
  }
}

TEST_CASE("Three materials in a cell carry waves as their layers do", "[stages]")
{
  // A soft layer of half a metre between rock and soil, against sharp interfaces; the shares were set after
  // the measurement.
  const std::vector<double> heights{8, 10, 10.25, 10.5, 12, 20};
  Site site{{10, 10.5, 20}, 15e6};
  for (const double spacing : {1.0, 0.5})
  {
    site.interfaces = "averaged";
    const std::vector<double> averaged = errors(site, spacing, heights);
    site.interfaces = "sharp";
    const std::vector<double> sharp = errors(site, spacing, heights);
    for (std::size_t g = 0; g < heights.size(); ++g)
    {
      INFO("h = " << spacing << " m, at " << heights[g] << " m: " << averaged[g] << ", sharp " << sharp[g]);
      CHECK(averaged[g] < (spacing > 0.5 ? 0.65 : 0.5) * sharp[g]);
    }
  }
}

TEST_CASE("A kink stands within a cell of an interface and nowhere else", "[stages]")
{
  // With a half space d cells away, the mean of |y| over a hat of a cells exceeds |d| by a (1 - |d| / a)^3
  // / 3.
  constexpr double a = 0.85;
  std::string text = level_ground(1, 2, 20, 5, 12, 0);
  text.replace(text.find("per_cell: 2"), 11, "per_cell: 2, interfaces: averaged");
  const Case level = case_from(text);
  std::string sharp = text;
  sharp.replace(sharp.find("averaged"), 8, "sharp");
  const double soft = 1 / level.materials[1].elastic().shear_modulus(),
               stiff = 1 / level.materials[0].elastic().shear_modulus();
  for (const double d : {-0.5, -0.25, 0.0, 0.25, 0.5})
  {
    const Kink kink = kink_at(level, 10, 5 + d);
    const double t = d / a, below = t < 0 ? 0.5 * (1 + t) * (1 + t) : 1 - 0.5 * (1 - t) * (1 - t);
    const double mean = below * soft + (1 - below) * stiff;
    INFO("d = " << d);
    CHECK(kink.normal_y == Approx(1));
    CHECK(kink.normal_x == Approx(0).margin(1e-9));
    // Midpoints of 1/32 of the hat's width.
    CHECK(kink.shear == Approx(a * std::pow(1 - std::fabs(t), 3) / 6 * (soft - stiff) / mean).margin(0.01));
  }
  CHECK(kink_at(level, 10, 5.851).shear == 0);
  CHECK(kink_at(level, 10, 4.149).shear == 0);
  CHECK(kink_at(level, 10, 12).shear == 0); // the surface is no interface
  CHECK(kink_at(case_from(sharp), 10, 5).shear == 0);
  text.replace(text.find("[[0 m, 5 m], [20 m, 5 m]]"), 25, "[[0 m, 0 m], [10 m, 10 m], [20 m, 10 m]]");
  const Kink inclined = kink_at(case_from(text), 5, 5);
  CHECK(inclined.normal_x == Approx(-std::sqrt(0.5)).epsilon(0.01));
  CHECK(inclined.normal_y == Approx(std::sqrt(0.5)).epsilon(0.01));
  CHECK(inclined.shear > 0);
}

TEST_CASE("A kink goes without a jump where the ground is sheared, and takes no part in a translation",
          "[mpm]")
{
  Domain block = domains::make_domain({{domains::elastic(), {0, 0, 12, 12}}}, 1);
  const double shear = 1, dt = 1e-3;
  Kink kink;
  kink.normal_y = 1;
  kink.normal = kink.shear = 0.2;
  block.gauges.push_back({6, 6, 6, 6, 0, 0, kink});
  block.gauges.push_back({6, 6, 6, 6});
  domains::set_velocity(block, 3, -1);
  domains::run(block, 1, dt);
  CHECK(block.gauges[0].velocity_x == Approx(block.gauges[1].velocity_x).epsilon(1e-12));
  CHECK(block.gauges[0].velocity_y == Approx(block.gauges[1].velocity_y).epsilon(1e-12));

  double before = NAN;
  for (int k = 0; k < 200; ++k)
  {
    Particles& p = block.particles; // v_x = shear y, held
    for (int n = 0; n < p.size(); ++n)
    {
      p.velocity_x[n] = shear * (p.y[n] - 6);
      p.velocity_y[n] = 0;
      p.affine_xy[n] = shear;
      p.affine_xx[n] = p.affine_yx[n] = p.affine_yy[n] = 0;
      p.stress_xx[n] = p.stress_yy[n] = p.stress_zz[n] = p.stress_xy[n] = 0;
    }
    domains::run(block, 1, dt);
    const double bend = block.gauges[0].velocity_x - block.gauges[1].velocity_x;
    INFO("after a strain of " << shear * k * dt);
    if (k < 45) CHECK(bend == Approx(-0.2 * shear).epsilon(0.01));
    if (k > 105) CHECK(std::fabs(bend) < 1e-12); // the kink is gone
    // Twenty times in fifty steps: 0.2 / 50 a step.
    if (k > 0) CHECK(std::fabs(bend - before) < 1.1 * 0.2 / 50);
    before = bend;
  }
}

TEST_CASE("A kink is the same after a restart, to the last bit", "[io]")
{
  const domains::Threads one(1);
  Domain block = domains::make_domain({{domains::elastic(), {0, 0, 12, 12}}}, 1);
  domains::random_velocities(block, 1, 7);
  block.gauges.push_back({6, 6, 6, 6, 0, 0, {0.6, 0.8, 0.1, 0.05, 0.2}});
  domains::run(block, 5, 1e-3);
  h5::File file = h5::File::in_memory("checkpoint");
  save_domain(file, block);
  Domain resumed = domains::same_particles(block);
  load_domain(file, resumed);
  resumed.time = block.time;
  domains::run(block, 10, 1e-3);
  domains::run(resumed, 10, 1e-3);
  CHECK(resumed.gauges[0].kink.slip == block.gauges[0].kink.slip);
  CHECK(resumed.gauges[0].kink.slip != 0);
  CHECK(resumed.gauges[0].kink.stretch == block.gauges[0].kink.stretch);
  CHECK(resumed.gauges[0].velocity_x == block.gauges[0].velocity_x);
  CHECK(resumed.gauges[0].x == block.gauges[0].x);
}
