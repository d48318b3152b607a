#include "io/case/profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mpm
{
namespace
{
constexpr double cells_per_band = LinearSoftening::usual_band_cells;
constexpr double level = 0.1; // of the ground that can yield: what rises less is no slope

bool can_yield(const Material& material)
{
  return !material.state_fields().empty();
}

/// Width of the softening band that the case itself gives, m; 0: there is none, or it goes with the cells.
double given_band(const Material& material)
{
  const auto width = [](const auto& law)
  {
    if constexpr (requires { law.band_width; }) return std::isnan(law.band_width) ? 0.0 : law.band();
    return 0.0;
  };
  return std::visit(width, material.law);
}

/// Area and length of each material's layers, and the thickest ground that can yield.
struct Walk
{
  std::vector<double> area, length; ///< m2, m; by material
  double thickest = 0, lowest = INFINITY, highest = -INFINITY;
};

/// Whether a surface that bounds a region rises or falls by `height` (m) or more.
bool is_slanted(const Case& case_file, double height)
{
  constexpr int places = 1000;
  const auto varies = [&](int surface)
  {
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k <= places; ++k)
    {
      const double x = case_file.domain.left + case_file.domain.width() * k / places;
      const double y = std::max(case_file.domain.bottom, case_file.surfaces[surface].height(x));
      low = std::min(low, y);
      high = std::max(high, y);
    }
    return high - low >= height;
  };
  return std::ranges::any_of(case_file.regions, [&](const Region& r)
                             { return varies(r.below) || (r.above && varies(*r.above)); });
}

/// Adds a strip's layers; those of one material that touch count as one.
void add_strip(const Case& case_file, double from, double to, Walk& walk)
{
  double yielding = 0;
  int last = -1;
  double top = NAN;
  for (const Layer& layer : case_file.layers(from, to))
  {
    const int material = case_file.regions[layer.region].material;
    const double thickness = layer.top - layer.bottom;
    walk.area[material] += thickness * (to - from);
    if (material != last || layer.bottom != top) walk.length[material] += to - from;
    if (can_yield(case_file.materials[material])) yielding += thickness;
    last = material;
    top = layer.top;
  }
  if (last < 0) return;
  walk.thickest = std::max(walk.thickest, yielding);
  walk.lowest = std::min(walk.lowest, top);
  walk.highest = std::max(walk.highest, top);
}

Walk walk_through(const Case& case_file)
{
  constexpr int strips = 1000;
  Walk walk;
  walk.area.assign(case_file.materials.size(), 0);
  walk.length = walk.area;
  const double step = case_file.domain.width() / strips;
  for (int k = 0; k < strips; ++k)
    add_strip(case_file, case_file.domain.left + k * step, case_file.domain.left + (k + 1) * step, walk);
  return walk;
}

/// Number of digits of a length, up to 6.
int digits(double value)
{
  for (int count = 1; count < 6; ++count)
    if (std::fabs(std::stod(fmt::format("{:.{}e}", value, count - 1)) / value - 1) < 1e-12) return count;
  return 6;
}

/// One demand on the cells and how it is said.
struct Demand
{
  double spacing; ///< m, at most
  std::string reason;
};

std::vector<Demand> demands(const StandardProfile& profile, const Case& case_file)
{
  const Scales scales = scales_of(case_file);
  const double wave = scales.softest / case_file.grid.frequency;
  std::vector<Demand> all{
      {wave / profile.cells_per_wave,
       fmt::format("{:g} cells in S waves of {:g} Hz in {} ({:.3g} m)", profile.cells_per_wave,
                   case_file.grid.frequency, scales.softest_name, wave)}};
  const auto add = [&](const Scales::Length& length, double cells, const std::string& what)
  {
    if (length.known())
      all.push_back({length.value / cells,
                     fmt::format("{:g} cells across {}{} ({:.3g} m)", cells, what, length.of, length.value)});
  };
  add(scales.layer, profile.cells_per_layer, "");
  add(scales.slide, profile.cells_per_slide, "");
  add(scales.band, cells_per_band, "the softening band of ");
  return all;
}

/// The demands, the one that decides first.
std::string told(std::vector<Demand> all)
{
  std::ranges::stable_sort(all, {}, &Demand::spacing);
  std::string text;
  for (const Demand& demand : all)
    text += fmt::format("{}at most {:.3g} m for {}", text.empty() ? "" : "; ", demand.spacing, demand.reason);
  return text;
}
} // namespace

