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
/// greatest displacement component in cells, infinity when a gradient is
/// not a number or deforms the material wholly within the step.
double gather(Particles& p, int begin, int count, const ChunkWeights& w, const Velocities& velocities,
              double spacing, double dt, VelocityGradients& L)
{
  const double inverse_D = 3 / (spacing * spacing);
  double greatest = 0;
  const double calmest = greatest_gradient / dt;
  bool calm = true;
  for (int k = 0; k < count; ++k)
  {
    const int q = begin + k;
    const Row wx = load_row(&w.x[4 * k]), dwx = load_row(&w.slope_x[4 * k]);
    const Row wx_dx = wx * load_row(&w.offset_x[4 * k]);
    Row ux{}, ux_dy{}, ux_dw{}, uy{}, uy_dy{}, uy_dw{};
    for (int j = 0; j < 4; ++j)
    {
      const double wy = w.y[4 * k + j], dwy = w.slope_y[4 * k + j], wdy = wy * w.offset_y[4 * k + j];
      const int node = w.tile[k] + j * tile_stride;
      const Row vx = load_row(&velocities.x.value[node]), vy = load_row(&velocities.y.value[node]);
      ux += wy * vx;
      ux_dy += wdy * vx;
      ux_dw += dwy * vx;
      uy += wy * vy;
      uy_dy += wdy * vy;
      uy_dw += dwy * vy;
    }
    const double vx = sum(wx * ux), vy = sum(wx * uy);
    p.velocity_x[q] = vx;
    p.velocity_y[q] = vy;
    p.affine_xx[q] = inverse_D * sum(wx_dx * ux);
    p.affine_xy[q] = inverse_D * sum(wx * ux_dy);
    p.affine_yx[q] = inverse_D * sum(wx_dx * uy);
    p.affine_yy[q] = inverse_D * sum(wx * uy_dy);
    L.xx[k] = sum(dwx * ux);
    L.xy[k] = sum(wx * ux_dw);
    L.yx[k] = sum(dwx * uy);
    L.yy[k] = sum(wx * uy_dw);
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
  ChunkWeights weights;
  VelocityGradients gradients;
  Particles& p = domain.particles;
  double greatest = 0;
  for_each_chunk(home,
                 [&](int material, int begin, int count)
                 {
                   find_weights(grid, home.block, &p.x[begin], &p.y[begin], count, weights);
                   const double move =
                       gather(p, begin, count, weights, velocities, grid.spacing, dt, gradients);
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
