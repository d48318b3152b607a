#include "solver/mpm/chunk.hpp"
#include "solver/mpm/flow.hpp"

#include <cmath>

namespace mpm
{
namespace
{
/// h^2; keeps the fit of a node defined that one row of particles reaches, or one particle.
constexpr double least_variance = 0.02;

std::array<std::vector<double>*, 4> stresses(Particles& p)
{
  return {&p.stress_xx, &p.stress_yy, &p.stress_zz, &p.stress_xy};
}

/// One number of each particle for each component of its stress.
using Components = std::array<Values, 4>;

/// Fits of affine fields a + b_x (x - x_i) / h + b_y (y - y_i) / h to values of one ground's particles around
/// every node i, by least squares with weights w V.
class NodeFits
{
public:
  NodeFits(const Domain& domain, const Flow& flow, const Ground& ground)
      : domain_(domain), flow_(flow), ground_(ground)
  {
    sum<6>(moments_, [](int, std::array<Row, 3>& w, const Row& x, double y, std::array<Row, 6>& out)
           { out = {w[0], w[1], w[2], w[1] * x, w[1] * y, w[2] * y}; });
  }

  /// values -= what their fits give at the particles, component by component.
  void take_fit(Components& values) const
  {
    std::array<NodeField, 3 * components> fit;
    sum<3 * components>(
        fit,
        [&](int p, std::array<Row, 3>& w, const Row&, double, std::array<Row, 3 * components>& out)
        {
          for (int c = 0; c < components; ++c)
            for (int f = 0; f < 3; ++f) out[3 * c + f] = values[c][p] * w[f];
        });
    for (int k = 0; k < domain_.grid.nodes(); ++k)
      for (int c = 0; c < components; ++c) solve(k, &fit[3 * c]);
    flow_.for_each_near([&](const OccupiedBlock& occupied) { take(occupied, fit, values); });
  }

private:
  static constexpr int components = std::tuple_size_v<Components>;

  /// Sums over the particles: `make` gets a particle, its w V, w V x and w V y, x and y being its distances
  /// from the nodes of a row over h.
  template <std::size_t count, class Make>
  void sum(std::array<NodeField, count>& fields, const Make& make) const
  {
    const Grid& grid = domain_.grid;
    const Particles& particles = domain_.particles;
    const double inverse = -grid.inverse_spacing();
    for (NodeField& field : fields) field.assign(grid.nodes(), 0.0);
    flow_.add(
        [&](const OccupiedBlock& occupied)
        {
          std::array<Tile, count> tiles;
          for (Tile& tile : tiles) tile.value.fill(0);
          const TileStencils at(grid, occupied.block);
          ground_.for_each(occupied,
                           [&](int p)
                           {
                             const Stencil sx = at.x(particles.x[p]), sy = at.y(particles.y[p]);
                             // In a column all of a row's nodes are one.
                             const Row x = grid.wrapped ? Row{} : inverse * sx.offset;
                             for (int j = 0; j < 4; ++j)
                             {
                               const int node = TileStencils::first_node(sx, sy) + j * tile_stride;
                               const double y = inverse * sy.offset[j];
                               const Row w = (particles.volume[p] * sy.weight[j]) * sx.weight;
                               std::array<Row, 3> weights{w, w * x, w * y};
                               std::array<Row, count> out;
                               make(p, weights, x, y, out);
                               for (std::size_t f = 0; f < count; ++f)
                                 store(&tiles[f].value[node], load_as<Row>(&tiles[f].value[node]) + out[f]);
                             }
                           });
          for (std::size_t f = 0; f < count; ++f) add_tile(grid, occupied.around, tiles[f], fields[f]);
        });
  }

  /// a, b_x and b_y of a node out of the sums of w V q, w V q x and w V q y.
  void solve(int k, NodeField* fit) const
  {
    const double W = moments_[0][k];
    if (W <= 0) return;
    const double mx = moments_[1][k] / W, my = moments_[2][k] / W;
    const double xx = moments_[3][k] / W - mx * mx + least_variance, xy = moments_[4][k] / W - mx * my,
                 yy = moments_[5][k] / W - my * my + least_variance;
    const double mean = fit[0][k] / W, x = fit[1][k] / W - mx * mean, y = fit[2][k] / W - my * mean;
    const double inverse = 1 / (xx * yy - xy * xy);
    const double bx = inverse * (yy * x - xy * y), by = inverse * (xx * y - xy * x);
    fit[0][k] = mean - bx * mx - by * my;
    fit[1][k] = bx;
    fit[2][k] = by;
  }