Scales scales_of(const Case& case_file)
{
  const Walk walk = walk_through(case_file);
  Scales scales;
  const double area = std::accumulate(walk.area.begin(), walk.area.end(), 0.0);
  for (std::size_t m = 0; m < case_file.materials.size(); ++m)
  {
    const Material& material = case_file.materials[m];
    if (walk.length[m] == 0) continue;
    if (const double speed = material.elastic().shear_speed(); speed < scales.softest)
    {
      scales.softest = speed;
      scales.softest_name = material.name;
    }
    const double mean = walk.area[m] / walk.length[m];
    if (!can_yield(material)) continue;
    scales.yielding += walk.area[m] / area;
    if (mean < scales.layer.value) scales.layer = {mean, material.name};
    if (const double band = given_band(material); band > 0 && band < scales.band.value)
      scales.band = {band, material.name};
  }
  const double rise = walk.highest - walk.lowest;
  const double ground = area / case_file.domain.width();
  scales.level = !is_slanted(case_file, level * (walk.thickest > 0 ? walk.thickest : ground));
  if (walk.thickest > 0 && rise > level * walk.thickest)
    scales.slide = {std::clamp(rise, walk.thickest / 2, walk.thickest), "what can slide"};
  return scales;
}

double fitting_spacing(double width, double target)
{
  constexpr double less = 0.9, rounding = 1e-9;
  const double fewest = std::max(1.0, std::ceil(width / target * (1 - rounding)));
  double best = width / fewest;
  for (double cells = fewest; cells <= width / (less * target); ++cells)
    if (const double h = width / cells; digits(h) < digits(best)) best = h;
  return best;
}

ProfileChoice choose(const StandardProfile& profile, const Case& case_file)
{
  const std::vector<Demand> all = demands(profile, case_file);
  const double target = std::ranges::min(all, {}, &Demand::spacing).spacing, width = case_file.domain.width(),
               spacing = fitting_spacing(width, target);
  ProfileChoice choice;
  const auto set = [&](const std::string& key, const std::string& value)
  { choice.values.emplace_back(key, value); };
  set("grid.spacing", fmt::format("{:.15g} m", spacing));
  set("grid.particles_per_cell", profile.papers_method ? "3" : "2");
  set("grid.interfaces", profile.papers_method ? "sharp" : "averaged");
  if (profile.papers_method) set("grid.softening", "local");
  if (case_file.seismic.duration != 0)
  {
    set("seismic.transfer", profile.papers_method ? "apic" : "flip");
    set("seismic.inertia", profile.papers_method ? "lumped" : "consistent");
    set("time_step.courant_number", profile.papers_method ? "0.5" : "0.7");
    // The paper's transfer filters in every step; a filter of the case was meant for the other one.
    if (profile.papers_method) set("seismic.filter.time", "0 s"), set("seismic.filter.strain", "0");
  }
  std::string method;
  for (std::size_t k = 1; k < choice.values.size(); ++k)
    method += fmt::format("{}{} {}", k > 1 ? ", " : "", choice.values[k].first, choice.values[k].second);
  choice.reasons = {fmt::format("grid.spacing {:.6g} m, {:.0f} of which lie between the sides: {}", spacing,
                                width / spacing, told(all)),
                    method + (profile.papers_method ? ": the paper's method"
                                                    : ": what carries waves on the fewest particles")};
  return choice;
}

const StandardProfile* standard_profile(std::string_view name)
{
  const auto* const found = std::ranges::find(standard_profiles, name, &StandardProfile::name);
  return found == standard_profiles.end() ? nullptr : found;
}
} // namespace mpm
