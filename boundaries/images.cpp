#include "boundaries/images.hpp"

#include "solver/mpm/chunk.hpp"

#include <algorithm>
#include <numeric>

namespace mpm
{
namespace
{
/// Cells beyond a wall that images must fill: two are reached by a ghost node two cells out (METHODS section
/// 3).
constexpr double strip = 4;

/// Mirrors an image (or a particle, taken as its own image) at one more wall: X* = M X, Sigma* = S Sigma M.
Image mirror(const Image& original, const Wall& wall, const Eigen::Vector2d& parent, double wall_position)
{
  const int normal = wall.normal == Direction::x ? 0 : 1;
  const Eigen::DiagonalMatrix<double, 2> S(wall.image_sign_x(), wall.image_sign_y());
  const Eigen::DiagonalMatrix<double, 2> M(normal == 0 ? -1 : 1, normal == 1 ? -1 : 1);
  Image image = original;
  image.offset[normal] = 2 * wall_position - 2 * parent[normal] - original.offset[normal];
  image.stress = S * original.stress * M;
  image.weight = S * original.weight;
  return image;
}

/// Order of the images: by block, then as their parents stand, so that neighbours follow each other.
struct Place
{
  BlockIndex block;
  int parent, image;
  auto operator<=>(const Place&) const = default;
};
} // namespace

std::vector<Image> make_images(const Domain& domain, std::span<const Wall> walls)
{
  std::vector<Image> result;
  const Particles& p = domain.particles;
  const Grid& g = domain.grid;
  for (int id = 0; id < p.size(); ++id)
  {
    const int k = domain.place[id];
    Image self{.parent = id};
    self.stress << p.stress_xx[k], p.stress_xy[k], p.stress_xy[k], p.stress_yy[k];
    self.stress *= p.volume[k];
    self.weight = p.mass[k] * Eigen::Vector2d(domain.gravity_x, domain.gravity_y);
    std::vector<Image> family{self};
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
    result.insert(result.end(), family.begin() + 1, family.end());
  }
  return result;
}

void place_images(const Domain& domain, std::vector<Image>& images)
{
  const Grid& g = domain.grid;
  const auto cell = [&](double x, double origin)
  { return static_cast<int>(std::floor((x - origin) * g.inverse_spacing())); };
  for (Image& image : images)
  {
    const int parent = domain.place[image.parent];
    const int i = cell(domain.particles.x[parent] + image.offset.x(), g.origin_x);
    const int j = cell(domain.particles.y[parent] + image.offset.y(), g.origin_y);
    image.block = {g.wrapped ? 0 : block_of(i), block_of(j)};
  }
}

void ImageBlocks::bind(const Domain& domain, const std::vector<Image>& images)
{
  std::vector<Place> places;
  for (std::size_t k = 0; k < images.size(); ++k)
    places.push_back({images[k].block, domain.place[images[k].parent], static_cast<int>(k)});
  std::sort(places.begin(), places.end());
  order_.clear();
  homes_.clear();
  colours_ = {};
  for (const Place& place : places)
  {
    const int at = static_cast<int>(order_.size());
    if (homes_.empty() || homes_.back().block != place.block)
      homes_.push_back({place.block, domain.grid.around(place.block), at, at});
    order_.push_back(place.image);
    homes_.back().end = at + 1;
  }
  for (std::size_t k = 0; k < homes_.size(); ++k)
    colours_[homes_[k].block.colour()].add(static_cast<int>(k), homes_[k].end - homes_[k].begin);
}

namespace
{
/// Acceleration of the ghosts' mass by row of a block's tile, m/s2.
using RowAccelerations = std::array<std::array<double, 2>, tile_nodes>;

RowAccelerations accelerations(BlockIndex block, const ImageBlocks::Extra& extra)
{
  RowAccelerations result{};
  const int first = block.y * block_cells - tile_margin - extra.first_row;
  for (int row = 0; row < tile_nodes; ++row)
    if (first + row >= 0 && first + row < static_cast<int>(extra.acceleration.size()))
      result[row] = extra.acceleration[first + row];
  return result;
}

/// What the images of a chunk bring to the nodes: stress column by column and weight, as vectors (x, y).
struct ImageSources
{
  double x[chunk_size], y[chunk_size], mass[chunk_size];
  double stress_x[chunk_size][2], stress_y[chunk_size][2], weight[chunk_size][2];

