#include "solver/mpm/inertia.hpp"

#include "solver/mpm/domain.hpp"

namespace mpm
{
namespace
{
/// Half the second moment of the product of two cubic splines, over h^2.
constexpr double coefficient = 1.0 / 3;
constexpr double none_below = 0.4, all_above = 0.75; // least over greatest mass of three nodes in a line

inline Lanes lesser(const Lanes& a, const Lanes& b)
{
  return chosen(above(b, a), a, b);
}
inline Lanes greater(const Lanes& a, const Lanes& b)
{
  return chosen(above(b, a), b, a);
}

/// How even the masses of nodes and of the two beside each are: 1 where they hardly differ, 0 at a surface.
template <int step>
Lanes evenness_of(const double* m)
{
  const Lanes before = load_as<Lanes>(m - step), own = load_as<Lanes>(m), after = load_as<Lanes>(m + step);
  const Lanes least = lesser(lesser(before, own), after), greatest = greater(greater(before, own), after);
  if (bits(above(all_above * greatest, least)) == 0) return Lanes{} + 1;
  const Lanes ratio = least / greater(greatest, Lanes{} + std::numeric_limits<double>::min());
  return greater(lesser((ratio - none_below) * (1 / (all_above - none_below)), Lanes{} + 1), Lanes{});
}

/// The rows of a tile from the one below its block to the one above: what links of its nodes depend on.
constexpr int first = tile_index(-tile_margin, -1), end = tile_index(-tile_margin, block_cells + 1);
static_assert((end - first) % lanes == 0);

/// links[i] = m_ij / 3 of each node i of a tile and the node j = i + step, the next one of the row or column.
/// A link is as even as the less even of its nodes. Where `face` is not zero, at the base's face, unequal
/// masses do not fade it: the face's dashpots hold the light nodes.
template <int step>
void link(const Tile& mass, const Tile* face, Tile& links)
{
  Tile evenness;
  const double* const m = mass.value.data();
  double* const e = evenness.value.data();
  for (int t = first; t < end; t += lanes)
  {
    const Lanes share = evenness_of<step>(m + t);
    store(e + t, face ? chosen(above(load_as<Lanes>(&face->value[t]), Lanes{}), Lanes{} + 1, share) : share);
  }
  for (int t = end; t < end + step; ++t) e[t] = 0;
  for (int t = first; t < end; t += lanes)
  {
    const auto both = [&](const double* of)
    { return lesser(load_as<Lanes>(of + t), load_as<Lanes>(of + t + step)); };
    store(&links.value[t], coefficient * both(m) * both(e));
  }
}

/// Links of a block's nodes to the right and above, and the change of velocity by which they exchange
/// momentum.
struct Exchange
{
  Tile mass, across, up;

  /// Of the row of nodes that begins at t of the tile: sum_j m_ij / 3 (a_i - a_j), `change` being a dt.
  Lanes sum(const Tile& change, int t) const
  {
    constexpr int left = 1, below = tile_stride;
    const auto at = [&](const Tile& tile, int node) { return load_as<Lanes>(&tile.value[node]); };
    const Lanes a = at(change, t);
    return at(across, t - left) * (a - at(change, t - left)) + at(across, t) * (a - at(change, t + left)) +
           at(up, t - below) * (a - at(change, t - below)) + at(up, t) * (a - at(change, t + below));
  }
};

void correct_block(Grid& g, int block)
{
  const int begin = block * block_nodes;
  const auto own = g.linked_mass.begin() + begin;
  if (std::all_of(own, own + block_nodes, [](double m) { return m <= 0; })) return;
  const Neighbours& around = g.neighbours[block];
  Exchange exchange;
  Tile x, y, face;
  read_tile(g, around, g.linked_mass, exchange.mass);
  const bool faces = !g.face_dashpot_x.empty();
  if (faces) read_tile(g, around, g.face_dashpot_x, face);
  link<1>(exchange.mass, nullptr, exchange.across);
  link<tile_stride>(exchange.mass, faces ? &face : nullptr, exchange.up);
  read_tile(g, around, g.change_x, x);
  read_tile(g, around, g.change_y, y);
  for (int k = 0; k < block_nodes; k += lanes)
  {
    const int t = tile_index(k % block_cells, k / block_cells);
    const Lanes m = load_as<Lanes>(&exchange.mass.value[t]);
    const Selection linked = above(m, Lanes{});
    const Lanes inverse = chosen(linked, 1 / chosen(linked, m, Lanes{} + 1), Lanes{});
    double *const to_x = &g.velocity_x[begin + k], *const to_y = &g.velocity_y[begin + k];
    store(to_x, load_as<Lanes>(to_x) + inverse * exchange.sum(x, t));
    store(to_y, load_as<Lanes>(to_y) + inverse * exchange.sum(y, t));
  }
}
} // namespace

void correct_inertia(Grid& g)
{
  g.for_each_block([&](int k) { correct_block(g, k); });
}
} // namespace mpm
