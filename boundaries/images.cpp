#include "boundaries/images.hpp"

#include "solver/mpm/chunk.hpp"
#include "solver/mpm/state_problem.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace mpm
{
void Images::release(const Particles& particles)
{
  std::erase_if(list, [&](const Image& image) { return particles.index_of[image.parent] < 0; });
}

void Images::sort(const Grid& g, const Particles& p)
{
  const auto cell = [&](double x, double origin)
  { return static_cast<int>(std::floor((x - origin) * g.inverse_spacing())); };
  for (Image& image : list)
  {
    const int parent = p.index_of[image.parent];
    const int i = cell(p.x[parent] + image.offset[0], g.origin_x);
    const int j = cell(p.y[parent] + image.offset[1], g.origin_y);
    image.block = {g.wrapped ? 0 : block_of(i), block_of(j)};
  }
}

void Images::bind(const Grid& grid, const Particles& p)
{
  const auto rank = [&](const Image& image)
  { return std::tuple(image.block, p.index_of[image.parent], image.load); };
  std::sort(list.begin(), list.end(), [&](const Image& a, const Image& b) { return rank(a) < rank(b); });
  bound_.clear();
  for (const Image& image : list)
    bound_.push_back({image.offset[0], image.offset[1], p.index_of[image.parent], image.load});
  blocks_.clear();
  work_ = {};
  for (int k = 0; k < static_cast<int>(list.size()); ++k)
  {
    const BlockIndex block = list[k].block;
    if (blocks_.empty() || blocks_.back().block != block)
      blocks_.push_back({block, grid.around(block), k, k, false, {}});
    blocks_.back().end = k + 1;
  }
  for (const ImageBlock& block : blocks_)
    work_.add(static_cast<int>(work_.items.size()), block.end - block.begin);
}

namespace
{
/// Acceleration of the ghosts' mass by row of a block's tile, m/s2.
using RowAccelerations = std::array<std::array<double, 2>, tile_nodes>;

RowAccelerations accelerations(BlockIndex block, const Images::Rows& rows)
{
  RowAccelerations result{};
  const int first = block.y * block_cells - tile_margin - rows.first_row;
  for (int row = 0; row < tile_nodes; ++row)
    if (first + row >= 0 && first + row < static_cast<int>(rows.acceleration.size()))
      result[row] = rows.acceleration[first + row];
  return result;
}

/// Positions of a chunk's images, and their loads over the factors of the stencils.
struct ImageSources
{
  double x[chunk_size], y[chunk_size];
  ImageLoad load[chunk_size];

  /// Takes the first `count` of the images.
  void take(std::span<const BoundImage> images, const std::vector<ImageLoad>& loads, const Particles& p,
            double spacing, int count)
  {
    const double stress = -inverse_slopes * (1 / spacing), weight = inverse_weights;
    const double factors[8] = {stress, stress, stress, stress, weight, weight, weight, 0};
    static_assert(sizeof(ImageLoad) == sizeof factors);
    const Pairs all = load_as<Pairs>(factors);
    const int last = static_cast<int>(images.size()) - 1;
    for (int k = 0; k < count; ++k)
    {
      const BoundImage& image = images[k];
      const BoundImage& later = images[std::min(k + 16, last)];
      __builtin_prefetch(&loads[later.load]); // neighbours in the list need not be here
      x[k] = p.x[image.parent] + image.offset_x;
      y[k] = p.y[image.parent] + image.offset_y;
      store(load[k].stress_x, all * load_as<Pairs>(loads[image.load].stress_x));
    }
  }
};

/// Sums at the 16 nodes of one cell's stencil, kept while one image after the other stands in that cell.
template <bool inertia>
class ImageSums
{
public:
  explicit ImageSums(int node) : node_(node) {}

  void add(int k, const ChunkStencils& s, const ImageLoad& load)
  {
    const Spline<Row> x = s.x[k];
    const Pairs w = twice(x.weight), f_slope = w * everywhere(load.stress_y);
    const Pairs f_w = twice(x.slope) * everywhere(load.stress_x) + w * everywhere(load.weight);
    const Row m = load.mass * x.weight;
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j)
    {
      force_[j] += s.y.weight[j][k] * f_w;
      force_[j] += s.y.slope[j][k] * f_slope;
      if constexpr (inertia) mass_[j] += s.y.weight[j][k] * m;
    }
  }

  /// Adds the sums, less the inertia of the images' mass, to a tile.
  void flush(const RowAccelerations& a, PairTile& force) const
  {
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j)
    {
      const int node = node_ + j * tile_stride;
      double* at = &force.value[2 * node];
      if constexpr (inertia)
        store(at,
              load_as<Pairs>(at) + (force_[j] - twice(mass_[j]) * everywhere(a[node / tile_stride].data())));
      else
        store(at, load_as<Pairs>(at) + force_[j]);
    }
  }

private:
  int node_;
  Row mass_[4]{};
  Pairs force_[4]{};
};
} // namespace

