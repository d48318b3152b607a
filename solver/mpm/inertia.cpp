#include "solver/mpm/inertia.hpp"

#include "solver/mpm/domain.hpp"

namespace mpm
{
namespace
{
/// Half the second moment of the product of two cubic splines, over h^2.
constexpr double coefficient = 1.0 / 3;
constexpr double none_below = 0.4, all_above = 0.75; // least over greatest mass of three nodes in a line
constexpr double strong = 4;                         // dt c / m of a dashpot that a node follows

/// Of a side or of the base, N s/m per m: the greater, not the sum, so that a corner is as a column's base
/// is.
double greatest_dashpot(const Grid& g, int node)
{
  return std::max(std::max(g.dashpot_x[node], g.dashpot_y[node]),
                  std::max(g.face_dashpot_x[node], g.face_dashpot_y[node]));
}

/// Finds v* - P/m of a block's nodes, and the mass with which they take part.
void prepare(Grid& g, int block, double dt)
{
  const bool dashpots = !g.dashpot_x.empty();
  for (int k = block * block_nodes; k < (block + 1) * block_nodes; ++k)
  {
    const double m = g.mass[k];
    const bool active = m > g.smallest_mass;
    const double inverse = 1 / (active ? m : 1);
    g.change_x[k] = active ? g.velocity_x[k] - g.momentum_x[k] * inverse : 0;
    g.change_y[k] = active ? g.velocity_y[k] - g.momentum_y[k] * inverse : 0;
    const double dashpot = dashpots ? greatest_dashpot(g, k) : 0;
    g.linked_mass[k] = active && dt * dashpot < strong * m ? m : 0;
  }
}

inline double lesser(double a, double b)
{
  return a < b ? a : b;
}
inline double greater(double a, double b)
{
  return a > b ? a : b;
}

/// links[i] = m_ij / 3 of each node i of a tile and the node j = i + step, the next one of the row or column.
/// A link is as even as the less even of its nodes: `evenness` of a node goes by least over greatest mass of
/// itself and the two beside it. Where `face` is not zero, at the base's face, unequal masses do not fade it:
/// the face's dashpots hold the light nodes.
template <int step>
void link(const Tile& mass, const Tile& face, Tile& links)
{
  Tile evenness;
  const double* __restrict m = mass.value.data();
  double* __restrict e = evenness.value.data();
  double* __restrict out = links.value.data();
  for (int t = 0; t < step; ++t) e[t] = e[tile_size - 1 - t] = 0;
  for (int t = step; t < tile_size - step; ++t)
  {
    const double a = m[t - step], b = m[t], c = m[t + step];
    const double least = lesser(lesser(a, b), c), greatest = greater(greater(a, b), c);
    const double ratio = least / greater(greatest, std::numeric_limits<double>::min());
    const double share = (ratio - none_below) * (1 / (all_above - none_below));
    e[t] = face.value[t] > 0 ? 1 : greater(lesser(share, 1), 0);
  }
  for (int t = 0; t < tile_size - step; ++t)
    out[t] = coefficient * lesser(m[t], m[t + step]) * lesser(e[t], e[t + step]);
}

/// v_i += 1/m_i sum_j m_ij / 3 (a_i - a_j) dt, `change` being a dt: one component of a block's velocities.
/// `across` and `up` are the links to the right and above.
void add_exchange(const Tile& mass, const Tile& across, const Tile& up, const Tile& change, double* velocity)
{
  constexpr int left = 1, below = tile_stride;
  for (int row = 0; row < block_cells; ++row)
  {
    const int start = tile_index(0, row);
    const double *m = &mass.value[start], *x = &across.value[start], *y = &up.value[start];
    const double* a = &change.value[start];
    double* __restrict v = velocity + row * block_cells;
    for (int k = 0; k < block_cells; ++k)
    {
      const double sum = x[k - left] * (a[k] - a[k - left]) + x[k] * (a[k] - a[k + left]) +
                         y[k - below] * (a[k] - a[k - below]) + y[k] * (a[k] - a[k + below]);
      v[k] += m[k] > 0 ? sum / m[k] : 0;
    }
  }
}

void correct_block(Grid& g, int block)
{
  const int begin = block * block_nodes;
  const auto own = g.linked_mass.begin() + begin;
  if (std::all_of(own, own + block_nodes, [](double m) { return m <= 0; })) return;
  Tile mass, across, up, change, face;
  read_tile(g, g.neighbours[block], g.linked_mass, mass);
  face.value.fill(0);
  link<1>(mass, face, across);
  if (!g.face_dashpot_x.empty()) read_tile(g, g.neighbours[block], g.face_dashpot_x, face);
  link<tile_stride>(mass, face, up);
  read_tile(g, g.neighbours[block], g.change_x, change);
  add_exchange(mass, across, up, change, &g.velocity_x[begin]);
  read_tile(g, g.neighbours[block], g.change_y, change);
  add_exchange(mass, across, up, change, &g.velocity_y[begin]);
}
} // namespace

void correct_inertia(Grid& g, double dt)
{
  for (auto* field : {&g.change_x, &g.change_y, &g.linked_mass}) field->resize(g.nodes());
  g.for_each_block([&](int k) { prepare(g, k, dt); });
  g.for_each_block([&](int k) { correct_block(g, k); });
}
} // namespace mpm
