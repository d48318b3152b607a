#include "solver/mpm/chunk.hpp"

namespace mpm
{
namespace
{
/// dt |L| beyond which a step has lost the motion.
constexpr double greatest_gradient = 1;

/// What the grid tells the particles of a chunk, times the factors of the stencils: sums over the nodes, as
/// vectors (x, y).
struct alignas(64) Readings
{
  double velocity[chunk_size][2];                          ///< w v
  double slope_x[chunk_size][2], slope_y[chunk_size][2];   ///< dw/dx v, dw/dy v
  double moment_x[chunk_size][2], moment_y[chunk_size][2]; ///< w (x_i - x) v, w (y_i - y) v (eq. 3)
  double change[chunk_size][2];                            ///< w (v* - v), for a FLIP share only
};

/// Greatest components of what was read.
struct Extremes
{
  Pairs velocity{}, gradient{};
};

template <bool flip>
void read(const ChunkStencils& s, int count, const PairTile& velocity, const PairTile& change, Readings& out,
          const Ahead& ahead, Extremes& greatest)
{
  for (int begin = 0; begin < count; begin += 4)
  {
    Pairs v[4], slope_x[4], slope_y[4], moment_x[4], moment_y[4], dv[4];
#pragma GCC unroll 4
    for (int l = 0; l < 4; ++l)
    {
      const int k =
          std::min(begin + l, count - 1); // the last one again instead of a fourth that is not there
      ahead.fetch(begin + l);
      const int node = s.node[k];
      Pairs u{}, u_moment{}, u_slope{}, du{};
#pragma GCC unroll 4
      for (int j = 0; j < 4; ++j)
      {
        const Pairs row = load_pairs(&velocity.value[2 * (node + j * tile_stride)]);
        u += s.y_weight[j][k] * row;
        u_moment += s.y_moment[j][k] * row;
        u_slope += s.y_slope[j][k] * row;
        if constexpr (flip) du += s.y_weight[j][k] * load_pairs(&change.value[2 * (node + j * tile_stride)]);
      }
      const Spline<Row> x = cubic_spline(s.x_fraction[k]);
      const Pairs w = twice(x.weight);
      v[l] = w * u;
      slope_x[l] = twice(x.slope) * u;
      slope_y[l] = w * u_slope;
      moment_x[l] = twice(x.moment) * u;
      moment_y[l] = w * u_moment;
      if constexpr (flip) dv[l] = w * du;
    }
    const auto sum = [begin](const Pairs* part, double(*to)[2])
    {
      const Pairs all = sums(part[0], part[1], part[2], part[3]);
      store_pairs(to[begin], all);
      return all;
    };
    greatest.velocity = greatest_of(greatest.velocity, sum(v, out.velocity));
    greatest.gradient = greatest_of(greatest.gradient, sum(slope_x, out.slope_x));
    greatest.gradient = greatest_of(greatest.gradient, sum(slope_y, out.slope_y));
    sum(moment_x, out.moment_x);
    sum(moment_y, out.moment_y);
    if constexpr (flip) sum(dv, out.change);
  }
}

/// Takes the factors of the stencils out of velocities. A rounded 1/36 would change the momentum step by
/// step; 7/256 is exact, and the rounding of the rest, a 64th of the whole, is too small to matter.
void take_out_weights(double (*values)[2], int count)
{
  constexpr double most = 7.0 / 256, rest = 1.0 / 2304;
  static_assert(spline_weight == 6);
  for (int k = 0; k < count; ++k)
    for (int c = 0; c < 2; ++c) values[k][c] = values[k][c] * most + values[k][c] * rest;
}

/// Change of the nodes' velocities over the step, v* - P/m.
void read_change(const Grid& grid, const Neighbours& around, const PairTile& velocity, PairTile& change)
{
  change.value.fill(0);
  for_each_run(grid, around,
               [&](int node, int place, auto count)
               {
                 for (int k = 0; k < count; ++k)
                 {
                   const double m = grid.mass[node + k];
                   if (m <= grid.smallest_mass) continue;
                   change.value[2 * (place + k)] =
                       velocity.value[2 * (place + k)] - grid.momentum_x[node + k] / m;
                   change.value[2 * (place + k) + 1] =
                       velocity.value[2 * (place + k) + 1] - grid.momentum_y[node + k] / m;
                 }
               });
}

/// The share `blend` of FLIP in the particles' velocities: v + blend (v_p + sum w (v* - P/m) - v), before v_p
/// is replaced. Particles still move with v (METHODS section 1).
void blend_velocity(const Particles& p, int begin, int count, double blend, Readings& from)
{
  take_out_weights(from.change, count);
  for (int k = 0; k < count; ++k)
  {
    double &ux = from.change[k][0], &uy = from.change[k][1];
    ux = from.velocity[k][0] + blend * (p.velocity_x[begin + k] + ux - from.velocity[k][0]);
    uy = from.velocity[k][1] + blend * (p.velocity_y[begin + k] + uy - from.velocity[k][1]);
  }
}

/// v = sum w v*, C = D^-1 sum w v* (x_i - x)^T (eq. 3), L = sum v* grad w; moves the particles with v.
void apply(Particles& p, int begin, int count, const Readings& from, double spacing, double dt, bool flip,
           VelocityGradients& L)
{
  const double affine = 3 * inverse_weights / spacing, slope = inverse_slopes / spacing; // D = h^2 / 3
  const auto* velocity = flip ? from.change : from.velocity;
  double* __restrict x = &p.x[begin], * __restrict y = &p.y[begin];
  double* __restrict vx = &p.velocity_x[begin], * __restrict vy = &p.velocity_y[begin];
  double* __restrict cxx = &p.affine_xx[begin], * __restrict cxy = &p.affine_xy[begin];
  double* __restrict cyx = &p.affine_yx[begin], * __restrict cyy = &p.affine_yy[begin];
#pragma GCC ivdep
  for (int k = 0; k < count; ++k)
  {
    vx[k] = velocity[k][0];
    vy[k] = velocity[k][1];
  }
#pragma GCC ivdep
  for (int k = 0; k < count; ++k)
  {
    x[k] += dt * from.velocity[k][0];
    y[k] += dt * from.velocity[k][1];
  }
#pragma GCC ivdep
  for (int k = 0; k < count; ++k)
  {
    cxx[k] = affine * from.moment_x[k][0];
    cyx[k] = affine * from.moment_x[k][1];
    cxy[k] = affine * from.moment_y[k][0];
    cyy[k] = affine * from.moment_y[k][1];
  }
#pragma GCC ivdep
  for (int k = 0; k < count; ++k)
  {
    L.xx[k] = slope * from.slope_x[k][0];
    L.yx[k] = slope * from.slope_x[k][1];
    L.xy[k] = slope * from.slope_y[k][0];
    L.yy[k] = slope * from.slope_y[k][1];
  }
}

/// Greatest displacement component of a block's particles in cells; infinite when one is deformed wholly.
double update_home(Domain& domain, const Home& home, double dt)
{
  const Grid& grid = domain.grid;
  const bool flip = domain.flip_blend > 0;
  PairTile velocity, change;
  read_tile(grid, home.around, grid.velocity_x, grid.velocity_y, velocity);
  if (flip) read_change(grid, home.around, velocity, change);
  const TileStencils tile(grid, home.block);
  ChunkStencils stencils;
  Readings readings;
  VelocityGradients gradients;
  Particles& p = domain.particles;
  Extremes greatest;
  for_each_chunk(
      home,
      [&](int material, int begin, int count)
      {
        stencils.find(tile, &p.x[begin], &p.y[begin], count);
        const Material& m = domain.materials[material];
        const auto state = [&](std::size_t k)
        { return k < m.state.size() ? &m.state[k][begin - domain.material_begin[material]] : &p.x[begin]; };
        const Ahead ahead(p, begin, &p.stress_zz[begin], state(0), state(1));
        (flip ? read<true> : read<false>)(stencils, count, velocity, change, readings, ahead, greatest);
        take_out_weights(readings.velocity, count);
        if (flip) blend_velocity(p, begin, count, domain.flip_blend, readings);
        apply(p, begin, count, readings, grid.spacing, dt, flip, gradients);
        update_particles(domain, material, begin, count, gradients, dt);
      });
  const double courant = dt / grid.spacing;
  if (greatest_of(greatest.gradient) * inverse_slopes * courant > greatest_gradient)
    return std::numeric_limits<double>::infinity();
  return greatest_of(greatest.velocity) * inverse_weights * courant;
}

/// Share of the lightest ground's density below which a gauge is not in the ground any more. A surface has a
/// half, the edge of a vertical cut a quarter, a particle that flies alone, one of four of its cell, a
/// twentieth; there the nodes' velocities are one particle's, far beyond the place where it is.
constexpr double least_density = 0.1;

/// Moves a gauge with the velocity of the ground at its place; nodes without mass are left out of the mean.
/// Where the ground is torn to pieces it flies, where the ground sleeps it stands still.
void move(Tracer& tracer, const Domain& domain, double density, NodeFinder& find, double dt)
{
  const Grid& grid = domain.grid;
  const Stencil sx = cubic_stencil(tracer.x - grid.origin_x, grid.spacing);
  const Stencil sy = cubic_stencil(tracer.y - grid.origin_y, grid.spacing);
  find.move_to(sx.first, sy.first);
  double weight = 0, mass = 0, vx = 0, vy = 0;
  bool rests = false;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
    {
      const int node = find(sx.first + i, sy.first + j);
      if (node < 0) continue;
      const int home = domain.home_in[node / block_nodes];
      rests |= home >= 0 && domain.homes[home].asleep;
      if (grid.mass[node] <= 0) continue;
      const double w = sx.weight[i] * sy.weight[j];
      weight += w;
      mass += w * grid.mass[node];
      vx += w * grid.velocity_x[node];
      vy += w * grid.velocity_y[node];
    }
  const bool flies = !rests && mass < least_density * density * grid.spacing * grid.spacing;
  const auto next = [&](double before, double gravity, double sum) {
    return flies ? before + dt * gravity : weight > 0 ? sum / weight : 0;
  };
  tracer.velocity_x = next(tracer.velocity_x, domain.gravity_x, vx);
  tracer.velocity_y = next(tracer.velocity_y, domain.gravity_y, vy);
  tracer.x += dt * tracer.velocity_x;
  tracer.y += dt * tracer.velocity_y;
}

void move_tracers(Domain& domain, double dt)
{
  double lightest = std::numeric_limits<double>::infinity();
  for (const Material& material : domain.materials) lightest = std::min(lightest, material.elastic().density);
  NodeFinder find(domain.grid);
  for (Tracer& tracer : domain.tracers) move(tracer, domain, lightest, find, dt);
}
} // namespace

void grid_to_particles(Domain& domain, double dt)
{
  std::vector<double> moves(domain.homes.size());
  parallel::for_each(domain.awake, [&](int k) { moves[k] = update_home(domain, domain.homes[k], dt); });
  domain.greatest_move = moves.empty() ? 0 : *std::max_element(moves.begin(), moves.end());
  watch_rest(domain, moves, dt);
  move_tracers(domain, dt);
}
} // namespace mpm
