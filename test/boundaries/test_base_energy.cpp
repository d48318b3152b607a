#include "boundaries/free_field.hpp"
#include "boundaries/mirrored_wall.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

#include <numeric>

using namespace mpm;
using namespace domains;

namespace
{
constexpr double width = 4, height = 3; // of the ground, cells of 1 m with 2 x 2 particles

struct Trial
{
  double contrast, strength; ///< stiffness of the lower half over that of the upper; of the dashpots
  double x, y;               ///< where the corner stands in a cell, m
  double move_x, move_y;     ///< of the ground over the grid in a step, m
  bool flip;
  double courant_number; ///< of the stiff half
};

std::vector<Body> halves(const Trial& t, double left, double across)
{
  const Law stiff = elastic(1e6 * t.contrast, 0.3, 2300), soft = elastic(1e6, 0.3, 1700);
  const double half = 0.5 * height;
  return {{stiff, {left, t.y, across, half}}, {soft, {left, t.y + half, across, half}}};
}

/// Puts a domain with consistent inertia on a compliant base that nothing drives.
const CompliantBase* put_on_base(Domain& domain, const Trial& t)
{
  std::vector<Face> faces = find_faces(domain, Edge::bottom, t.y, 0.5);
  for (Face& face : faces)
  {
    face.dashpot_x *= t.strength;
    face.dashpot_y *= t.strength;
  }
  domain.settings.consistent_inertia = true;
  domain.settings.flip = t.flip;
  domain.settings.filter.time = 3;
  auto base =
      std::make_unique<CompliantBase>(std::move(faces), std::make_shared<IncomingWave>(), BaseSpring(0));
  const CompliantBase* const result = base.get();
  domain.boundaries.push_back(std::move(base));
  return result;
}

void shake(Domain& domain, unsigned seed)
{
  random_velocities(domain, 1e-3, seed);
  random_affine(domain, 1e-3, seed + 1);
}

/// Moves the ground over the grid, which changes nothing for the ground.
void carry(Domain& domain, double x, double y)
{
  for (double& at : domain.particles.x) at += x;
  for (double& at : domain.particles.y) at += y;
  domain.blocks.drift += std::max(std::fabs(x), std::fabs(y));
}

constexpr int settled = 20; // steps after which the transfers have filtered what is random

/// What a trial came to: greatest energies over those at the start, and of those after twice `settled` steps
/// over those at `settled`; of the ground and of the columns.
struct Outcome
{
  double greatest = 0, later = 0;

  void watch(int step, double energy, double start, double& at_settled)
  {
    if (!std::isfinite(energy)) throw std::runtime_error("the run blew up");
    greatest = std::max(greatest, energy / start);
    if (step == settled) at_settled = energy;
    if (step >= 2 * settled) later = std::max(later, energy / at_settled);
  }
};

/// Nothing in a column or between the walls of the ground may gain energy; what ground has that feels a
/// column's motion is less what the column brought, and tells nothing later on.
Outcome run_trial(const std::string& sides, const Trial& t, unsigned seed)
{
  Domain ground = make_domain(halves(t, t.x, width), 1, 0.3, seed);
  std::vector<std::unique_ptr<FreeFieldColumn>> columns;
  std::vector<FreeFieldSide*> added;
  if (sides == "roller")
    for (const int line : {0, static_cast<int>(width)})
      ground.boundaries.push_back(
          std::make_unique<MirroredWall>(Wall{Direction::x, line, line == 0 ? 1 : -1, true}));
  put_on_base(ground, t);
  for (const Edge edge : {Edge::left, Edge::right})
  {
    if (sides == "roller") break;
    if (sides == "free_field")
    {
      auto column = std::make_unique<Domain>(make_domain(halves(t, 0, 1), 1, 0, seed));
      column->grid.wrapped = true;
      const CompliantBase* const base = put_on_base(*column, t);
      sort_particles(*column);
      shake(*column, seed + (edge == Edge::left ? 3 : 5));
      columns.push_back(std::make_unique<FreeFieldColumn>(std::move(column), 0));
      columns.back()->compliant_base = base;
    }
    auto side = std::make_unique<FreeFieldSide>(edge, columns.empty() ? nullptr : columns.back().get(),
                                                std::make_shared<IncomingWave>());
    side->begin(ground, t.x + (edge == Edge::left ? 0 : width), t.y, 0.5);
    ground.boundaries.push_back(std::move(side));
  }
  sort_particles(ground);
  shake(ground, seed + 7);
  open_energy_balance(ground);
  std::vector<double> starts, at_settled(1 + columns.size());
  for (const auto& column : columns) starts.push_back(kinetic_energy(*column->domain));
  const double own = kinetic_energy(ground), all = std::accumulate(starts.begin(), starts.end(), own),
               dt = t.courant_number / elastic(1e6 * t.contrast, 0.3, 2300).pressure_speed();
  Outcome outcome, fed;
  for (int k = 0; k < 200; ++k)
  {
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      Domain& column = *columns[c]->domain;
      carry(column, 0, t.move_y);
      columns[c]->advance(k * dt, dt);
      outcome.watch(k, kinetic_energy(column) + strain_energy(column), starts[c], at_settled[1 + c]);
    }
    carry(ground, sides == "roller" ? 0 : t.move_x, t.move_y);
    ground.time = k * dt;
    step(ground, dt);
    (columns.empty() ? outcome : fed)
        .watch(k, own + unexplained_growth(energies_of(ground)), all, at_settled[0]);
  }
  outcome.greatest = std::max(outcome.greatest, fed.greatest);
  return outcome;
}
} // namespace

TEST_CASE("A base gives no energy whatever its sides, wherever its face stands and however it moves",
          "[boundaries][long]")
{
  const Threads one(1);
  const std::string sides = GENERATE("roller", "quiet", "free_field");
  Random random(sides.size());
  Outcome worst;
  for (unsigned k = 0; k < 334; ++k)
  {
    const auto up_to = [&](double most) { return std::pow(most, random(0, 1)); };
    Trial t{};
    t.contrast = up_to(1e4);
    t.strength = up_to(1e3);
    t.x = sides == "roller" ? 0 : random(0, 1);
    t.y = random(0, 1);
    t.move_x = random(-0.08, 0.08);
    t.move_y = random(-0.08, 0.08);
    t.flip = random(0, 1) >= 0.5;
    t.courant_number = random(0.3, 0.78);
    const Outcome outcome = run_trial(sides, t, 100 + 10 * k);
    CAPTURE(sides, k, t.contrast, t.strength, t.x, t.y, t.move_x, t.move_y, t.flip, t.courant_number);
    CHECK(outcome.greatest < 1 + 1e-6);
    // With FLIP what no node feels comes and goes for some thousand steps before it is filtered: up to 1.16
    // of the energy at 200 steps is there at 400, 0.81 of that at 1000 after 10 000.
    if (!t.flip) CHECK(outcome.later < 1);
    worst.greatest = std::max(worst.greatest, outcome.greatest);
    worst.later = std::max(worst.later, outcome.later);
  }
  SUCCEED(sides << ": greatest energy " << worst.greatest << ", later " << worst.later);
}
