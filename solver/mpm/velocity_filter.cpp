#include "solver/mpm/chunk.hpp"
#include "solver/mpm/filters.hpp"

#include <memory>

namespace mpm
{
namespace
{
constexpr int times = 10; ///< how often a filter's time is filtered

/// Velocities and affine matrices of all particles.
struct Motion
{
  explicit Motion(int particles) : value(std::make_unique_for_overwrite<double[]>(6 * particles)) {}
  double* operator[](int p) { return &value[6 * p]; }
  const double* operator[](int p) const { return &value[6 * p]; }
  std::unique_ptr<double[]> value; ///< v_x, v_y, C_xx, C_xy, C_yx, C_yy of one particle after the other
};

struct NodeMotion
{
  NodeField mass, momentum_x, momentum_y;
};

/// m_i = sum w m and P_i = sum w m (v + C (x_i - x)) of a block (eq. 2).
void add_block(const Domain& domain, const OccupiedBlock& occupied, const Motion& motion, NodeMotion& nodes)
{
  const Particles& particles = domain.particles;
  const TileStencils tile(domain.grid, occupied.block);
  Tile mass, x, y;
  for (Tile* t : {&mass, &x, &y}) t->value.fill(0);
  for_each_particle(occupied,
                    [&](int p)
                    {
                      const Stencil sx = tile.x(particles.x[p]), sy = tile.y(particles.y[p]);
                      const double* q = motion[p];
                      const Row w = particles.mass[p] * sx.weight;
                      const Row across_x = w * (q[0] + q[2] * sx.offset),
                                across_y = w * (q[1] + q[4] * sx.offset);
                      for (int j = 0; j < 4; ++j)
                      {
                        const int node = TileStencils::first_node(sx, sy) + j * tile_stride;
                        const double wy = sy.weight[j], dy = sy.offset[j];
                        store(&mass.value[node], load_as<Row>(&mass.value[node]) + wy * w);
                        store(&x.value[node], load_as<Row>(&x.value[node]) + wy * (across_x + q[3] * dy * w));
                        store(&y.value[node], load_as<Row>(&y.value[node]) + wy * (across_y + q[5] * dy * w));
                      }
                    });
  add_tile(domain.grid, occupied.around, mass, nodes.mass);
  add_tile(domain.grid, occupied.around, x, nodes.momentum_x);
  add_tile(domain.grid, occupied.around, y, nodes.momentum_y);
}

/// Takes what the nodes give back, v = sum w v_i and C = 3 / h^2 sum w v_i (x_i - x)^T (eq. 3), from a
/// block's motion.
void take_block(const Domain& domain, const OccupiedBlock& occupied, const NodeMotion& nodes, Motion& motion)
{
  const Particles& particles = domain.particles;
  const Grid& grid = domain.grid;
  const TileStencils tile(grid, occupied.block);
  const double affine = 3 / (grid.spacing * grid.spacing);
  PairTile velocity;
  read_tile(grid, occupied.around, nodes.momentum_x, nodes.momentum_y, velocity);
  for_each_particle(occupied,
                    [&](int p)
                    {
                      const Stencil sx = tile.x(particles.x[p]), sy = tile.y(particles.y[p]);
                      double sum[6]{};
                      for (int j = 0; j < 4; ++j)
                      {
                        const double* v =
                            &velocity.value[2 * (TileStencils::first_node(sx, sy) + j * tile_stride)];
                        double row[4]{};
                        for (int i = 0; i < 4; ++i)
                        {
                          const double w = sx.weight[i], d = w * sx.offset[i];
                          row[0] += w * v[2 * i];
                          row[1] += w * v[2 * i + 1];
                          row[2] += d * v[2 * i];
                          row[3] += d * v[2 * i + 1];
                        }
                        const double wy = sy.weight[j], dy = wy * sy.offset[j];
                        sum[0] += wy * row[0];
                        sum[1] += wy * row[1];
                        sum[2] += wy * row[2];
                        sum[3] += dy * row[0];
                        sum[4] += wy * row[3];
                        sum[5] += dy * row[1];
                      }
                      double* q = motion[p];
                      q[0] -= sum[0];
                      q[1] -= sum[1];
                      for (int k = 2; k < 6; ++k) q[k] -= affine * sum[k];
                    });
}

/// (1 - A) of a motion.
void take_carried(const Domain& domain, Motion& motion)
{
  NodeMotion nodes;
  for (NodeField* field : {&nodes.mass, &nodes.momentum_x, &nodes.momentum_y})
    field->assign(domain.grid.nodes(), 0.0);
  parallel::for_each_in_turn(domain.blocks.colours,
                             [&](int k) { add_block(domain, domain.blocks.occupied[k], motion, nodes); });
  for (int k = 0; k < domain.grid.nodes(); ++k)
  {
    const double inverse = nodes.mass[k] > domain.grid.smallest_mass ? 1 / nodes.mass[k] : 0;
    nodes.momentum_x[k] *= inverse;
    nodes.momentum_y[k] *= inverse;
  }
  parallel::for_each(domain.blocks.awake,
                     [&](int k) { take_block(domain, domain.blocks.occupied[k], nodes, motion); });
}
} // namespace

void filter_velocities(Domain& domain, double dt)
{
  const double time = domain.settings.filter.time, interval = time / times;
  if (time <= 0) return;
  const auto step = std::llround(domain.time / dt); // by whole steps, so that none is counted twice or never
  const auto intervals = [&](long long steps)
  { return std::floor(static_cast<double>(steps) * dt / interval * (1 + 1e-9)); };
  const double passed = intervals(step) - intervals(step - 1);
  if (passed < 1) return;
  Particles& p = domain.particles;
  const std::array fields{&p.velocity_x, &p.velocity_y, &p.affine_xx,
                          &p.affine_xy,  &p.affine_yx,  &p.affine_yy};
  Motion motion(p.size());
  for (int k = 0; k < p.size(); ++k)
    for (int f = 0; f < 6; ++f) motion[k][f] = (*fields[f])[k];
  for (int order = 0; order < 2; ++order) take_carried(domain, motion);
  const double share = 1 - std::exp(-passed / times);
  parallel::for_each(domain.blocks.awake,
                     [&](int b)
                     {
                       for_each_particle(domain.blocks.occupied[b],
                                         [&](int k)
                                         {
                                           for (int f = 0; f < 6; ++f)
                                             (*fields[f])[k] -= share * motion[k][f];
                                         });
                     });
}
} // namespace mpm