  void take(int k, const Domain& domain, const Image& image, const Eigen::Matrix2d* extra)
  {
    const int parent = domain.place[image.parent];
    x[k] = domain.particles.x[parent] + image.offset.x();
    y[k] = domain.particles.y[parent] + image.offset.y();
    mass[k] = inverse_weights * image.mass;
    Eigen::Matrix2d stress = image.stress;
    if (extra) stress += *extra;
    const double factor = -inverse_slopes * domain.grid.inverse_spacing();
    for (int c = 0; c < 2; ++c)
    {
      stress_x[k][c] = factor * stress(c, 0);
      stress_y[k][c] = factor * stress(c, 1);
      weight[k][c] = inverse_weights * image.weight[c];
    }
  }
};

/// Sums at the 16 nodes of one cell's stencil, kept while one image after the other stands in that cell.
class ImageSums
{
public:
  explicit ImageSums(int node) : node_(node) {}

  void add(int k, const ChunkStencils& s, const ImageSources& from)
  {
    const Spline<Row> x = cubic_spline(s.x_fraction[k]);
    const Pairs w = twice(x.weight), f_slope = w * everywhere(from.stress_y[k]);
    const Pairs f_w = twice(x.slope) * everywhere(from.stress_x[k]) + w * everywhere(from.weight[k]);
    const Row m = from.mass[k] * x.weight;
#pragma GCC unroll 4
    for (int j = 0; j < 4; ++j)
    {
      force_[j] += s.y_weight[j][k] * f_w;
      force_[j] += s.y_slope[j][k] * f_slope;
      mass_[j] += s.y_weight[j][k] * m;
    }
  }

