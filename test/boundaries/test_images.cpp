#include "boundaries/frozen_images.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace domains;

namespace
{
/// A random stressed block that fills the corners between a sticking base and two slipping sides (or sticking
/// ones).
Domain random_block()
{
  const double h = 0.7;
  Domain domain = make_domain({{elastic(), {-3 * h, 5 * h, 14 * h, 9 * h}, h / 2}}, h, 0.49, 81);
  random_stress(domain, 1e5, 82);
  return domain;
}

std::vector<Wall> walls(bool base_slips, bool sides_slip)
{
  return {{Direction::y, 5, 1, base_slips},
          {Direction::x, -3, 1, sides_slip},
          {Direction::x, 11, -1, sides_slip}};
}

/// Greatest difference of the forces at nodes with real mass between folded walls and the images made of
/// them, relative to the greatest force.
double difference(const std::vector<Wall>& walls, double gravity_x, double gravity_y)
{
  const Threads one(1);
  Domain folded = random_block();
  folded.settings.gravity_x = gravity_x;
  folded.settings.gravity_y = gravity_y;
  Domain freed = same_particles(folded);
  for (const Wall& wall : walls) folded.boundaries.push_back(std::make_unique<MirroredWall>(wall));
  sort_particles(folded);
  particles_to_grid(folded, 1e-3);
  for (const auto& boundary : folded.boundaries) boundary->constrain(folded.grid);

  freed.boundaries.push_back(std::make_unique<FrozenImages>(make_images(folded, walls)));
  sort_particles(freed);
  particles_to_grid(freed, 1e-3);
  REQUIRE(freed.grid.blocks == folded.grid.blocks);
  double scale = 0, error = 0;
  int compared = 0;
  for (int k = 0; k < freed.grid.nodes(); ++k)
  {
    if (freed.grid.mass[k] <= 0) continue;
    ++compared;
    scale = std::max({scale, std::fabs(folded.grid.force_x[k]), std::fabs(folded.grid.force_y[k])});
    error = std::max({error, std::fabs(folded.grid.force_x[k] - freed.grid.force_x[k]),
                      std::fabs(folded.grid.force_y[k] - freed.grid.force_y[k])});
  }
  REQUIRE(compared > 180); // random particles need not reach the outermost lines
  return error / scale;
}
} // namespace

// Sums of up to 300 products in another order: 1e-14 or so; the bound leaves a hundred.
TEST_CASE("Frozen images give the forces of the walls that they replace, corners too", "[boundaries]")
{
  for (const bool base_slips : {false, true})
    for (const bool sides_slip : {false, true})
    {
      INFO((base_slips ? "slip" : "no slip") << " base, " << (sides_slip ? "slip" : "no slip") << " sides");
      CHECK(difference(walls(base_slips, sides_slip), 0, 0) < 1e-12);
      CHECK(difference(walls(base_slips, sides_slip), 0.4, -9.81) < 1e-12);
    }
}

TEST_CASE("Only particles within four cells of a wall have images, corners three", "[boundaries]")
{
  const Domain domain = random_block();
  const std::vector<Wall> all = walls(false, true);
  const Images images = make_images(domain, all);
  const Particles& p = domain.particles;
  std::vector<int> count(p.size(), 0);
  for (const Image& image : images.list) ++count[image.parent];
  for (int id = 0; id < p.size(); ++id)
  {
    const int k = domain.particles.index_of[id];
    const double h = domain.grid.spacing;
    const bool base = p.y[k] < 9 * h, side = p.x[k] < h || p.x[k] > 7 * h;
    REQUIRE(count[id] == (base && side ? 3 : base || side ? 1 : 0));
  }
}

