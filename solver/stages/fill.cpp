#include "solver/stages/fill.hpp"

#include <cmath>

namespace mpm
{
namespace
{
constexpr double rounding = 1e-9; // of a sub-cell

/// A stretch of a column that one material has.
struct Stretch
{
  double bottom, top;
  int material;
};

std::vector<Stretch> stretches(const Case& scene, double left, double right)
{
  std::vector<Stretch> all;
  for (const Layer& layer : scene.layers(left, right))
  {
    const int material = scene.regions[layer.region].material;
    const bool joins = !all.empty() && all.back().material == material &&
                       layer.bottom - all.back().top <= rounding * scene.grid.particle_spacing();
    if (joins)
      all.back().top = layer.top;
    else
      all.push_back({layer.bottom, layer.top, material});
  }
  return all;
}

/// Particles of one stretch of a column at x; false if it is too thin for any.
bool fill_stretch(const Stretch& s, double x, double base, double d, std::vector<Seed>& seeds)
{
  if (s.top - s.bottom < d / 2) return false;
  // Sub-cells [first, end) have their centres inside; a layer of half a sub-cell that holds none is one
  // particle.
  const auto first = static_cast<long>(std::ceil((s.bottom - base) / d - 0.5));
  const auto end = static_cast<long>(std::ceil((s.top - base) / d - 0.5));
  if (end <= first)
  {
    seeds.push_back({x, (s.bottom + s.top) / 2, d * (s.top - s.bottom), s.material});
    return true;
  }
  for (long k = first; k < end; ++k)
  {
    const double low = k == first ? s.bottom : base + d * static_cast<double>(k);
    const double high = k + 1 == end ? s.top : base + d * static_cast<double>(k + 1);
    seeds.push_back({x, (low + high) / 2, d * (high - low), s.material});
  }
  return true;
}
} // namespace

Filling fill(const Case& scene)
{
  Filling filling;
  filling.material_area.assign(scene.materials.size(), 0);
  filling.material_area_lost.assign(scene.materials.size(), 0);
  const double d = scene.grid.particle_spacing();
  const long columns = std::lround(scene.domain.width() / d);
  for (long column = 0; column < columns; ++column)
  {
    const double left = scene.domain.left + d * static_cast<double>(column);
    for (const Stretch& s : stretches(scene, left, left + d))
    {
      const double area = d * (s.top - s.bottom);
      filling.material_area[s.material] += area;
      if (!fill_stretch(s, left + d / 2, scene.domain.bottom, d, filling.seeds))
        filling.material_area_lost[s.material] += area;
    }
  }
  return filling;
}
} // namespace mpm
