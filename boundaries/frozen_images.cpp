#include "boundaries/frozen_images.hpp"

#include <cmath>
#include <numeric>

namespace mpm
{
namespace
{
/// An image with its load.
struct Loaded
{
  Image image;
  ImageLoad load;
};

/// Mirrors an image (or a particle, taken as its own image) at one more wall. Positions are mirrored by M, -1
/// on the wall's normal axis; vectors by S, which is M where the wall slips and -1 where it sticks. So X* = M
/// X, w* = S w, and of a stress, which turns a gradient into a force, Sigma* = S Sigma M.
Loaded mirror(const Loaded& original, const Wall& wall, const std::array<double, 2>& parent,
              double wall_position)
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
    const std::array<double, 2> parent{p.x[k], p.y[k]};
    for (const Wall& wall : walls)
    {
      const double position = parent[wall.normal == Direction::x ? 0 : 1];
      const double line = (wall.normal == Direction::x ? g.origin_x : g.origin_y) + wall.line * g.spacing;
      if (std::fabs(position - line) > image_cells * g.spacing) continue;
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
      dt * images_.power(domain.grid) + dt * (correction_[0][0] * px + correction_[0][1] * py);
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
} // namespace mpm
