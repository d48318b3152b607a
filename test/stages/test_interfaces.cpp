#include "solver/stages/interfaces.hpp"
#include "test/domains.hpp"
#include "test/stages/ground.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::test;

namespace
{
struct Mixed
{
  std::vector<Seed> seeds;
  std::vector<Material> materials;
};

Mixed mixed(const Case& case_file)
{
  Mixed result{fill(case_file).seeds, case_file.materials};
  average_interfaces(case_file, result.seeds, result.materials);
  return result;
}

/// The ground with soft soil between rockhead and the points of another line: three materials in a cell.
std::string with_thin_layer(std::string text, const std::string& points)
{
  const auto insert = [&](const std::string& before, const std::string& what)
  { text.insert(text.find(before), what); };
  insert("  ground: {", "  middle: {points: [" + points + "]}\n");
  insert("  - {material: soil", "  - {material: thin, above: rockhead, below: middle}\n");
  insert("  soil: {",
         "  thin: {model: elastic, density: 1700 kg/m3, young_modulus: 15 MPa, poisson_ratio: 0.4}\n");
  return text;
}

/// The ground with clay in the place of elastic soil.
std::string with_clay(std::string text,
                      const std::string& strength =
                          "strength: {peak: 70 kPa, residual: 39 kPa}, softening: {displacement: 0.2 m}")
{
  const std::string soil = "soil: {model: elastic,";
  return text.replace(text.find(soil), soil.size(), "soil: {model: von_mises, " + strength + ",");
}

/// With averaged interfaces and consistent inertia.
Case with_options(std::string text, const std::string& courant)
{
  text.replace(text.find("per_cell: 2"), 11, "per_cell: 2, interfaces: averaged");
  text.replace(text.find("duration: 1 s"), 13, "duration: 1 s\n  inertia: consistent");
  return case_from(text + "time_step: {courant_number: " + courant + "}\n");
}

/// Share of soil in the hat of 3/4 of a cell to each side of `above` cells over rockhead.
double soil(double above)
{
  const double t = std::clamp(above / 0.75, -1.0, 1.0);
  return t < 0 ? 0.5 * (1 + t) * (1 + t) : 1 - 0.5 * (1 - t) * (1 - t);
}
} // namespace

TEST_CASE("Particles near a level interface have averaged compliances, the same in all columns", "[stages]")
{
  const double rockhead = GENERATE(10.0, 10.15, 9.7); // on a grid line, and not
  const Case case_file = case_from(level_ground(1, 4, 12, rockhead, 20, 0));
  const Elastic &rock = case_file.materials[0].elastic(), &soft = case_file.materials[1].elastic();
  const Mixed ground = mixed(case_file);
  REQUIRE(ground.materials.size() > 2);
  const std::size_t rows = ground.seeds.size() / 48;
  for (std::size_t k = 0; k < ground.seeds.size(); ++k)
  {
    const Seed& seed = ground.seeds[k];
    CHECK(seed.material == ground.seeds[k % rows].material);
    const Material& material = ground.materials[seed.material];
    const Elastic& law = material.elastic();
    CHECK(law.density == (seed.y > rockhead ? soft.density : rock.density));
    // A 32nd to the nearest level, and an eighth of the height of a row over which a share is constant.
    const double s = soil(seed.y - rockhead), tolerance = 1.0 / 64 + 0.02;
    const double G = 1 / law.shear_modulus(), M = 1 / law.p_modulus();
    const auto share = [](double x, double none, double all) { return (x - none) / (all - none); };
    CHECK(std::fabs(share(G, 1 / rock.shear_modulus(), 1 / soft.shear_modulus()) - s) < tolerance);
    CHECK(std::fabs(share(M, 1 / rock.p_modulus(), 1 / soft.p_modulus()) - s) < tolerance);
    if (std::fabs(seed.y - rockhead) > 0.95) CHECK(seed.material < 2);
    if (material.origin >= 0) CHECK(material.origin == (seed.y > rockhead ? 1 : 0));
  }
}

