#include "solver/mpm/chunk.hpp"

namespace mpm
{
namespace
{
/// dt |L| beyond which a step has lost the motion.
constexpr double greatest_gradient = 1;

struct Velocities
{
  Tile x, y;
};

/// v = sum w v, C = D^-1 sum w v (x_i - x)^T (eq. 3) and L = sum v grad w; moves the particles. Returns the
/// greatest displacement component in cells, infinity when a gradient is not a number or deforms the material
/// wholly within the step.
double gather(Particles& p, int begin, int count, const TileStencils& stencils, const Velocities& velocities,
              double spacing, double dt, VelocityGradients& L)
{
  const double inverse_D = 3 / (spacing * spacing);
  double greatest = 0;
  const double calmest = greatest_gradient / dt;
  bool calm = true;
  for (int k = 0; k < count; ++k)
  {
    const int q = begin + k;
    const auto x = stencils.x(p.x[q]), y = stencils.y(p.y[q]);
    const int first = TileStencils::first_node(x, y);
    const Row wx = x.weight, dwx = x.slope, wx_dx = x.weight * x.offset, y_moment = y.weight * y.offset;
    Row ux{}, ux_dy{}, ux_dw{}, uy{}, uy_dy{}, uy_dw{};
    for (int j = 0; j < 4; ++j)
    {
      const double wy = y.weight[j], dwy = y.slope[j], wdy = y_moment[j];
      const int node = first + j * tile_stride;
      const Row vx = load_row(&velocities.x.value[node]), vy = load_row(&velocities.y.value[node]);
      ux += wy * vx;
      ux_dy += wdy * vx;
      ux_dw += dwy * vx;
      uy += wy * vy;
      uy_dy += wdy * vy;
      uy_dw += dwy * vy;
    }
    const Row velocity_and_gradient = sums(wx * ux, wx * uy, dwx * ux, dwx * uy);
    const Row affine = inverse_D * sums(wx_dx * ux, wx * ux_dy, wx_dx * uy, wx * uy_dy);
    const Row gradient_y = sums(wx * ux_dw, wx * uy_dw, Row{}, Row{});
    const double vx = velocity_and_gradient[0], vy = velocity_and_gradient[1];
    p.velocity_x[q] = vx;
    p.velocity_y[q] = vy;
    p.affine_xx[q] = affine[0];
    p.affine_xy[q] = affine[1];
    p.affine_yx[q] = affine[2];
    p.affine_yy[q] = affine[3];
    L.xx[k] = velocity_and_gradient[2];
    L.yx[k] = velocity_and_gradient[3];
    L.xy[k] = gradient_y[0];
    L.yy[k] = gradient_y[1];
    p.x[q] += dt * vx;
    p.y[q] += dt * vy;
    const double move = std::max(std::fabs(vx), std::fabs(vy));
    calm =
        calm && std::fabs(L.xx[k]) + std::fabs(L.xy[k]) + std::fabs(L.yx[k]) + std::fabs(L.yy[k]) <= calmest;
    greatest = std::max(greatest, move);
  }
  return calm ? greatest * dt / spacing : std::numeric_limits<double>::infinity();
}

double update_home(Domain& domain, const Home& home, double dt)
{
  const Grid& grid = domain.grid;
  Velocities velocities;
  read_tile(grid, home.around, grid.velocity_x, velocities.x);
  read_tile(grid, home.around, grid.velocity_y, velocities.y);
  const TileStencils stencils(grid, home.block);
  VelocityGradients gradients;
  Particles& p = domain.particles;
  double greatest = 0;
  for_each_chunk(home,
                 [&](int material, int begin, int count)
                 {
                   const double move =
                       gather(p, begin, count, stencils, velocities, grid.spacing, dt, gradients);
                   update_particles(domain, material, begin, count, gradients, dt);
                   greatest = std::max(greatest, move);
                 });
  return greatest;
}

/// Moves a gauge with the velocity of the ground at its place; nodes without mass are left out of the mean.
void move(Tracer& tracer, const Grid& grid, NodeFinder& find, double dt)
{
  const Stencil sx = cubic_stencil(tracer.x - grid.origin_x, grid.spacing);
  const Stencil sy = cubic_stencil(tracer.y - grid.origin_y, grid.spacing);
  find.move_to(sx.first, sy.first);
  double weight = 0, vx = 0, vy = 0;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
    {
      const int node = find(sx.first + i, sy.first + j);
      if (node < 0 || grid.mass[node] <= 0) continue;
      const double w = sx.weight[i] * sy.weight[j];
      weight += w;
      vx += w * grid.velocity_x[node];
      vy += w * grid.velocity_y[node];
    }
  if (weight == 0) return;
  tracer.velocity_x = vx / weight;
  tracer.velocity_y = vy / weight;
  tracer.x += dt * tracer.velocity_x;
  tracer.y += dt * tracer.velocity_y;
}
} // namespace

void grid_to_particles(Domain& domain, double dt)
{
  std::vector<double> moves(domain.homes.size());
  parallel::for_each(static_cast<int>(domain.homes.size()),
                     [&](int k) { moves[k] = update_home(domain, domain.homes[k], dt); });
  domain.greatest_move = moves.empty() ? 0 : *std::max_element(moves.begin(), moves.end());
  NodeFinder find(domain.grid);
  for (Tracer& tracer : domain.tracers) move(tracer, domain.grid, find, dt);
}
} // namespace mpm
