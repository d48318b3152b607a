#include "boundaries/mirrored_wall.hpp"
#include "solver/mpm/spline.hpp"
#include "test/scenes.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace mpm;
using namespace scenes;

namespace
{
struct Node
{
  double mass = 0, momentum_x = 0, momentum_y = 0, force_x = 0, force_y = 0;
};

/// A particle or an image of one; an image's stress need not be symmetric.
struct Source
{
  double x, y, m, V, vx, vy, gx, gy;
  double C[2][2], stress[2][2];
};

/// The image in a wall: place mirrored, v -> S v, C -> S C M, sigma -> S sigma M, g -> S g.
Source image_of(Source p, const Wall& wall, const Grid& grid)
{
  const double S[] = {wall.image_sign_x(), wall.image_sign_y()};
  const double M[] = {wall.normal == Direction::x ? -1.0 : 1.0, wall.normal == Direction::y ? -1.0 : 1.0};
  if (wall.normal == Direction::x) p.x = 2 * (grid.origin_x + wall.line * grid.spacing) - p.x;
  else p.y = 2 * (grid.origin_y + wall.line * grid.spacing) - p.y;
  p.vx *= S[0];
  p.vy *= S[1];
  p.gx *= S[0];
  p.gy *= S[1];
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
    {
      p.C[a][b] *= S[a] * M[b];
      p.stress[a][b] *= S[a] * M[b];
    }
  return p;
}

using Nodes = std::map<std::pair<int, int>, Node>;

/// Equations (1) and (2), particle by particle.
void scatter(const Source& p, const Grid& grid, Nodes& nodes)
{
  const Stencil sx = cubic_stencil(p.x - grid.origin_x, grid.spacing);
  const Stencil sy = cubic_stencil(p.y - grid.origin_y, grid.spacing);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
    {
      Node& node = nodes[{sx.first + i, sy.first + j}];
      const double w = sx.weight[i] * sy.weight[j], dx = sx.offset[i], dy = sy.offset[j];
      const double wx = sx.slope[i] * sy.weight[j], wy = sx.weight[i] * sy.slope[j];
      node.mass += p.m * w;
      node.momentum_x += p.m * w * (p.vx + p.C[0][0] * dx + p.C[0][1] * dy);
      node.momentum_y += p.m * w * (p.vy + p.C[1][0] * dx + p.C[1][1] * dy);
      node.force_x += p.m * w * p.gx - p.V * (p.stress[0][0] * wx + p.stress[0][1] * wy);
      node.force_y += p.m * w * p.gy - p.V * (p.stress[1][0] * wx + p.stress[1][1] * wy);
    }
}

/// All particles with all their images: one in each wall, and the corners' products.
Nodes with_images(const Domain& domain, const std::vector<Wall>& walls)
{
  Nodes nodes;
  const Particles& p = domain.particles;
  for (int k = 0; k < p.size(); ++k)
  {
    std::vector<Source> family{{p.x[k], p.y[k], p.mass[k], p.volume[k], p.velocity_x[k], p.velocity_y[k],
                                domain.gravity_x, domain.gravity_y,
                                {{p.affine_xx[k], p.affine_xy[k]}, {p.affine_yx[k], p.affine_yy[k]}},
                                {{p.stress_xx[k], p.stress_xy[k]}, {p.stress_xy[k], p.stress_yy[k]}}}};
    for (const Wall& wall : walls)
    {
      const std::size_t known = family.size();
      for (std::size_t m = 0; m < known; ++m) family.push_back(image_of(family[m], wall, domain.grid));
    }
    for (const Source& source : family) scatter(source, domain.grid, nodes);
  }
  return nodes;
}

/// A body in the corner of the lines (-3, 5), growing to the given sides, with everything random.
Domain random_body(int to_x, int to_y)
{
  const double h = 0.7, x = -3 * h, y = 5 * h, width = 9 * h, height = 7 * h;
  const Rectangle place{to_x > 0 ? x : x - width, to_y > 0 ? y : y - height, width, height};
  Domain domain = make_domain({{elastic(), place, h / 2}}, h, 0.49, 71);
  random_velocities(domain, 2, 72);
  random_affine(domain, 3, 73);
  random_stress(domain, 1e5, 74);
  domain.gravity_x = 1.3;
  domain.gravity_y = -9.81;
  return domain;
}

/// Greatest difference of the folded nodes and the sum over explicit images, relative to each field's greatest value,
/// over the nodes on the walls, inside, and up to two lines beyond.
double difference(const std::vector<Wall>& walls, int to_x, int to_y)
{
  const Threads one(1);
  Domain domain = random_body(to_x, to_y);
  for (const Wall& wall : walls) domain.boundaries.push_back(std::make_unique<MirroredWall>(wall));
  sort_particles(domain);
  particles_to_grid(domain, 1e-3);
  for (const auto& boundary : domain.boundaries) boundary->constrain(domain);
  const Grid& g = domain.grid;
  Node scale, error;
  int compared = 0;
  for (const auto& [at, node] : with_images(domain, walls))
  {
    bool wanted = true;
    for (const Wall& wall : walls)
      wanted = wanted && ((wall.normal == Direction::x ? at.first : at.second) - wall.line) * wall.inward >= -2;
    if (!wanted) continue;
    ++compared;
    const int k = g.node(at.first, at.second);
    REQUIRE(k >= 0);
    const auto add = [&](double Node::* member, double value)
    {
      scale.*member = std::max(scale.*member, std::fabs(node.*member));
      error.*member = std::max(error.*member, std::fabs(node.*member - value));
    };
    add(&Node::mass, g.mass[k]);
    add(&Node::momentum_x, g.momentum_x[k]);
    add(&Node::momentum_y, g.momentum_y[k]);
    add(&Node::force_x, g.force_x[k]);
    add(&Node::force_y, g.force_y[k]);
  }
  REQUIRE(compared > 100);
  return std::max({error.mass / scale.mass, error.momentum_x / scale.momentum_x, error.momentum_y / scale.momentum_y,
                   error.force_x / scale.force_x, error.force_y / scale.force_y});
}
} // namespace

