// What shows only when grid, domain, surfaces and regions are looked at together.

#include "boundaries/images.hpp"
#include "io/case/sections.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace mpm
{
namespace
{
constexpr double rounding = 1e-9; // of a cell

/// A length for people.
std::string metres(double value)
{
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.5g m", value);
  return text.data();
}

/// The node at the end of a path of keys; null where there is none.
const YamlNode* at(const YamlNode& tree, std::initializer_list<std::string_view> keys)
{
  const YamlNode* node = &tree;
  for (const std::string_view key : keys)
    if (node) node = node->child(key);
  return node;
}

/// Free-field columns and walls stand on grid lines: a part of a cell at a side would be neither ground nor
/// outside.
void check_width(const Case& case_file, const YamlNode& tree, Problems& problems)
{
  const double cells = case_file.domain.width() / case_file.grid.spacing;
  if (std::abs(cells - std::round(cells)) <= rounding * std::max(1.0, cells) && cells > 0.5) return;
  const YamlNode& x = *at(tree, {"domain", "x"});
  const double whole = std::max(1.0, std::round(cells)) * case_file.grid.spacing;
  problems.add(x.location, x.path,
               "is " + metres(case_file.domain.width()) + " wide; must be a whole number of cells of " +
                   metres(case_file.grid.spacing) + ", as " + metres(whole));
}

/// Half a cell beyond the ground is allowed: a gauge at the surface is meant to be at its highest particle.
void check_gauges(const Case& case_file, const YamlNode& tree, Problems& problems)
{
  const double half = case_file.grid.spacing / 2;
  for (const GaugePoint& gauge : case_file.output.gauges.points)
  {
    const YamlNode& node = *at(tree, {"output", "gauges", "points", gauge.name});
    if (gauge.x < case_file.domain.left - half || gauge.x > case_file.domain.right + half)
      problems.add(node.location, node.path,
                   "lies beside the domain, which reaches from " + metres(case_file.domain.left) + " to " +
                       metres(case_file.domain.right));
    else if (const double ground = case_file.ground_height(gauge.x);
             gauge.y > ground + half || gauge.y < case_file.domain.bottom - half)
      problems.add(node.location, node.path,
                   "lies outside the ground, which reaches here from " + metres(case_file.domain.bottom) +
                       " to " + metres(ground));
  }
}

/// Refuses a case without ground; warns of hollows and of regions that hold nothing.
void check_regions(Case& case_file, const YamlNode& tree, Problems& problems)
{
  std::vector<bool> used(case_file.regions.size(), false);
  double hollow_x = NAN;
  const double h = case_file.grid.spacing;
  for (double x = case_file.domain.left; x < case_file.domain.right - h / 2; x += h)
  {
    double reached = case_file.domain.bottom;
    for (const Layer& layer : case_file.layers(x, x + h))
    {
      used[layer.region] = true;
      if (layer.bottom > reached + rounding * h && std::isnan(hollow_x)) hollow_x = x + h / 2;
      reached = layer.top;
    }
  }
  const YamlNode& regions = *at(tree, {"regions"});
  if (std::find(used.begin(), used.end(), true) == used.end())
    return problems.add(regions.location, regions.path,
                        "hold no ground above the domain's bottom and within its sides");
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i])
      case_file.warnings.push_back(regions.children[i].location.text() + ": " + regions.children[i].path +
                                   ": holds no ground; the regions before it may have taken it");
  if (!std::isnan(hollow_x))
    case_file.warnings.push_back(regions.location.text() +
                                 ": regions: leave a hollow in the ground at x = " + metres(hollow_x));
}

bool bounds_a_region(const Case& case_file, int surface)
{
  return std::any_of(case_file.regions.begin(), case_file.regions.end(),
                     [&](const Region& r) { return r.below == surface || r.above == surface; });
}

/// How much a surface rises and falls over [from, to], what is below the bottom cut off, m.
double variation(const Case& case_file, const Surface& surface, double from, double to)
{
  double low = INFINITY, high = -INFINITY;
  for (int i = 0; i <= 100; ++i)
  {
    const double y = std::max(case_file.domain.bottom, surface.height(from + (to - from) * i / 100));
    low = std::min(low, y);
    high = std::max(high, y);
  }
  return high - low;
}

/// A free-field column cannot stand for a slope. Over the cells whose nodes the side's ghost rows reach, the
/// ground may rise or fall by a cell: more is a slope face, not unevenness.
void refuse_slopes_on_sides(const Case& case_file, const YamlNode& tree, Problems& problems)
{
  if (case_file.seismic.sides != SideKind::free_field) return;
  const double h = case_file.grid.spacing, strip = std::min(image_cells * h, case_file.domain.width());
  for (const auto& [side, from] :
       {std::pair{"left", case_file.domain.left}, std::pair{"right", case_file.domain.right - strip}})
  {
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i <= 100; ++i)
    {
      const double y = case_file.ground_height(from + strip * i / 100);
      low = std::min(low, y);
      high = std::max(high, y);
    }
    if (high - low <= h) continue;
    const YamlNode& x = *at(tree, {"domain", "x"});
    problems.add(
        x.location, x.path,
        "cuts a slope face: the ground rises or falls by " + metres(high - low) + " within " + metres(strip) +
            " of the " + side +
            " side, where a free-field column stands for level ground; move the side outwards by a slope "
            "height or more, or take seismic.sides.kind quiet or roller");
  }
}