  void take(const OccupiedBlock& occupied, const std::array<NodeField, 3 * components>& fit,
            Components& values) const
  {
    const Grid& grid = domain_.grid;
    const Particles& particles = domain_.particles;
    const double inverse = -grid.inverse_spacing();
    std::array<Tile, 3 * components> tiles;
    for (std::size_t f = 0; f < tiles.size(); ++f) read_tile(grid, occupied.around, fit[f], tiles[f]);
    const TileStencils at(grid, occupied.block);
    ground_.for_each(occupied,
                     [&](int p)
                     {
                       const Stencil sx = at.x(particles.x[p]), sy = at.y(particles.y[p]);
                       const Row x = inverse * sx.offset;
                       for (int c = 0; c < components; ++c)
                       {
                         Row sum{};
                         for (int j = 0; j < 4; ++j)
                         {
                           const int node = TileStencils::first_node(sx, sy) + j * tile_stride;
                           const auto row = [&](int f)
                           { return load_as<Row>(&tiles[3 * c + f].value[node]); };
                           sum += sy.weight[j] * (row(0) + x * row(1) + inverse * sy.offset[j] * row(2));
                         }
                         sum *= sx.weight;
                         values[c][p] -= (sum[0] + sum[1]) + (sum[2] + sum[3]);
                       }
                     });
  }

  const Domain& domain_;
  const Flow& flow_;
  const Ground& ground_;
  std::array<NodeField, 6> moments_; ///< sums of w V times 1, x, y, x^2, x y, y^2
};

/// Plastic strain since the last time, averaged over the nodes, of the particles that act.
Values spread(const Domain& domain, const Flow& flow)
{
  const Grid& grid = domain.grid;
  const Particles& particles = domain.particles;
  NodeField volume(grid.nodes(), 0.0), flowed(grid.nodes(), 0.0);
  const auto each = [&](const OccupiedBlock& occupied, const auto& f)
  {
    const TileStencils at(grid, occupied.block);
    for (const ParticleRange& range : occupied.ranges)
      for (int p = range.begin; p < range.end; ++p)
      {
        const Stencil sx = at.x(particles.x[p]), sy = at.y(particles.y[p]);
        for (int j = 0; j < 4; ++j)
          f(p, TileStencils::first_node(sx, sy) + j * tile_stride, Row(sy.weight[j] * sx.weight));
      }
  };
  flow.add(
      [&](const OccupiedBlock& occupied)
      {
        Tile v, e;
        v.value.fill(0);
        e.value.fill(0);
        each(occupied,
             [&](int p, int node, const Row& w)
             {
               store(&v.value[node], load_as<Row>(&v.value[node]) + particles.volume[p] * w);
               store(&e.value[node], load_as<Row>(&e.value[node]) + particles.volume[p] * flow[p] * w);
             });
        add_tile(grid, occupied.around, v, volume);
        add_tile(grid, occupied.around, e, flowed);
      });
  for (int k = 0; k < grid.nodes(); ++k) flowed[k] = volume[k] > 0 ? flowed[k] / volume[k] : 0;
  Values result(particles.size(), 0.0);
  flow.for_each_acting(
      [&](const OccupiedBlock& occupied)
      {
        Tile e;
        read_tile(grid, occupied.around, flowed, e);
        each(occupied,
             [&](int p, int node, const Row& w)
             {
               const Row sum = w * load_as<Row>(&e.value[node]);
               result[p] += (sum[0] + sum[1]) + (sum[2] + sum[3]);
             });
      });
  return result;
}

} // namespace

void filter_stresses(Domain& domain, const Flow& flow)
{
  Particles& p = domain.particles;
  const Values flowed = spread(domain, flow);
  const double before = elastic_energy(domain);
  Components rest;
  for (int c = 0; c < 4; ++c) rest[c] = *stresses(p)[c];
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    if (domain.materials[m].origin >= 0) continue;
    const Ground ground(domain, static_cast<int>(m));
    const NodeFits fits(domain, flow, ground);
    for (int order = 0; order < 2; ++order) fits.take_fit(rest);
    flow.for_each_acting(
        [&](const OccupiedBlock& occupied)
        {
          ground.for_each(occupied,
                          [&](int k, int material)
                          {
                            const double share = 1 - std::exp(-flowed[k] / domain.settings.filter.strain);
                            const double trace = p.stress_xx[k] + p.stress_yy[k] + p.stress_zz[k],
                                         less = share * (rest[0][k] + rest[1][k] + rest[2][k]);
                            if (trace < 0 && trace - less > 0) return; // pressure, and would be tension
                            for (int c = 0; c < 4; ++c) (*stresses(p)[c])[k] -= share * rest[c][k];
                            p.volume[k] *=
                                std::exp(-less / (3 * domain.materials[material].elastic().bulk_modulus()));
                          });
        });
  }
  domain.energy.work += before - elastic_energy(domain);
}
} // namespace mpm