// Sums of up to 300 products in another order: 1e-14 or so; the bound leaves a hundred.
TEST_CASE("A folded wall is the body with its mirrored particles", "[boundaries]")
{
  for (const bool slip : {true, false})
    for (const int inward : {1, -1})
    {
      INFO((slip ? "slip" : "no slip") << ", inward " << inward);
      CHECK(difference({{Direction::y, 5, inward, slip}}, 1, inward) < 1e-12);
      CHECK(difference({{Direction::x, -3, inward, slip}}, inward, 1) < 1e-12);
    }
}

TEST_CASE("A corner of two folded walls is the body with three images of each particle", "[boundaries]")
{
  for (const bool base_slips : {true, false})
    for (const bool side_slips : {true, false})
      for (const int inward : {1, -1})
      {
        INFO((base_slips ? "slip" : "no slip") << " base, " << (side_slips ? "slip" : "no slip") << " side");
        const Wall base{Direction::y, 5, 1, base_slips}, side{Direction::x, -3, inward, side_slips};
        CHECK(difference({base, side}, inward, 1) < 1e-12);
        CHECK(difference({side, base}, inward, 1) < 1e-12); // whichever is folded first
      }
}

TEST_CASE("Nothing moves through a wall, nor along one that sticks", "[boundaries]")
{
  const Threads one(1);
  for (const bool slip : {true, false})
  {
    Domain domain = random_body(1, 1);
    domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 5, 1, slip}));
    domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::x, -3, 1, true}));
    sort_particles(domain);
    particles_to_grid(domain, 1e-4);
    solve_grid(domain, 1e-4);
    const Grid& g = domain.grid;
    for (int i = -3; i < 6; ++i)
    {
      REQUIRE(g.mass[g.node(i, 5)] > 0);
      CHECK(g.velocity_y[g.node(i, 5)] == 0);
      CHECK((g.velocity_x[g.node(i, 5)] == 0) == (!slip || i == -3));
    }
    for (int j = 5; j < 12; ++j) CHECK(g.velocity_x[g.node(-3, j)] == 0);
    // The ghosts move as the images, so that particles see a whole field.
    for (int i = -2; i < 6; ++i)
      for (const int depth : {1, 2})
      {
        const int inside = g.node(i, 5 + depth), ghost = g.node(i, 5 - depth);
        CHECK(g.velocity_y[ghost] == -g.velocity_y[inside]);
        CHECK(g.velocity_x[ghost] == (slip ? 1 : -1) * g.velocity_x[inside]);
      }
  }
}

TEST_CASE("A body that slides over many cells stays on its side of the wall", "[boundaries]")
{
  const Threads one(1);
  Domain domain = make_domain({{elastic(), {-4, 5, 8, 4}}});
  domain.boundaries.push_back(std::make_unique<MirroredWall>(Wall{Direction::y, 5, 1, true}));
  sort_particles(domain);
  set_velocity(domain, 10, 0);
  domain.gravity_y = -9.81;
  domain.damping = 0;
  const double dt = 0.5 / elastic().pressure_speed();
  const int steps = 150;
  run(domain, steps, dt);
  const Particles& p = domain.particles;
  double x = 0, lowest = 1e9;
  for (int k = 0; k < p.size(); ++k)
  {
    x += p.x[k] / p.size();
    lowest = std::min(lowest, p.y[k]);
  }
  CHECK(x == Approx(10 * steps * dt).epsilon(1e-10)); // slip: the momentum along the wall stays
  CHECK(lowest > 5);
  // It bounces on its own springs, by no more than twice its settlement rho g H^2 / 2 M = 0.12 m, and back.
  CHECK(lowest < 5.5);
}