TEST_CASE("Rock beside clay has the clay's law within reach of the interface, and its own density",
          "[stages]")
{
  const Case case_file = case_from(with_clay(level_ground(1, 4, 12, 10.15, 20, 0)));
  const auto& clay = std::get<VonMises>(case_file.materials[1].law);
  const Mixed ground = mixed(case_file);
  for (const Material& material : ground.materials)
  {
    if (material.origin < 0) continue;
    CHECK(material.law_of == 1);
    const auto& law = std::get<VonMises>(material.law);
    CHECK(law.peak == clay.peak);
    CHECK(law.softening_strain == clay.softening_strain);
  }
  int rims = 0;
  for (const Seed& seed : ground.seeds)
  {
    const Material& material = ground.materials[seed.material];
    CHECK(material.elastic().density == (seed.y > 10.15 ? 1800 : 2200));
    rims += material.origin == 0 && material.law_of == 1;
    if (seed.y < 9.2) CHECK(seed.material == 0);
  }
  CHECK(rims > 0);
  // Where nothing yields, and where both sides do, each keeps its own.
  std::string both = with_clay(level_ground(1, 4, 12, 10.15, 20, 0));
  both.replace(both.find("model: elastic"), 14, "model: von_mises, strength: {peak: 1 MPa}");
  for (const std::string& text : {level_ground(1, 4, 12, 10.15, 20, 0), both})
  {
    const Mixed own = mixed(case_from(text));
    for (const Seed& seed : own.seeds)
      if (const int giver = own.materials[seed.material].law_of; giver >= 0) CHECK(giver == (seed.y > 10.15));
  }
}

TEST_CASE("A sheet of clay slides on rock", "[stages]")
{
  // The ground is pulled away under the sheet with 8 m/s2 for half a second. With its shear strength k the
  // sheet follows with k / (rho t), and stays behind by s = (8 - k / (rho t)) t^2 / 2, but for what is
  // sheared itself: 0.37 of that with two cells, 0.68 with four; 0.02 and 0.41 where the rock's nodes hold
  // the lowest cell, as with sharp interfaces. Bounds were set after measuring.
  const int thickness = GENERATE(2, 4); // cells of 1 m
  const double acceleration = 8, time = 0.5, follows = 2.78;
  const double wanted = 0.5 * (acceleration - follows) * time * time;
  const auto slip = [&](const std::string& interfaces)
  {
    std::string text =
        with_clay(level_ground(1, 2, 8, 6, 6 + thickness, 0),
                  fmt::format("strength: {{peak: {} kPa}}", std::sqrt(3.0) * 1.8 * follows * thickness));
    text.replace(text.find("per_cell: 2"), 11, "per_cell: 2, interfaces: " + interfaces);
    const Case case_file = case_from(text);
    Model model = make_model(case_file);
    IncomingWave wave;
    GroundMotion pull;
    pull.dt = 0.001;
    for (double t = 0; t < 2 * time; t += pull.dt)
    {
      pull.acceleration.push_back(acceleration / 2);
      pull.velocity.push_back(acceleration / 2 * t);
    }
    wave.horizontal = pull;
    add_seismic_boundaries(model, case_file, std::make_shared<IncomingWave>(wave), false);
    const double dt = stable_step(case_file, model);
    int step = 0;
    for (; step * dt < time; ++step) advance(model, step * dt, dt);
    const Particles& p = model.main->particles;
    double sheet = 0, rock = 0;
    int clay = 0, below = 0;
    for (int k = 0; k < p.size(); ++k)
    {
      const double moved = p.x[k] - p.reference_x[k], y = p.reference_y[k];
      if (y > 6)
      {
        sheet += moved;
        ++clay;
      }
      else if (y < 4)
      {
        rock += moved;
        ++below;
      }
    }
    return rock / below - sheet / clay;
  };
  const double averaged = slip("averaged") / wanted, sharp = slip("sharp") / wanted;
  CAPTURE(thickness, averaged, sharp);
  CHECK(averaged > (thickness == 2 ? 0.3 : 0.6));
  CHECK(averaged < 1);
  CHECK(sharp < 0.7 * averaged);
}

TEST_CASE("A law that does not admit the softer moduli keeps its own", "[stages]")
{
  // Softening over 8e-4 needs 3 G > (peak - residual) / 8e-4; a mixture with a soil a hundred times softer
  // has not got it.
  std::string text = level_ground(1, 3, 6, 4, 8, 0);
  const std::string from = "model: elastic, density: 2200 kg/m3, young_modulus: 250 MPa, poisson_ratio: 0.25";
  text.replace(text.find(from), from.size(),
               "model: von_mises, density: 2200 kg/m3, young_modulus: 250 MPa, poisson_ratio: 0.25, "
               "strength: {peak: 300 kPa, residual: 100 kPa}, softening: {strain: 0.0008}");
  text.replace(text.find("40 MPa"), 6, "2.5 MPa");
  const Case case_file = case_from(text);
  const Mixed ground = mixed(case_file);
  int kept = 0;
  for (const Material& material : ground.materials)
    if (material.origin == 0) kept += material.elastic().young == case_file.materials[0].elastic().young;
  CHECK(kept > 0);
}

