#include "solver/mpm/chunk.hpp"
#include "solver/mpm/gauges.hpp"
#include "solver/mpm/health.hpp"

#include <bit>

namespace mpm
{
namespace
{
/// The nodes of the particles of some lanes, mostly one run: nodes are read once a run.
struct LaneNodes
{
  int count = 0;
  LaneRun run[lanes];

  /// Of the first nodes of their stencils, as indices in the tile.
  explicit LaneNodes(const int* first)
  {
    for (unsigned left = (1u << lanes) - 1; left != 0; ++count)
    {
      run[count] = LaneRun(first, std::countr_zero(left));
      left &= ~bits(run[count].who);
    }
  }
  /// A row of a stencil's nodes, each for the particles of all lanes.
  [[gnu::always_inline]] void pick(const Tile& field, int row, Lanes (&nodes)[4]) const
  {
    const double* const from = &field.value[row * tile_stride];
    for (int i = 0; i < 4; ++i) nodes[i] = run[0].taken(Lanes{}, from, i);
    for (int c = 1; c < count; ++c)
      for (int i = 0; i < 4; ++i) nodes[i] = run[c].taken(nodes[i], from, i);
  }
};

/// Splines of a chunk in both directions.
struct Splines
{
  LaneSplines x, y;
};

/// Sums over the nodes of a field v around some particles, times the factors of the splines.
struct NodeSums
{
  Lanes value{};                ///< w v
  Lanes slope_x{}, slope_y{};   ///< dw/dx v, dw/dy v
  Lanes moment_x{}, moment_y{}; ///< w (x_i - x) v, w (y_i - y) v (eq. 3)
  Lanes gained{};               ///< w times a second field, which FLIP needs
};

/// Of the particles from k on; of the second field only with FLIP.
template <bool flip>
[[gnu::noinline]] NodeSums sum_nodes(const Tile& field, const Tile& second, const LaneNodes& nodes,
                                     const Splines& s, int k)
{
  NodeSums sum;
#pragma GCC unroll 4
  for (int j = 0; j < 4; ++j)
  {
    Lanes node[4], other[4], value{}, slope{}, moment{}, gained{};
    nodes.pick(field, j, node);
    if constexpr (flip) nodes.pick(second, j, other);
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i)
    {
      const Lanes weight = load_as<Lanes>(&s.x.weight[i][k]);
      value += weight * node[i];
      if constexpr (flip) gained += weight * other[i];
      slope += load_as<Lanes>(&s.x.slope[i][k]) * node[i];
      moment += load_as<Lanes>(&s.x.moment[i][k]) * node[i];
    }
    const Lanes weight = load_as<Lanes>(&s.y.weight[j][k]);
    sum.value += weight * value;
    if constexpr (flip) sum.gained += weight * gained;
    sum.slope_x += weight * slope;
    sum.moment_x += weight * moment;
    sum.slope_y += load_as<Lanes>(&s.y.slope[j][k]) * value;
    sum.moment_y += load_as<Lanes>(&s.y.moment[j][k]) * value;
  }
  return sum;
}

/// Takes the factors of the splines out of velocities, v / 36. A rounded 1/36 would change the momentum step
/// by step; 7/256 is exact, and the rounding of the rest, 1/2304 or a 64th of the whole, is too small to
/// matter.
inline Lanes without_weights(const Lanes& values)
{
  constexpr double most = 7.0 / 256, rest = 1.0 / 2304;
  static_assert(spline_weight == 6);
  return values * most + values * rest;
}

/// Greatest components of velocities and gradients, still times the factors of the splines.
struct Extremes
{
  Lanes velocity{}, gradient{};

  void take(const NodeSums& r)
  {
    velocity = greatest_of(velocity, r.value);
    gradient = greatest_of(greatest_of(gradient, r.slope_x), r.slope_y);
  }
};

/// How particles take over the nodes' velocities.
struct Transfer
{
  double dt, spacing;
  bool flip; ///< particles keep their velocities and take the change only
};

/// One component of the motion of all particles, and of the velocity gradient of a chunk of them.
struct MotionFields
{
  std::vector<double>&position, &velocity, &affine_x, &affine_y;
  std::array<double, chunk_size>&gradient_x, &gradient_y;
};

/// One component of the nodes' velocities around a block, and how it moves the block's particles.
class Component
{
public:
  Component(const Grid& grid, const Neighbours& around, const NodeField& velocity, const NodeField& gained,
            const Transfer& transfer)
      : transfer_(transfer)
  {
    read_tile(grid, around, velocity, velocity_);
    if (transfer.flip) read_tile(grid, around, gained, gained_);
  }

