#include "solver/mpm/gauges.hpp"

#include "solver/mpm/spline.hpp"

#include <cmath>

namespace mpm
{
namespace
{
/// Share of the lightest ground's density below which a gauge is not in the ground any more. A surface has a
/// half, the edge of a vertical cut a quarter, a particle that flies alone, one of four of its cell, a
/// twentieth; the nodes' velocities are then that one particle's, far beyond where it is.
constexpr double least_density = 0.1;

/// Strain at which a kink begins to fade, and where nothing of it is left: elastic ground does not get there,
/// and where a slide shears the interface its materials may not be neighbours any more.
constexpr double kink_fades = 0.05, kink_gone = 0.1;

/// Velocity of the field at a gauge, m/s, and its gradient, 1/s.
struct FieldMotion
{
  double vx = 0, vy = 0, xx = 0, xy = 0, yx = 0, yy = 0;
};

/// What the velocity of the ground at a kink differs by from the field's, in x and y; notes the strain.
std::array<double, 2> bend(Kink& kink, const FieldMotion& f, double dt)
{
  const double nx = kink.normal_x, ny = kink.normal_y;
  const double normal = nx * (f.xx * nx + f.xy * ny) + ny * (f.yx * nx + f.yy * ny);
  const double lateral = f.xx + f.yy - normal;
  const double shear = (f.yy - f.xx) * 2 * nx * ny + (f.xy + f.yx) * (nx * nx - ny * ny); // 2 n.D t
  kink.stretch += dt * normal;
  kink.slip += dt * shear;
  const double strain = std::hypot(kink.stretch, kink.slip);
  const double left = std::clamp((kink_gone - strain) / (kink_gone - kink_fades), 0.0, 1.0);
  const double along_n = left * (kink.normal * normal + kink.lateral * lateral);
  const double along_t = left * kink.shear * shear;
  return {-along_n * nx + along_t * ny, -along_n * ny - along_t * nx};
}

/// Moves a gauge with the velocity of the ground there, sum w v* / sum w over the nodes that have mass,
/// and of its kink. Where the ground is torn to pieces it flies, where the ground sleeps it stands still.
void move(Gauge& gauge, const Domain& domain, double density, NodeFinder& find, double dt)
{
  const Grid& grid = domain.grid;
  const Stencil sx = cubic_stencil(gauge.x - grid.origin_x, grid.spacing);
  const Stencil sy = cubic_stencil(gauge.y - grid.origin_y, grid.spacing);
  find.move_to(sx.first, sy.first);
  double weight = 0, mass = 0, slope_x = 0, slope_y = 0;
  FieldMotion f; // sums
  bool rests = false;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
    {
      const int node = find(sx.first + i, sy.first + j);
      if (node < 0) continue;
      const int occupied = domain.blocks.occupied_in[node / block_nodes];
      rests |= occupied >= 0 && domain.blocks.occupied[occupied].asleep;
      if (grid.mass[node] <= 0) continue;
      const double w = sx.weight[i] * sy.weight[j];
      weight += w;
      mass += w * grid.mass[node];
      const double dx = sx.slope[i] * sy.weight[j], dy = sx.weight[i] * sy.slope[j];
      const double vx = grid.velocity_x[node], vy = grid.velocity_y[node];
      slope_x += dx;
      slope_y += dy;
      f.vx += w * vx;
      f.vy += w * vy;
      f.xx += dx * vx;
      f.xy += dy * vx;
      f.yx += dx * vy;
      f.yy += dy * vy;
    }
  const bool flies = !rests && mass < least_density * density * grid.spacing * grid.spacing;
  if (flies)
  {
    gauge.velocity_x += dt * domain.settings.gravity_x;
    gauge.velocity_y += dt * domain.settings.gravity_y;
  }
  else
  {
    gauge.velocity_x = weight > 0 ? f.vx / weight : 0;
    gauge.velocity_y = weight > 0 ? f.vy / weight : 0;
    if (gauge.kink.shear > 0)
    {
      // Nodes without mass are missing: what remains of the slopes is taken off with the mean velocity.
      f.xx -= slope_x * gauge.velocity_x;
      f.xy -= slope_y * gauge.velocity_x;
      f.yx -= slope_x * gauge.velocity_y;
      f.yy -= slope_y * gauge.velocity_y;
      const auto [x, y] = bend(gauge.kink, f, dt);
      gauge.velocity_x += x;
      gauge.velocity_y += y;
    }
  }
  gauge.x += dt * gauge.velocity_x;
  gauge.y += dt * gauge.velocity_y;
}
} // namespace

void move_gauges(Domain& domain, double dt)
{
  double lightest = std::numeric_limits<double>::infinity();
  for (const Material& material : domain.materials) lightest = std::min(lightest, material.elastic().density);
  NodeFinder find(domain.grid);
  for (Gauge& gauge : domain.gauges)
    if (!std::isnan(gauge.x)) move(gauge, domain, lightest, find, dt);
}
} // namespace mpm
