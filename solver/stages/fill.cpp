#include "solver/stages/fill.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
constexpr double rounding = 1e-9; // of a particle spacing

/// A stretch of a column that one material has, of one region or more.
struct Stretch
{
  double bottom, top;
  int material;
  std::vector<Layer> parts;
};

/// The stretches of a column of particles, from the bottom upwards. Regions of one material that touch are
/// one, so that a line drawn within a layer leaves no trace in its particles.
std::vector<Stretch> stretches(const Case& case_file, double left, double right)
{
  std::vector<Stretch> all;
  for (const Layer& layer : case_file.layers(left, right))
  {
    const int material = case_file.regions[layer.region].material;
    const bool joins = !all.empty() && all.back().material == material &&
                       layer.bottom - all.back().top <= rounding * case_file.grid.particle_spacing();
    if (joins)
      all.back().top = layer.top;
    else
      all.push_back({layer.bottom, layer.top, material, {}});
    all.back().parts.push_back(layer);
  }
  return all;
}

/// Particles of one stretch of a column at x; false if it is too thin for any.
bool fill_stretch(const Stretch& s, double x, double base, double d, std::vector<Seed>& seeds)
{
  if (s.top - s.bottom < d / 2) return false;
  // Sub-cells k in [first, end) have their centres base + d (k + 1/2) inside; a layer of half a sub-cell that
  // holds none is one particle.
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

/// Notes what became of a stretch over [left, right].
void note(const Stretch& s, bool filled, double left, double right, std::vector<RegionFilling>& regions)
{
  for (const Layer& part : s.parts)
  {
    RegionFilling& region = regions[part.region];
    if (!filled)
    {
      region.lost.add(left, right);
      continue;
    }
    region.area += (right - left) * (part.top - part.bottom);
    region.filled.add(left, right);
    // Across a layer that dips: its height times the cosine of the dip since the column before.
    const double width = right - left, middle = 0.5 * (s.bottom + s.top);
    const double rise = std::isnan(region.middle) ? 0 : middle - region.middle;
    const double thickness = (s.top - s.bottom) * width / std::hypot(width, rise);
    region.thickness += (thickness - region.thickness) * width / region.filled.length;
    region.middle = middle;
  }
}

/// Where the drawing may have an edge within a column: ends of regions, corners of surfaces.
std::vector<double> corners(const Case& case_file)
{
  std::vector<double> found;
  for (const Region& region : case_file.regions) found.insert(found.end(), {region.left, region.right});
  for (const Surface& surface : case_file.surfaces)
    if (const auto* line = std::get_if<Polyline>(&surface.shape))
      found.insert(found.end(), line->x.begin(), line->x.end());
    else
      found.push_back(std::get<GaussianHill>(surface.shape).centre);
  std::sort(found.begin(), found.end());
  return found;
}

/// Adds the regions over [left, right], between corners: surfaces are straight there, but for hills, and the
/// midpoint rule is exact for straight ones.
void add_piece(const Case& case_file, double left, double right, std::vector<Drawn>& regions)
{
  constexpr int samples = 2;
  const double part = (right - left) / samples;
  for (int k = 0; k < samples; ++k)
  {
    const double x = left + (k + 0.5) * part;
    int last = -1; // a region may have two layers at x
    for (const Layer& layer : case_file.layers(x, x))
    {
      regions[layer.region].area += part * (layer.top - layer.bottom);
      if (layer.region != last) regions[layer.region].length += part;
      last = layer.region;
    }
  }
}
} // namespace

Filling fill(const Case& case_file)
{
  Filling filling;
  filling.regions.resize(case_file.regions.size());
  const double d = case_file.grid.particle_spacing();
  const long columns = std::lround(case_file.domain.width() / d);
  for (long column = 0; column < columns; ++column)
  {
    const double left = case_file.domain.left + d * static_cast<double>(column);
    const std::vector<Stretch> found = stretches(case_file, left, left + d);
    if (found.empty() || found.front().bottom > case_file.domain.bottom + d / 2)
      filling.bare.add(left, left + d);
    for (const Stretch& s : found)
      note(s, fill_stretch(s, left + d / 2, case_file.domain.bottom, d, filling.seeds), left, left + d,
           filling.regions);
  }
  return filling;
}

std::vector<Drawn> drawn_regions(const Case& case_file)
{
  std::vector<Drawn> regions(case_file.regions.size());
  const std::vector<double> cuts = corners(case_file);
  const double d = case_file.grid.particle_spacing();
  const long columns = std::lround(case_file.domain.width() / d);
  auto cut = cuts.begin();
  for (long column = 0; column < columns; ++column)
  {
    double left = case_file.domain.left + d * static_cast<double>(column);
    const double right = left + d;
    while (cut != cuts.end() && *cut <= left) ++cut;
    for (; cut != cuts.end() && *cut < right; ++cut)
    {
      if (*cut > left) add_piece(case_file, left, *cut, regions);
      left = *cut;
    }
    add_piece(case_file, left, right, regions);
  }
  return regions;
}
} // namespace mpm
