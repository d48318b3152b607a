// Which particle is in which block: the stable sort, the blocks, and the grid that follows from them.
// Particles keep their order within a cell from sort to sort, so that sums over them are the same on any
// number of threads and after a restart.

#include "solver/mpm/domain.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mpm
{
namespace
{
/// Sort key of a particle: block, then cell in it, row by row: particles of a cell are neighbours, so that
/// their stencils' sums are added to the tile once a cell.
struct Key
{
  BlockIndex block;
  int cell;
  bool operator==(const Key&) const = default;
  auto operator<=>(const Key&) const = default;
};

Key key_of(const Grid& grid, double x, double y)
{
  const int i = static_cast<int>(std::floor((x - grid.origin_x) * grid.inverse_spacing()));
  const int j = static_cast<int>(std::floor((y - grid.origin_y) * grid.inverse_spacing()));
  const BlockIndex block{grid.wrapped ? 0 : block_of(i), block_of(j)};
  return {block, index_in_block(i, j)};
}

template <class T>
void permute(std::vector<T>& values, const std::vector<int>& order, int from)
{
  const auto sorted = std::make_unique_for_overwrite<T[]>(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) sorted[k] = values[from + order[k]];
  std::copy_n(sorted.get(), order.size(), values.begin() + from);
}

/// Sorts the particles of one material and appends its ranges, block by block.
void sort_material(Domain& domain, int material, std::vector<std::pair<BlockIndex, ParticleRange>>& ranges)
{
  Particles& p = domain.particles;
  const int begin = domain.material_begin[material], count = domain.material_begin[material + 1] - begin;
  std::vector<Key> keys(count);
  for (int k = 0; k < count; ++k) keys[k] = key_of(domain.grid, p.x[begin + k], p.y[begin + k]);
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return keys[a] < keys[b]; });

  std::vector<std::pair<std::vector<double>*, int>> arrays; // and where the material's particles begin
  for_each_array(p, [&](std::vector<double>& values) { arrays.emplace_back(&values, begin); });
  for (auto& state : domain.materials[material].state) arrays.emplace_back(&state, 0);
  parallel::for_each(static_cast<int>(arrays.size()), 1 + count / 10,
                     [&](int k) { permute(*arrays[k].first, order, arrays[k].second); });
  permute(p.id, order, begin);

  for (int k = 0; k < count; ++k)
  {
    const BlockIndex block = keys[order[k]].block;
    if (k == 0 || block != ranges.back().first) ranges.push_back({block, {material, begin + k, begin + k}});
    ranges.back().second.end = begin + k + 1;
  }
}

/// The occupied blocks and the eight around each, which their particles' stencils reach.
std::vector<BlockIndex> with_surroundings(const Domain& domain)
{
  std::vector<BlockIndex> wanted;
  for (const OccupiedBlock& occupied : domain.blocks.occupied)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        wanted.push_back({domain.grid.wrapped ? 0 : occupied.block.x + x, occupied.block.y + y});
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  return wanted;
}
} // namespace

void set_materials(Domain& domain, std::vector<Material> materials, const std::vector<int>& counts)
{
  domain.materials = std::move(materials);
  domain.material_begin.assign(1, 0);
  for (std::size_t k = 0; k < counts.size(); ++k)
  {
    domain.material_begin.push_back(domain.material_begin.back() + counts[k]);
    Material& material = domain.materials[k];
    material.state.assign(material.state_fields().size(), std::vector<double>(counts[k], 0.0));
  }
  domain.particles.resize(domain.material_begin.back());
  std::iota(domain.particles.id.begin(), domain.particles.id.end(), 0);
}

void rebuild(Domain& domain)
{
  const auto absorbing = [](const auto& boundary) { return boundary->absorbs(); };
  const bool dashpots = std::any_of(domain.boundaries.begin(), domain.boundaries.end(), absorbing);
  domain.grid.build(with_surroundings(domain), dashpots, dashpots && domain.settings.consistent_inertia);
  for (OccupiedBlock& occupied : domain.blocks.occupied) occupied.around = domain.grid.around(occupied.block);
  bind_rest(domain);
  domain.particles.index_ids(domain.planted());
  for (const auto& boundary : domain.boundaries) boundary->bind(domain);
}

void sort_particles(Domain& domain)
{
  std::vector<std::pair<BlockIndex, ParticleRange>> ranges;
  for (std::size_t k = 0; k < domain.materials.size(); ++k)
    sort_material(domain, static_cast<int>(k), ranges);
  std::stable_sort(ranges.begin(), ranges.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::vector<OccupiedBlock> before = std::move(domain.blocks.occupied);
  domain.blocks.occupied.clear();
  for (const auto& [block, range] : ranges)
  {
    if (domain.blocks.occupied.empty() || domain.blocks.occupied.back().block != block)
    {
      const auto by_block = [](const OccupiedBlock& occupied, BlockIndex wanted)
      { return occupied.block < wanted; };
      const auto old = std::lower_bound(before.begin(), before.end(), block, by_block);
      const bool known = old != before.end() && old->block == block;
      domain.blocks.occupied.push_back(known ? OccupiedBlock{block, {}, {}, old->asleep, old->greatest}
                                             : OccupiedBlock{block, {}, {}});
    }
    domain.blocks.occupied.back().ranges.push_back(range);
  }
  domain.blocks.drift = 0;
  domain.particles.index_ids(domain.planted());
  for (const auto& boundary : domain.boundaries) boundary->sort(domain);
  rebuild(domain);
}

double kinetic_energy(const Domain& domain)
{
  const Particles& p = domain.particles;
  const double inertia = domain.grid.spacing * domain.grid.spacing / 3; // D = h^2 / 3
  double total = 0;
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    double sum = 0;
    for (int k = domain.material_begin[m]; k < domain.material_begin[m + 1]; ++k)
    {
      const double translation = p.velocity_x[k] * p.velocity_x[k] + p.velocity_y[k] * p.velocity_y[k];
      const double affine = p.affine_xx[k] * p.affine_xx[k] + p.affine_xy[k] * p.affine_xy[k] +
                            p.affine_yx[k] * p.affine_yx[k] + p.affine_yy[k] * p.affine_yy[k];
      sum += 0.5 * p.mass[k] * (translation + inertia * affine);
    }
    total += domain.materials[m].mass_scale * sum;
  }
  return total;
}

double greatest_speed(const Particles& p)
{
  double greatest = 0;
  for (int k = 0; k < p.size(); ++k)
    greatest = std::max(greatest, std::hypot(p.velocity_x[k], p.velocity_y[k]));
  return greatest;
}
} // namespace mpm
