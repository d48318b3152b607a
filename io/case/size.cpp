#include "io/case/size.hpp"

#include "io/case/sections.hpp"
#include "io/common/memory.hpp"
#include "solver/mpm/grid.hpp"

#include <fmt/format.h>

namespace mpm
{
namespace
{
// Bytes of a particle: 19 doubles and the id in a checkpoint, its rank in its block besides in memory; what
// is written is put together there, and files take a fifth more than they hold. Peaks measured: 146 and 209
// MB in the two stages of cases/slope with 273 817 particles, 313 MB for 720 000 elastic ones.
constexpr double saved = 160, held = 172, base = 30e6, written = 1.2;
constexpr double node_bytes = 72;
constexpr double column_bytes = 64;           // the outline and what it is drawn from
constexpr double sample_bytes = 16;           // a number in the history and in the checkpoint
constexpr double most_count = 2e9;            // of particles, nodes and columns, which 32 bits number
constexpr double finest = 1e-6, finer = 1e-8; // rounding of the coordinates, in cells: refused, warned of

/// History variables of the particles, at most.
double history_variables(const Case& case_file)
{
  std::size_t most = 0;
  for (const Material& material : case_file.materials) most = std::max(most, material.state_fields().size());
  return static_cast<double>(most);
}

const YamlNode& spacing_node(const YamlNode& tree)
{
  return *tree.child("grid")->child("spacing");
}

/// Coordinates may be so large that numbers cannot tell the parts of a cell apart.
void check_coordinates(Case& case_file, const YamlNode& tree, Problems& problems)
{
  double farthest = std::max({std::fabs(case_file.domain.left), std::fabs(case_file.domain.right),
                              std::fabs(case_file.domain.bottom)});
  for (const double x : {case_file.domain.left, case_file.domain.right})
    farthest = std::max(farthest, std::fabs(case_file.ground_height(x)));
  const double lost = std::numeric_limits<double>::epsilon() * farthest / case_file.grid.spacing;
  const std::string what = fmt::format(
      "coordinates of {:.3g} m are known to {:.1g} m, too coarse for cells of {:.3g} m; take the origin of "
      "domain, surfaces, regions and gauges near the ground",
      farthest, lost * case_file.grid.spacing, case_file.grid.spacing);
  const YamlNode& x = *tree.child("domain")->child("x");
  if (lost > finest)
    problems.add(x.location, x.path, what);
  else if (lost > finer)
    case_file.warnings.push_back("domain: " + what);
}

/// Cell size with which a run would fit, rounded up to two digits, as a piece of advice; none where the
/// domain would not be ten of them wide.
std::string larger_cells(const Case& case_file, double needed, double bytes)
{
  const double h = case_file.grid.spacing * std::sqrt(needed / std::max(bytes, 1.0)) * 1.1;
  const double unit = std::pow(10, std::floor(std::log10(h)) - 1), rounded = std::ceil(h / unit) * unit;
  return !(10 * rounded <= case_file.domain.width()) ? "" : fmt::format(" ({:.2g} m would do)", rounded);
}

/// What is wrong with the size of a case; empty: nothing.
std::string size_problem(const Case& case_file, const CaseSize& size, const FreeMemory& free)
{
  const double needed = memory_needed(size, case_file);
  const std::string what =
      fmt::format("makes about {:.3g} particles in {:.3g} columns", size.particles, size.columns);
  if (0.8 * needed > free.bytes)
    return fmt::format("{}, which need about {} of memory, and {} {}; use larger cells{} or a smaller domain",
                       what, bytes_text(needed), free.limit, bytes_text(free.bytes),
                       larger_cells(case_file, needed, free.bytes));
  if (std::max({size.particles, size.nodes, size.columns}) > most_count)
    return fmt::format(
        "{}, and {:.0e} are the most that can be numbered; use larger cells or a smaller domain", what,
        most_count);
  return {};
}
} // namespace

double frame_bytes(const Case& case_file)
{
  double numbers = 6; // position, id, material, volume
  for (const std::string& field : case_file.output.frames.fields)
    numbers += field == "displacement" || field == "velocity" ? 3 : field == "stress" ? 6 : 1; // and p, q
  return 8 * numbers;
}

CaseSize expected_size(const Case& case_file)
{
  constexpr double most_strips = 1000;
  const double h = case_file.grid.spacing, d = case_file.grid.particle_spacing(),
               width = case_file.domain.width();
  const double strips = std::clamp(std::floor(width / d), 1.0, most_strips), step = width / strips;
  double area = 0, outline = 0;
  for (int k = 0; k < static_cast<int>(strips); ++k)
  {
    double height = 0;
    for (const Layer& layer :
         case_file.layers(case_file.domain.left + k * step, case_file.domain.left + (k + 1) * step))
      height += layer.top - layer.bottom;
    area += step * height;
    outline += height > 0 ? 2 * step : 0;
  }
  CaseSize size;
  size.particles = area / (d * d);
  // The blocks that hold ground, cut by its outline, and one more all around.
  constexpr double rim = 2 * block_cells;
  size.nodes = (area + rim * h * outline + rim * rim * h * h) / (h * h);
  size.columns = width / d;
  const OutputSettings& output = case_file.output;
  if (case_file.seismic.duration > 0)
    size.samples =
        case_file.seismic.duration / output.gauges.every * (10 + 6.0 * output.gauges.points.size()) +
        case_file.seismic.duration / slide_every * 60;
  return size;
}

double memory_needed(const CaseSize& size, const Case& case_file)
{
  const double frame = case_file.seismic.duration != 0 ? 2 * frame_bytes(case_file) : 0;
  const double particle =
      held + 8 * history_variables(case_file) + written * std::max(frame, checkpoint_bytes(1, case_file));
  return base + size.particles * particle + size.nodes * node_bytes + size.columns * column_bytes +
         size.samples * sample_bytes;
}

double checkpoint_bytes(double particles, const Case& case_file)
{
  return particles * (saved + 8 * history_variables(case_file));
}

void check_size(Case& case_file, const YamlNode& tree, Problems& problems)
{
  const YamlNode& spacing = spacing_node(tree);
  const double d = case_file.grid.particle_spacing();
  if (!(d * d > std::numeric_limits<double>::min()) || !std::isfinite(case_file.domain.width() / d))
    return problems.add(spacing.location, spacing.path,
                        "makes more cells than numbers can count; use larger cells");
  // 20 % of what is free is left to the machine.
  const CaseSize size = expected_size(case_file);
  const FreeMemory free = free_memory();
  if (const double histories = sample_bytes * size.samples; 0.8 * histories > free.bytes)
  {
    const YamlNode& duration = *tree.child("seismic")->child("duration");
    problems.add(
        duration.location, duration.path,
        fmt::format("makes histories of {}, and {} {}; shorten it or take a longer output.gauges.every",
                    bytes_text(histories), free.limit, bytes_text(free.bytes)));
  }
  else if (const std::string problem = size_problem(case_file, size, free); !problem.empty())
    problems.add(spacing.location, spacing.path, problem);
  else if (const double needed = memory_needed(size, case_file); needed > 0.8 * free.bytes)
    case_file.warnings.push_back(fmt::format("{}: {}: needs about {} of memory, and {} {}",
                                             spacing.location.text(), spacing.path, bytes_text(needed),
                                             free.limit, bytes_text(free.bytes)));
  if (problems.count() == 0) check_coordinates(case_file, tree, problems);
}
} // namespace mpm
