// Scaled masses: the same equilibrium in fewer steps.

#include "solver/mpm/step.hpp"
#include "test/stages/ground.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::test;

namespace
{
struct Settled
{
  Model model;
  double step; ///< s
};

Settled settled(const Case& case_file, bool scaled)
{
  Settled result{make_model(case_file), 0};
  if (scaled) scale_masses(result.model);
  result.step = stable_step(case_file, result.model);
  relax(result.model, case_file, 6, true);
  Domain& main = *result.model.main;
  main.settings.measure_force_balance = true;
  advance(result.model, 6, result.step);
  return result;
}
} // namespace

TEST_CASE("scaled masses settle soil on rock to the same state in longer steps", "[stages]")
{
  const Case case_file = case_from(level_ground(1, 2, 8, 4, 8, 9.81));
  const Settled plain = settled(case_file, false), scaled = settled(case_file, true);
  const Domain &a = *plain.model.main, &b = *scaled.model.main;

  // The rock's waves are made as slow as the soil's.
  const double rock = case_file.materials[0].elastic().pressure_speed(),
               soil = case_file.materials[1].elastic().pressure_speed();
  CHECK(scaled.step / plain.step == Approx(rock / soil).epsilon(0.01)); // densities of now differ by strains

  CHECK(a.measures.force_balance.ratio() < 1e-5);
  CHECK(b.measures.force_balance.ratio() < 1e-5);
  // Two states, each in balance to 1e-5 of the weight, differ by about as much: stress here, settlement
  // below.
  double stress = 0, settlement = 0, stress_scale = 0, settlement_scale = 0;
  for (int id = 0; id < a.particles.size(); ++id)
  {
    const int k = a.particles.index_of[id], l = b.particles.index_of[id];
    stress_scale = std::max(stress_scale, std::fabs(a.particles.stress_yy[k]));
    stress = std::max(stress, std::fabs(a.particles.stress_yy[k] - b.particles.stress_yy[l]));
    settlement_scale = std::max(settlement_scale, std::fabs(a.particles.y[k] - a.particles.reference_y[k]));
    settlement = std::max(settlement, std::fabs(a.particles.y[k] - b.particles.y[l]));
  }
  CHECK(stress < 1e-4 * stress_scale);
  CHECK(settlement < 1e-4 * settlement_scale);
}

TEST_CASE("the weight of scaled masses stays what it was", "[stages]")
{
  const Case case_file = case_from(level_ground(1, 2, 8, 4, 8, 9.81));
  Model model = make_model(case_file);
  scale_masses(model);
  Domain& main = *model.main;
  main.settings.gravity_y = -9.81;
  particles_to_grid(main, 1e-4);
  double force = 0, mass = 0;
  for (const double f : main.grid.force_y) force += f;
  for (const double m : main.particles.mass) mass += m;
  CHECK(force == Approx(-9.81 * mass).epsilon(1e-12));
}
