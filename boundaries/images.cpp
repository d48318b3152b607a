#include "boundaries/images.hpp"

#include "solver/mpm/chunk.hpp"
#include "solver/mpm/state_problem.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace mpm
{
namespace
{
/// Cells beyond a wall that images must fill: two are reached by a ghost node two cells out (METHODS section
/// 3).
constexpr double strip = 4;

/// An image with its load.
struct Loaded
{
  Image image;
  ImageLoad load;
};

/// Mirrors an image (or a particle, taken as its own image) at one more wall: X* = M X, Sigma* = S Sigma M.
Loaded mirror(const Loaded& original, const Wall& wall, const Eigen::Vector2d& parent, double wall_position)
{
  const int normal = wall.normal == Direction::x ? 0 : 1;
  const double S[] = {wall.image_sign_x(), wall.image_sign_y()};
  const double M[] = {normal == 0 ? -1. : 1., normal == 1 ? -1. : 1.};
  auto [image, load] = original;
  image.offset[normal] = 2 * wall_position - 2 * parent[normal] - image.offset[normal];
  for (int c = 0; c < 2; ++c)
  {
    load.stress_x[c] *= S[c] * M[0];
    load.stress_y[c] *= S[c] * M[1];
    load.weight[c] *= S[c];
  }
  return {image, load};
}
} // namespace

Images make_images(const Domain& domain, std::span<const Wall> walls)
{
  Images result;
  const Particles& p = domain.particles;
  const Grid& g = domain.grid;
  for (int k = 0; k < p.size(); ++k) // as they stand, so that neighbours' loads are neighbours
  {
    const double V = p.volume[k], m = p.mass[k];
    const Loaded self{{.parent = p.id[k]},
                      {.stress_x = {V * p.stress_xx[k], V * p.stress_xy[k]},
                       .stress_y = {V * p.stress_xy[k], V * p.stress_yy[k]},
                       .weight = {m * domain.settings.gravity_x, m * domain.settings.gravity_y}}};
    std::vector<Loaded> family{self};
    const Eigen::Vector2d parent(p.x[k], p.y[k]);
    for (const Wall& wall : walls)
    {
      const double position = parent[wall.normal == Direction::x ? 0 : 1];
      const double line = (wall.normal == Direction::x ? g.origin_x : g.origin_y) + wall.line * g.spacing;
      if (std::fabs(position - line) > strip * g.spacing) continue;
      const std::size_t known = family.size();
      for (std::size_t member = 0; member < known; ++member)
        family.push_back(mirror(family[member], wall, parent, line));
    }
    for (std::size_t member = 1; member < family.size(); ++member)
    {
      family[member].image.load = static_cast<int>(result.loads.size());
      result.list.push_back(family[member].image);
      result.loads.push_back(family[member].load);
    }
  }
  return result;
}

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
    const int i = cell(p.x[parent] + image.offset.x(), g.origin_x);
    const int j = cell(p.y[parent] + image.offset.y(), g.origin_y);
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
    bound_.push_back({image.offset.x(), image.offset.y(), p.index_of[image.parent], image.load});
  homes_.clear();
  work_ = {};
  for (int k = 0; k < static_cast<int>(list.size()); ++k)
  {
    const BlockIndex block = list[k].block;
    if (homes_.empty() || homes_.back().block != block)
      homes_.push_back({block, grid.around(block), k, k, false, {}});
    homes_.back().end = k + 1;
  }
  for (const ImageHome& occupied : homes_)
    work_.add(static_cast<int>(work_.items.size()), occupied.end - occupied.begin);
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

/// Where the images of a chunk stand, and their loads less the factors of the stencils.
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
void Images::scatter(const Grid& grid, const Particles& particles, ImageHome& occupied,
                     const Rows& rows) const
{
  occupied.force.value.fill(0);
  const RowAccelerations a = inertia ? accelerations(occupied.block, rows) : RowAccelerations{};
  const TileStencils tile(grid, occupied.block);
  ChunkStencils stencils;
  ImageSources from;
  for (int begin = occupied.begin; begin < occupied.end; begin += chunk_size)
  {
    const int count = std::min(chunk_size, occupied.end - begin);
    from.take(std::span(bound_).subspan(begin), loads, particles, grid.spacing, count);
    stencils.find(tile, from.x, from.y, count);
    for (int k = 0; k < count;)
    {
      const int node = stencils.place.node[k];
      ImageSums<inertia> sums(node);
      for (; k < count && stencils.place.node[k] == node; ++k) sums.add(k, stencils, from.load[k]);
      sums.flush(a, occupied.force);
    }
  }
}

std::array<double, 2> Images::gather(Grid& g, const ImageHome& occupied)
{
  std::array<double, 2> sum{};
  for_each_run(g, occupied.around,
               [&](int node, int place, int count)
               {
                 for (int k = 0; k < count; ++k)
                 {
                   const double* force = &occupied.force.value[2 * (place + k)];
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
  for (ImageHome& occupied : homes_) occupied.hidden = rests && !domain.blocks.awake_around(occupied.around);
  parallel::for_each(work_,
                     [&](int k)
                     {
                       ImageHome& occupied = homes_[k];
                       if (occupied.hidden) return;
                       rows.acceleration.empty()
                           ? scatter<false>(domain.grid, domain.particles, occupied, rows)
                           : scatter<true>(domain.grid, domain.particles, occupied, rows);
                     });
  std::array<double, 2> sum{};
  for (const ImageHome& occupied : homes_)
  {
    if (occupied.hidden) continue;
    const auto [x, y] = gather(domain.grid, occupied);
    sum[0] += x;
    sum[1] += y;
  }
  return sum;
}

double Images::work(const Grid& g, double dt) const
{
  double power = 0;
  for (const ImageHome& occupied : homes_)
  {
    if (occupied.hidden) continue;
    for_each_run(g, occupied.around,
                 [&](int node, int place, int count)
                 {
                   for (int k = 0; k < count; ++k)
                   {
                     const auto [vx, vy] = g.middle_velocity(node + k);
                     const double* force = &occupied.force.value[2 * (place + k)];
                     power += force[0] * vx + force[1] * vy;
                   }
                 });
  }
  return dt * power;
}

void FrozenImages::bind(const Domain& domain)
{
  images_.bind(domain.grid, domain.particles);
  mass_ = std::accumulate(domain.particles.mass.begin(), domain.particles.mass.end(), 0.0);
}

void FrozenImages::add_forces(Domain& domain, double)
{
  const std::array<double, 2> now = images_.add_forces(domain, {});
  if (resultant_.empty()) resultant_.push_back(now);
  // Sleeping ground hides its images: the correction stays what it was, as the ground does.
  if (!domain.blocks.rests())
    correction_[0] = {(resultant_[0][0] - now[0]) / mass_, (resultant_[0][1] - now[1]) / mass_};
  const auto [ax, ay] = correction_[0];
  Grid& g = domain.grid;
  g.for_each_block(
      [&g, ax = ax, ay = ay](int block)
      {
        for (int k = block * block_nodes; k < (block + 1) * block_nodes; ++k)
        {
          g.force_x[k] += g.mass[k] * ax;
          g.force_y[k] += g.mass[k] * ay;
        }
      });
}

void FrozenImages::measure_work(const Domain& domain, double dt, Energies& now) const
{
  const auto [px, py] = domain.energy.step.momentum;
  now[Energy::reaction] +=
      images_.work(domain.grid, dt) + dt * (correction_[0][0] * px + correction_[0][1] * py);
}

void FrozenImages::visit_state(StateVisitor& visitor)
{
  images_.visit_list(visitor, "image_");
  images_.visit_loads(visitor, "image_load_");
  RecordVisitor<std::array<double, 2>> sum(visitor, "image_resultant_", resultant_);
  sum.each("x", "N/m", [](auto& force) -> double& { return force[0]; });
  sum.each("y", "N/m", [](auto& force) -> double& { return force[1]; });
  RecordVisitor<std::array<double, 2>> correction(visitor, "image_correction_", correction_);
  correction.each("x", "m/s2", [](auto& acceleration) -> double& { return acceleration[0]; });
  correction.each("y", "m/s2", [](auto& acceleration) -> double& { return acceleration[1]; });
}

std::string FrozenImages::state_problem(const Domain& domain) const
{
  if (resultant_.size() > 1 || correction_.size() != 1)
    return "the images' resultant or correction is not one";
  return images_.problem(domain.grid, domain.particles, images_.loads.size());
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
    if (!within_tile(grid, image.block, p.x[k] + image.offset.x(), p.y[k] + image.offset.y()))
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
  each.each("offset_x", "m", [](Image& image) -> double& { return image.offset.x(); });
  each.each("offset_y", "m", [](Image& image) -> double& { return image.offset.y(); });
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
