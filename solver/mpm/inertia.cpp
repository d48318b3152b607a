#include "solver/mpm/inertia.hpp"

#include "solver/mpm/domain.hpp"
#include "solver/mpm/node_rows.hpp"

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
Lanes evenness_of(const Lanes& before, const Lanes& own, const Lanes& after)
{
  const Lanes least = lesser(lesser(before, own), after), greatest = greater(greater(before, own), after);
  if (bits(above(all_above * greatest, least)) == 0) return Lanes{} + 1;
  const Lanes ratio = least / greater(greatest, Lanes{} + std::numeric_limits<double>::min());
  return greater(lesser((ratio - none_below) * (1 / (all_above - none_below)), Lanes{} + 1), Lanes{});
}

/// m_ij / 3 of nodes i and their neighbours j. A link is as even as the less even of its nodes.
Lanes link(const Lanes& mass, const Lanes& evenness, const Lanes& other_mass, const Lanes& other_evenness)
{
  return coefficient * lesser(mass, other_mass) * lesser(evenness, other_evenness);
}

/// Links of nodes with those to the left and right, below and above.
struct Links
{
  Lanes left, right, below, above;

  /// sum_j m_ij / 3 (a_i - a_j), a dt being part `part` of row `row` of `change`.
  Lanes exchanged(const NodeRows& at, const NodeField& change, int row, int part) const
  {
    const Lanes a = at.of(change, row, part);
    return left * (a - previous_of(at.of(change, row, part - 1), a)) +
           right * (a - next_of(a, at.of(change, row, part + 1))) +
           below * (a - at.of(change, row - 1, part)) + above * (a - at.of(change, row + 1, part));
  }
};

/// Corrects the columns of nodes of a block that one vector holds.
void correct_part(Grid& g, int block, int part)
{
  const NodeRows at{g.neighbours[block]};
  constexpr int beyond = 2, rows = block_cells + 2 * beyond; // two rows beyond the block take part
  Lanes mass[rows], evenness[rows];
  for (int k = 0; k < rows; ++k) mass[k] = at.of(g.linked_mass, k - beyond, part);
  for (int k = 1; k < rows - 1; ++k) evenness[k] = evenness_of(mass[k - 1], mass[k], mass[k + 1]);
  // At the base's face unequal masses do not fade the links along its dashpots, which hold the light nodes.
  if (!g.face_dashpot_x.empty())
    for (int k = 1; k < rows - 1; ++k)
      evenness[k] =
          chosen(above(at.of(g.face_dashpot_x, k - beyond, part), Lanes{}), Lanes{} + 1, evenness[k]);
  for (int k = beyond; k < rows - beyond; ++k)
  {
    const int row = k - beyond;
    const Lanes& own = mass[k];
    const Selection linked = above(own, Lanes{});
    if (bits(linked) == 0) continue;
    const Lanes before = at.of(g.linked_mass, row, part - 1), after = at.of(g.linked_mass, row, part + 1);
    const Lanes left = previous_of(before, own), right = next_of(own, after);
    const Lanes even = evenness_of(left, own, right);
    // Of the vectors beside only the nodes next to this one matter.
    const Lanes even_before = evenness_of(previous_of(before, before), before, next_of(before, own));
    const Lanes even_after = evenness_of(previous_of(own, after), after, next_of(after, after));
    const Links links{link(own, even, left, previous_of(even_before, even)),
                      link(own, even, right, next_of(even, even_after)),
                      link(own, evenness[k], mass[k - 1], evenness[k - 1]),
                      link(own, evenness[k], mass[k + 1], evenness[k + 1])};
    const Lanes inverse = chosen(linked, 1 / chosen(linked, own, Lanes{} + 1), Lanes{});
    const int node = block * block_nodes + row * block_cells + part * lanes;
    double *const to_x = &g.velocity_x[node], *const to_y = &g.velocity_y[node];
    store(to_x, load_as<Lanes>(to_x) + inverse * links.exchanged(at, g.change_x, row, part));
    store(to_y, load_as<Lanes>(to_y) + inverse * links.exchanged(at, g.change_y, row, part));
  }
}
} // namespace

void correct_inertia(Grid& g)
{
  g.for_each_block(
      [&](int block)
      {
        for (int part = 0; part < NodeRows::parts; ++part) correct_part(g, block, part);
      });
}
} // namespace mpm