TEST_CASE("An image stands opposite its parent and carries the mirrored stress and weight", "[boundaries]")
{
  const Threads one(1);
  const double h = 1;
  Domain domain = make_domain({{elastic(), {2, 7, 0.5, 0.5}}}, h);
  domain.settings.gravity_x = 2;
  domain.settings.gravity_y = -9;
  Particles& p = domain.particles;
  p.stress_xx[0] = 3;
  p.stress_yy[0] = 5;
  p.stress_xy[0] = 7;
  const double V = p.volume[0], m = p.mass[0];
  const std::vector<Wall> sticks{{Direction::y, 5, 1, false}}, slips{{Direction::y, 5, 1, true}};
  const Images sticking = make_images(domain, sticks), slipping = make_images(domain, slips);
  const Image& image = sticking.list.at(0);
  const ImageLoad &stuck = sticking.loads.at(0), &slid = slipping.loads.at(0);
  CHECK(p.y[0] + image.offset[1] == Approx(2.75).epsilon(1e-14));
  CHECK(image.offset[0] == 0);
  // Sigma* = S Sigma M with S = -1, M = diag(1, -1): [-xx, xy; -xy, yy].
  CHECK(stuck.stress_x[0] == -3 * V);
  CHECK(stuck.stress_y[0] == 7 * V);
  CHECK(stuck.stress_x[1] == -7 * V);
  CHECK(stuck.stress_y[1] == 5 * V);
  CHECK(stuck.weight[0] == -2 * m);
  CHECK(stuck.weight[1] == 9 * m);
  CHECK(slid.stress_x[0] == 3 * V);
  CHECK(slid.stress_y[0] == -7 * V);
  CHECK(slid.stress_x[1] == -7 * V);
  CHECK(slid.stress_y[1] == 5 * V);
  CHECK(slid.weight[0] == 2 * m);
  CHECK(slid.weight[1] == 9 * m);
}

TEST_CASE("Images move with the body: their resultant stays when the body is shifted by part of a cell",
          "[boundaries]")
{
  const Threads one(1);
  const std::vector<Wall> all = walls(false, true);
  Domain domain = random_block();
  domain.settings.gravity_y = -9.81;
  domain.boundaries.push_back(std::make_unique<FrozenImages>(make_images(domain, all)));
  sort_particles(domain);
  const auto resultant = [&]
  {
    particles_to_grid(domain, 1e-3);
    std::array<double, 2> sum{};
    for (int k = 0; k < domain.grid.nodes(); ++k)
    {
      sum[0] += domain.grid.force_x[k];
      sum[1] += domain.grid.force_y[k];
    }
    return sum;
  };
  const auto first = resultant();
  const double scale = 1e5 * 14 * domain.grid.spacing; // the stress times the width of the base
  for (double& x : domain.particles.x) x += 0.37 * domain.grid.spacing;
  for (double& y : domain.particles.y) y -= 0.41 * domain.grid.spacing;
  const auto second = resultant();
  // What is lost is given back as a uniform acceleration, to the round-off of sums of a few hundred forces.
  CHECK(std::fabs(second[0] - first[0]) / scale < 1e-12);
  CHECK(std::fabs(second[1] - first[1]) / scale < 1e-12);
}

TEST_CASE("Images that sleeping ground hides leave the forces on waking ground as they are, bit by bit",
          "[boundaries]")
{
  const Threads one(1);
  Domain awake = make_domain({{elastic(), {0, 0, 96, 16}}});
  random_stress(awake, 1e5, 83);
  Domain half = same_particles(awake);
  const std::vector<Wall> base{{Direction::y, 0, 1, false}};
  for (Domain* domain : {&awake, &half})
    domain->boundaries.push_back(std::make_unique<FrozenImages>(make_images(*domain, base)));
  sort_particles(awake);
  sort_particles(half);
  for (OccupiedBlock& occupied : half.blocks.occupied) occupied.asleep = occupied.block.x < 6;
  bind_rest(half);
  particles_to_grid(awake, 1e-3);
  particles_to_grid(half, 1e-3);
  std::vector<bool> held(half.grid.nodes(), false);
  for (const int node : half.rest.held) held[node] = true;
  int compared = 0;
  for (int node = 0; node < half.grid.nodes(); ++node)
  {
    if (half.grid.mass[node] <= 0 || held[node]) continue;
    ++compared;
    CHECK(half.grid.force_x[node] == awake.grid.force_x[node]);
    CHECK(half.grid.force_y[node] == awake.grid.force_y[node]);
  }
  CHECK(compared > 40 * 16); // from x = 52 m on
}
