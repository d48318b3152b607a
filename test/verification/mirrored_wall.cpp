#include "test/verification/cases.hpp"

#include "boundaries/mirrored_wall.hpp"
#include "solver/mpm/spline.hpp"
#include "test/domains.hpp"

#include <map>

namespace mpm::verification
{
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
  if (wall.normal == Direction::x)
    p.x = 2 * (grid.origin_x + wall.line * grid.spacing) - p.x;
  else
    p.y = 2 * (grid.origin_y + wall.line * grid.spacing) - p.y;
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
    std::vector<Source> family{{p.x[k],
                                p.y[k],
                                p.mass[k],
                                p.volume[k],
                                p.velocity_x[k],
                                p.velocity_y[k],
                                domain.settings.gravity_x,
                                domain.settings.gravity_y,
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

/// Greatest difference of the folded nodes and the sum over explicit images, relative to each field's
/// greatest value, over the nodes on the walls, inside, and up to two lines beyond.
double difference(double h, const std::vector<Wall>& walls, int to_x, int to_y)
{
  Domain domain = domains::random_corner(h, to_x, to_y);
  for (const Wall& wall : walls) domain.boundaries.push_back(std::make_unique<MirroredWall>(wall));
  sort_particles(domain);
  particles_to_grid(domain, 1e-3);
  for (const auto& boundary : domain.boundaries) boundary->constrain(domain.grid);
  const Grid& g = domain.grid;
  Node scale, error;
  int compared = 0;
  for (const auto& [at, node] : with_images(domain, walls))
  {
    bool wanted = true;
    for (const Wall& wall : walls)
      wanted =
          wanted && ((wall.normal == Direction::x ? at.first : at.second) - wall.line) * wall.inward >= -2;
    if (!wanted) continue;
    ++compared;
    const int k = g.node(at.first, at.second);
    if (k < 0) throw std::runtime_error("mirrored_wall: a node that images reach does not exist");
    const auto add = [&, &node = node](double Node::*member, double value)
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
  if (compared < 100) throw std::runtime_error("mirrored_wall: too few nodes to compare");
  return std::max({error.mass / scale.mass, error.momentum_x / scale.momentum_x,
                   error.momentum_y / scale.momentum_y, error.force_x / scale.force_x,
                   error.force_y / scale.force_y});
}
} // namespace

Findings run_mirrored_wall(const std::filesystem::path&, double h)
{
  const domains::Threads one(1);
  double slip = 0, stick = 0, corner = 0;
  for (const int inward : {1, -1})
  {
    for (const bool slips : {true, false})
    {
      double& wall = slips ? slip : stick;
      wall = std::max({wall, difference(h, {{Direction::y, 5, inward, slips}}, 1, inward),
                       difference(h, {{Direction::x, -3, inward, slips}}, inward, 1)});
      for (const bool side_slips : {true, false})
      {
        const Wall base{Direction::y, 5, 1, slips}, side{Direction::x, -3, inward, side_slips};
        // Whichever is folded first.
        corner = std::max(
            {corner, difference(h, {base, side}, inward, 1), difference(h, {side, base}, inward, 1)});
      }
    }
  }
  return {{{"slip", slip}, {"no slip", stick}, {"corner", corner}}, {}};
}
} // namespace mpm::verification