  /// Of n particles, k being the index of the first in the chunk and q in all:
  ///
  ///   v = sum w v*,   C = 3 / h^2 sum w v* (x_i - x)^T (eq. 3),   L = sum v* grad w^T,   x += dt v,
  ///
  /// and with FLIP v_p + sum w (v* - P/m) for the velocity that they keep. Returns v, times the factors of
  /// the splines.
  [[gnu::always_inline]] inline Lanes apply(const LaneNodes& nodes, const Splines& s, int k, int q, int n,
                                            const MotionFields& particles, Extremes& greatest) const
  {
    const auto [dt, spacing, flip] = transfer_;
    const double affine = 3 * inverse_weights / spacing, slope = inverse_slopes / spacing; // D = h^2 / 3
    const NodeSums r = flip ? sum_nodes<true>(velocity_, gained_, nodes, s, k)
                            : sum_nodes<false>(velocity_, gained_, nodes, s, k);
    greatest.take(r);
    const Lanes v = without_weights(r.value);
    double* const x = &particles.position[q];
    store_first(x, load_first(x, n) + dt * v, n);
    double* const velocity = &particles.velocity[q];
    store_first(velocity, flip ? load_first(velocity, n) + without_weights(r.gained) : v, n);
    store_first(&particles.affine_x[q], affine * r.moment_x, n);
    store_first(&particles.affine_y[q], affine * r.moment_y, n);
    store(&particles.gradient_x[k], slope * r.slope_x);
    store(&particles.gradient_y[k], slope * r.slope_y);
    return r.value;
  }

private:
  Transfer transfer_;
  Tile velocity_, gained_;
};

/// Moves the particles of a block and updates their stress. Returns their greatest displacement component in
/// cells; infinite when one is deformed wholly or has a velocity that is no number.
double update_block(Domain& domain, const OccupiedBlock& occupied, double dt)
{
  const Grid& grid = domain.grid;
  const Transfer transfer{dt, grid.spacing, domain.settings.flip};
  const Component x(grid, occupied.around, grid.velocity_x, grid.gained_x, transfer);
  const Component y(grid, occupied.around, grid.velocity_y, grid.gained_y, transfer);
  const TileStencils tile(grid, occupied.block);
  ChunkCells at;
  Splines splines;
  VelocityGradients L;
  Particles& p = domain.particles;
  const MotionFields of_x{p.x, p.velocity_x, p.affine_xx, p.affine_xy, L.xx, L.xy};
  const MotionFields of_y{p.y, p.velocity_y, p.affine_yx, p.affine_yy, L.yx, L.yy};
  Extremes greatest;
  // Zero until a place is no number, and with it all weights, which neither the greatest nor the work of the
  // forces tell.
  Lanes poison{};
  for_each_chunk(occupied,
                 [&](int material, int begin, int count)
                 {
                   at.fill(tile, &p.x[begin], &p.y[begin], count);
                   splines.x.fill(at.x_fraction, count);
                   splines.y.fill(at.y_fraction, count);
                   const Material& m = domain.materials[material];
                   const auto state = [&](std::size_t k) {
                     return k < m.state.size() ? &m.state[k][begin - domain.material_begin[material]]
                                               : &p.x[begin];
                   };
                   const Prefetch next(p, begin, &p.stress_zz[begin], state(0), state(1));
                   for (int k = 0; k < count; k += lanes)
                   {
                     const LaneNodes nodes(&at.node[k]);
                     const int q = begin + k, n = std::min(lanes, count - k);
                     for (int quarter = (k & 7) / 2; quarter < ((k & 7) + lanes) / 2; ++quarter)
                       next.fetch(k & ~7, quarter);
                     poison += 0.0 * x.apply(nodes, splines, k, q, n, of_x, greatest);
                     y.apply(nodes, splines, k, q, n, of_y, greatest);
                   }
                   update_particles(domain, material, begin, count, L, dt);
                 });
  const double courant = dt / grid.spacing;
  if (!all_zero(poison)) return std::numeric_limits<double>::infinity();
  if (greatest_of(greatest.gradient) * inverse_slopes * courant > gradient_limit)
    return std::numeric_limits<double>::infinity();
  return greatest_of(greatest.velocity) * inverse_weights * courant;
}
} // namespace

void grid_to_particles(Domain& domain, double dt)
{
  std::vector<double> moves(domain.blocks.occupied.size());
  parallel::for_each(domain.blocks.awake,
                     [&](int k) { moves[k] = update_block(domain, domain.blocks.occupied[k], dt); });
  domain.measures.greatest_move = moves.empty() ? 0 : *std::max_element(moves.begin(), moves.end());
  watch_rest(domain, moves, dt);
  move_gauges(domain, dt);
}
} // namespace mpm