  /// Adds the sums, less the inertia of the images' mass, to a tile.
  void flush(const RowAccelerations& a, PairTile& force) const
  {
    for (int j = 0; j < 4; ++j)
    {
      const int node = node_ + j * tile_stride;
      const Pairs inertia = twice(mass_[j]) * everywhere(a[node / tile_stride].data());
      double* at = &force.value[2 * node];
      store_pairs(at, load_pairs(at) + (force_[j] - inertia));
    }
  }

private:
  int node_;
  Row mass_[4]{};
  Pairs force_[4]{};
};
} // namespace

void ImageBlocks::scatter(const Domain& domain, ImageHome& home, const std::vector<Image>& images,
                          const Extra& extra) const
{
  home.force.value.fill(0);
  const RowAccelerations a = accelerations(home.block, extra);
  const TileStencils tile(domain.grid, home.block);
  ChunkStencils stencils;
  ImageSources from;
  for (int begin = home.begin; begin < home.end; begin += chunk_size)
  {
    const int count = std::min(chunk_size, home.end - begin);
    for (int k = 0; k < count; ++k)
    {
      const int image = order_[begin + k];
      from.take(k, domain, images[image], extra.stress.empty() ? nullptr : &extra.stress[image]);
    }
    stencils.find(tile, from.x, from.y, count);
    for (int k = 0; k < count;)
    {
      const int node = stencils.node[k];
      ImageSums sums(node);
      for (; k < count && stencils.node[k] == node; ++k) sums.add(k, stencils, from);
      sums.flush(a, home.force);
    }
  }
}

std::array<double, 2> ImageBlocks::gather(Grid& g, const ImageHome& home) const
{
  std::array<double, 2> sum{};
  for_each_run(g, home.around,
               [&](int node, int place, int count)
               {
                 for (int k = 0; k < count; ++k)
                 {
                   const double* force = &home.force.value[2 * (place + k)];
                   if (g.mass[node + k] <= 0) continue;
                   sum[0] += force[0];
                   sum[1] += force[1];
                   g.force_x[node + k] += force[0];
                   g.force_y[node + k] += force[1];
                 }
               });
  return sum;
}

std::array<double, 2> ImageBlocks::add_forces(Domain& domain, const std::vector<Image>& images,
                                              const Extra& extra)
{
  std::vector<std::array<double, 2>> parts(homes_.size());
  parallel::for_each_in_turn(colours_,
                             [&](int k)
                             {
                               scatter(domain, homes_[k], images, extra);
                               parts[k] = gather(domain.grid, homes_[k]);
                             });
  std::array<double, 2> sum{};
  for (const auto& part : parts)
  {
    sum[0] += part[0];
    sum[1] += part[1];
  }
  return sum;
}

double ImageBlocks::work(const Domain& domain, double dt) const
{
  const Grid& g = domain.grid;
  std::vector<double> parts(homes_.size());
  parallel::for_each(static_cast<int>(homes_.size()), block_cost,
                     [&](int at)
                     {
                       const ImageHome& home = homes_[at];
                       double power = 0;
                       for_each_run(g, home.around,
                                    [&](int node, int place, int count)
                                    {
                                      for (int k = 0; k < count; ++k)
                                      {
                                        const auto [vx, vy] = g.middle_velocity(node + k);
                                        const double* force = &home.force.value[2 * (place + k)];
                                        power += force[0] * vx + force[1] * vy;
                                      }
                                    });
                       parts[at] = dt * power;
                     });
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

void FrozenImages::bind(const Domain& domain)
{
  blocks_.bind(domain, images_);
  mass_ = std::accumulate(domain.particles.mass.begin(), domain.particles.mass.end(), 0.0);
}

void FrozenImages::add_forces(Domain& domain, double)
{
  const std::array<double, 2> now = blocks_.add_forces(domain, images_, {});
  if (resultant_.empty()) resultant_.push_back(now);
  // Sleeping ground hides its images: the correction stays what it was, as the ground does.
  if (!domain.rests())
    correction_[0] = {(resultant_[0][0] - now[0]) / mass_, (resultant_[0][1] - now[1]) / mass_};
  const auto [ax, ay] = correction_[0];
  Grid& g = domain.grid;
  g.for_each_block(
      [&](int block)
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
  const auto [px, py] = domain.ledger.step.momentum;
  now[Energy::reaction] += blocks_.work(domain, dt) + dt * (correction_[0][0] * px + correction_[0][1] * py);
}

void FrozenImages::visit_state(StateVisitor& visitor)
{
  visit_images(visitor, "image_", images_);
  RecordVisitor<std::array<double, 2>> sum(visitor, "image_resultant_", resultant_);
  sum.each("x", "N/m", [](auto& force) -> double& { return force[0]; });
  sum.each("y", "N/m", [](auto& force) -> double& { return force[1]; });
  RecordVisitor<std::array<double, 2>> correction(visitor, "image_correction_", correction_);
  correction.each("x", "m/s2", [](auto& acceleration) -> double& { return acceleration[0]; });
  correction.each("y", "m/s2", [](auto& acceleration) -> double& { return acceleration[1]; });
}

void visit_images(StateVisitor& visitor, std::string prefix, std::vector<Image>& images)
{
  RecordVisitor<Image> list(visitor, std::move(prefix), images);
  list.each_integer(
      "parent", [](Image & image) -> auto& { return image.parent; });
  list.each_integer(
      "block_x", [](Image & image) -> auto& { return image.block.x; });
  list.each_integer(
      "block_y", [](Image & image) -> auto& { return image.block.y; });
  list.each("offset_x", "m", [](Image& image) -> double& { return image.offset.x(); });
  list.each("offset_y", "m", [](Image& image) -> double& { return image.offset.y(); });
  list.each("stress_xx", "N m/m", [](Image& image) -> double& { return image.stress(0, 0); });
  list.each("stress_xy", "N m/m", [](Image& image) -> double& { return image.stress(0, 1); });
  list.each("stress_yx", "N m/m", [](Image& image) -> double& { return image.stress(1, 0); });
  list.each("stress_yy", "N m/m", [](Image& image) -> double& { return image.stress(1, 1); });
  list.each("weight_x", "N/m", [](Image& image) -> double& { return image.weight.x(); });
  list.each("weight_y", "N/m", [](Image& image) -> double& { return image.weight.y(); });
  list.member("mass", "kg/m", &Image::mass);
}
} // namespace mpm