TEST_CASE("Level ground with averaged interfaces and consistent inertia moves as its columns", "[stages]")
{
  // The bound is that of cases/verification/level_site.
  const bool thin = GENERATE(false, true);
  const std::string courant = GENERATE("0.5", "0.78");
  CAPTURE(thin, courant);
  std::string text = level_ground(1, 2, 20, 5, 10, 0);
  if (thin) text = with_thin_layer(text, "[0 m, 5.4 m], [20 m, 5.4 m]");
  const Case case_file = with_options(text, courant);
  Model model = make_model(case_file);
  IncomingWave wave;
  wave.horizontal = pulse(0.1, 0.25, 1);
  add_seismic_boundaries(model, case_file, std::make_shared<IncomingWave>(wave), false);
  const double dt = stable_step(case_file, model);
  const Particles &p = model.main->particles, &q = model.left->domain->particles;
  double apart = 0, peak = 0;
  for (int k = 0; k * dt < 0.6; ++k)
  {
    advance(model, k * dt, dt);
    for (int n = 0; n < p.size(); ++n)
    {
      const int partner = model.left->particle_of_row(model.left->row_near(p.reference_y[n]));
      apart = std::max(apart, std::fabs(p.velocity_x[n] - q.velocity_x[partner]));
      peak = std::max(peak, std::fabs(p.velocity_x[n]));
    }
  }
  INFO("apart " << apart / peak);
  CHECK(peak > 0.1);
  CHECK(apart < 1e-3 * peak);
}

// A free body, so that no boundary takes what averaged moduli might give; bounds as of ragged blocks
// (test_inertia.cpp).
TEST_CASE("Interfaces that crop out and three materials in a cell never gain energy up to 0.78", "[stages]")
{
  const domains::Threads one(1);
  const bool flip = GENERATE(false, true);
  const bool inclined = GENERATE(false, true); // two interfaces that dip at 45 degrees, or a vertical step
  CAPTURE(flip, inclined);
  std::string text = level_ground(1, 2, 12, 4, 8, 0);
  const std::string level = "[[0 m, 4 m], [12 m, 4 m]]";
  text.replace(text.find(level), level.size(),
               inclined ? "[[0 m, 2 m], [3 m, 2 m], [12 m, 11 m]]"
                        : "[[0 m, 2 m], [5.9 m, 2 m], [6.1 m, 11 m], [12 m, 11 m]]");
  text.replace(text.find("below: rockhead"), 15, "below: ground");
  // The regions of rock and soil change places: what lies above rockhead comes first.
  const std::string rock = "  - {material: rock, below: ground}\n";
  text.erase(text.find(rock), rock.size());
  text.insert(text.find("materials:\n  rock"), rock);
  text = with_thin_layer(text, inclined ? "[0 m, 2.6 m], [3 m, 2.6 m], [12 m, 11.6 m]"
                                        : "[0 m, 2.6 m], [5.7 m, 2.6 m], [5.9 m, 11.6 m], [12 m, 11.6 m]");
  text.replace(text.find("thin, above: rockhead, below: middle"), 36, "soil, above: middle, below: ground");
  text.replace(text.find("soil, above: rockhead, below: ground"), 36, "thin, above: rockhead, below: ground");
  const Case case_file = with_options(text, "0.78");
  Model model = make_model(case_file);
  Domain& ground = *model.main;
  REQUIRE(ground.materials.size() > 20); // mixtures of two and of three
  ground.settings.consistent_inertia = true;
  ground.settings.flip = flip;
  ground.settings.filter.time = 3;
  domains::random_velocities(ground, 1e-3, 61);
  domains::random_affine(ground, 1e-3, 62);
  const domains::EnergyShares energy = domains::energy_shares(ground, 1500, stable_step(case_file, model));
  CHECK(energy.greatest < 1 + 1e-6);
  CHECK(energy.last < energy.early);
}