template <bool inertia>
void Images::scatter(const Grid& grid, const Particles& particles, ImageBlock& block, const Rows& rows) const
{
  block.force.value.fill(0);
  const RowAccelerations a = inertia ? accelerations(block.block, rows) : RowAccelerations{};
  const TileStencils tile(grid, block.block);
  ChunkStencils stencils;
  ImageSources from;
  for (int begin = block.begin; begin < block.end; begin += chunk_size)
  {
    const int count = std::min(chunk_size, block.end - begin);
    from.take(std::span(bound_).subspan(begin), loads, particles, grid.spacing, count);
    stencils.fill(tile, from.x, from.y, count);
    for (int k = 0; k < count;)
    {
      const int node = stencils.cells.node[k];
      ImageSums<inertia> sums(node);
      for (; k < count && stencils.cells.node[k] == node; ++k) sums.add(k, stencils, from.load[k]);
      sums.flush(a, block.force);
    }
  }
}

std::array<double, 2> Images::gather(Grid& g, const ImageBlock& block)
{
  std::array<double, 2> sum{};
  for_each_run(g, block.around,
               [&](int node, int at, int count)
               {
                 for (int k = 0; k < count; ++k)
                 {
                   const double* force = &block.force.value[2 * (at + k)];
                   if (g.mass[node + k] <= 0) continue;
                   sum[0] += force[0];
                   sum[1] += force[1];
                   g.force_x[node + k] += force[0];
                   g.force_y[node + k] += force[1];
                 }
               });
  return sum;
}

std::array<double, 2> Images::add_forces(Domain& domain, const Rows& rows)
{
  const bool rests = domain.blocks.rests();
  for (ImageBlock& block : blocks_) block.hidden = rests && !domain.blocks.awake_around(block.around);
  parallel::for_each(work_,
                     [&](int k)
                     {
                       ImageBlock& block = blocks_[k];
                       if (block.hidden) return;
                       rows.acceleration.empty() ? scatter<false>(domain.grid, domain.particles, block, rows)
                                                 : scatter<true>(domain.grid, domain.particles, block, rows);
                     });
  std::array<double, 2> sum{};
  for (const ImageBlock& block : blocks_)
  {
    if (block.hidden) continue;
    const auto [x, y] = gather(domain.grid, block);
    sum[0] += x;
    sum[1] += y;
  }
  return sum;
}

double Images::power(const Grid& g) const
{
  double sum = 0;
  for (const ImageBlock& block : blocks_)
  {
    if (block.hidden) continue;
    for_each_run(g, block.around,
                 [&](int node, int at, int count)
                 {
                   for (int k = 0; k < count; ++k)
                   {
                     const auto [vx, vy] = g.middle_velocity(node + k);
                     const double* force = &block.force.value[2 * (at + k)];
                     sum += force[0] * vx + force[1] * vy;
                   }
                 });
  }
  return sum;
}

double Images::work(const Grid& grid, double dt) const
{
  return dt * power(grid);
}

std::string Images::problem(const Grid& grid, const Particles& p, std::size_t loads_there) const
{
  for (const Image& image : list)
  {
    if (image.parent < 0 || image.parent >= std::ssize(p.index_of) || p.index_of[image.parent] < 0)
      return "an image has the parent " + std::to_string(image.parent) + ", which is not there";
    if (image.load < 0 || std::size_t(image.load) >= loads_there)
      return "an image brings load " + std::to_string(image.load) + ", which is not there";
    const int k = p.index_of[image.parent];
    if (!within_tile(grid, image.block, p.x[k] + image.offset[0], p.y[k] + image.offset[1]))
      return "an image does not stand in its block";
  }
  return {};
}

void Images::visit_list(StateVisitor& visitor, const std::string& prefix)
{
  RecordVisitor<Image> each(visitor, prefix, list);
  each.each_integer(
      "parent", [](Image & image) -> auto& { return image.parent; });
  each.each_integer(
      "load", [](Image & image) -> auto& { return image.load; });
  each.each_integer(
      "block_x", [](Image & image) -> auto& { return image.block.x; });
  each.each_integer(
      "block_y", [](Image & image) -> auto& { return image.block.y; });
  each.each("offset_x", "m", [](Image& image) -> double& { return image.offset[0]; });
  each.each("offset_y", "m", [](Image& image) -> double& { return image.offset[1]; });
}

void Images::visit_loads(StateVisitor& visitor, const std::string& prefix)
{
  RecordVisitor<ImageLoad> each(visitor, prefix, loads);
  each.each("stress_xx", "N m/m", [](ImageLoad& load) -> double& { return load.stress_x[0]; });
  each.each("stress_xy", "N m/m", [](ImageLoad& load) -> double& { return load.stress_y[0]; });
  each.each("stress_yx", "N m/m", [](ImageLoad& load) -> double& { return load.stress_x[1]; });
  each.each("stress_yy", "N m/m", [](ImageLoad& load) -> double& { return load.stress_y[1]; });
  each.each("weight_x", "N/m", [](ImageLoad& load) -> double& { return load.weight[0]; });
  each.each("weight_y", "N/m", [](ImageLoad& load) -> double& { return load.weight[1]; });
}
} // namespace mpm