/// A free-field column stands for level layers. What a slope scatters reaches the side as if from far away
/// only where there is level ground between them, for which one slope height is the usual least.
void warn_of_slopes_at_sides(Case& case_file)
{
  if (case_file.seismic.sides != SideKind::free_field) return;
  double low = INFINITY, high = -INFINITY;
  for (int i = 0; i <= 1000; ++i)
  {
    const double y = case_file.ground_height(case_file.domain.left + case_file.domain.width() * i / 1000);
    low = std::min(low, y);
    high = std::max(high, y);
  }
  const double strip = std::min(high - low, case_file.domain.width() / 2);
  const std::array sides{std::pair{"left", case_file.domain.left},
                         std::pair{"right", case_file.domain.right - strip}};
  for (int i = 0; i < static_cast<int>(case_file.surfaces.size()); ++i)
    for (const auto& [side, from] : sides)
      if (const double change = variation(case_file, case_file.surfaces[i], from, from + strip);
          bounds_a_region(case_file, i) && change > 0.2 * case_file.grid.spacing)
        case_file.warnings.push_back(
            "surfaces." + case_file.surfaces[i].name + ": rises or falls by " + metres(change) + " within " +
            metres(strip) + " of the " + side +
            " side; a free-field column wants level layers over one slope height there");
}

/// Near incompressibility P waves become ever faster, and the time step is set by them.
void warn_of_materials(Case& case_file)
{
  for (const Material& material : case_file.materials)
    if (material.elastic().poisson > 0.49)
      case_file.warnings.push_back(
          "materials." + material.name + ".poisson_ratio: " + number_text(material.elastic().poisson) +
          " is above 0.49: many more steps, and as much more numerical damping of shear waves with apic "
          "(map poisson of cases/verification/ATLAS.md)");
  warn_of_laws(case_file);
}

/// A line that ends within the domain goes on level, which may be meant or forgotten.
void warn_of_short_profiles(Case& case_file)
{
  for (const Surface& surface : case_file.surfaces)
  {
    const Polyline* line = std::get_if<Polyline>(&surface.shape);
    if (!line || line->x.size() < 2) continue;
    if (line->x.front() > case_file.domain.left || line->x.back() < case_file.domain.right)
      case_file.warnings.push_back("surfaces." + surface.name + ": is known from " + metres(line->x.front()) +
                                   " to " + metres(line->x.back()) + ", and taken as level beyond");
  }
}
} // namespace

std::vector<Layer> Case::layers(double from, double to) const
{
  const double middle = (from + to) / 2;
  std::vector<double> height;
  for (const Surface& surface : surfaces)
    height.push_back(
        std::max(domain.bottom, from < to ? surface.mean_height(from, to) : surface.height(from)));
  std::vector<double> cut = height;
  cut.push_back(domain.bottom);
  std::sort(cut.begin(), cut.end());

  const auto holds = [&](const Region& r, double low, double high)
  {
    return r.left <= middle && middle < r.right && (!r.above || height[*r.above] <= low) &&
           height[r.below] >= high;
  };
  std::vector<Layer> layers;
  for (std::size_t k = 1; k < cut.size(); ++k)
  {
    const double low = cut[k - 1], high = cut[k];
    if (high - low <= rounding * grid.spacing) continue;
    const auto first =
        std::find_if(regions.begin(), regions.end(), [&](const Region& r) { return holds(r, low, high); });
    if (first == regions.end()) continue;
    const int region = static_cast<int>(first - regions.begin());
    if (!layers.empty() && layers.back().region == region &&
        low - layers.back().top <= rounding * grid.spacing)
      layers.back().top = high;
    else
      layers.push_back({low, high, region});
  }
  return layers;
}

// The domain does not hold its right side: the column of cells that ends there is the one to look at.
double Case::ground_height(double x) const
{
  const double inside = std::clamp(x, domain.left, std::nextafter(domain.right, domain.left));
  const std::vector<Layer> column = layers(inside, inside);
  return column.empty() ? domain.bottom : column.back().top;
}

// T = 4 int dy / v_s, the fundamental period of level layers on a rigid base.
double Case::longest_period() const
{
  double longest = 0;
  for (double x = domain.left; x < domain.right - 0.5 * grid.spacing; x += grid.spacing)
  {
    double travel = 0;
    for (const Layer& layer : layers(x, x + grid.spacing))
      travel +=
          (layer.top - layer.bottom) / materials[regions[layer.region].material].elastic().shear_speed();
    longest = std::max(longest, 4 * travel);
  }
  return longest;
}

// In this order: the size first, because what comes after it walks through the columns, and a case of a
// billion of them would never end.
void check_geometry(Case& case_file, const YamlNode& tree, Problems& problems)
{
  check_size(case_file, tree, problems);
  if (problems.count() > 0) return;
  check_width(case_file, tree, problems);
  check_extents(case_file, tree, problems);
  check_regions(case_file, tree, problems);
  if (problems.count() > 0) return;
  check_gauges(case_file, tree, problems);
  refuse_slopes_on_sides(case_file, tree, problems);
  warn_of_slopes_at_sides(case_file);
  warn_of_materials(case_file);
  warn_of_short_profiles(case_file);
  check_magnitudes(case_file, tree, problems);
}
} // namespace mpm
