#include "io/case/case.hpp"

#include "io/case/profiles.hpp"
#include "io/case/sections.hpp"
#include "io/common/error.hpp"
#include "io/common/input_file.hpp"
#include "io/common/printable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mpm
{
namespace
{
// Raised when a case of the old form would mean something else; keys that only got another name are in
// renamed_keys.hpp.
constexpr std::string_view schema = "seismpm-case/1";
// As many as are read back from a case that is written out: a point of a surface is two, and three values of
// YAML.
constexpr std::size_t most_settings = 50'000;

/// The case as text; `Error` input_missing.
std::string read_file(const std::filesystem::path& path)
{
  InputText input = read_input(path, most_of_case);
  if (!input.problem.empty())
    throw Error(exit_code::input_missing,
                path.string() + ": " + input.problem + "; give the path of a case file");
  return std::move(input.text);
}

void check_schema(Section& root)
{
  const std::string given = root.text({"schema", "the form of the case file", schema});
  if (!given.empty() && given != schema)
    root.error("schema", "is '" + given + "'; this program reads '" + std::string(schema) + "'");
}

/// `grid`.
GridSettings read_grid(Section grid)
{
  GridSettings settings;
  settings.spacing = grid.number({"spacing", "cell size h"}, Dimension::length, Interval::positive());
  settings.frequency = grid.number_or(
      settings.frequency,
      {"frequency", "highest frequency of S waves that the profiles quick, standard, fine and paper make "
                    "cells for; changes nothing else"},
      Dimension::frequency, Interval::positive());
  settings.particles_per_cell = grid.integer_or(
      settings.particles_per_cell, {"particles_per_cell", "particles along each side of a cell"}, 1, 10);
  settings.average_flow =
      grid.choice_or(0,
                     {"softening", "averaged: a band softens by its slip over the width that its law states; "
                                   "local: each particle by its own strain, as the paper's"},
                     {"averaged", "local"}) == 0;
  settings.average_volume =
      grid.choice_or(0,
                     {"volume_average", "cell: ground that can yield changes its volume by cells, not by "
                                        "particles, which unlocks flow at constant volume"},
                     {"none", "cell"}) == 1;
  settings.interfaces = static_cast<Interfaces>(grid.choice_or(
      1,
      {"interfaces", "averaged: particles within 3/4 of a cell of an interface have averaged elastic moduli, "
                     "and those that cannot yield the law of the ground that can"},
      {"sharp", "averaged"}));
  return settings;
}

/// `domain`. That its width is a whole number of cells is seen to where the grid is known, in geometry.cpp.
Extent read_domain(Section domain, Problems& problems)
{
  Extent extent;
  if (const YamlNode* x =
          domain.require({"x", "the sides, a whole number of cells apart", "[left, right], lengths"}))
  {
    const Point sides = read_point(*x, problems);
    extent.left = sides.x;
    extent.right = sides.y;
    if (sides.x >= sides.y) domain.error("x", "the right side must lie right of the left one");
  }
  extent.bottom = domain.number({"bottom", "height y of the base"}, Dimension::length);
  return extent;
}

/// `courant_number` of a stage.
double read_courant_number(Section& section, double fallback, std::string_view meaning)
{
  static const std::string reason = fmt::format(
      "where loose particles at the surface become unstable; {} is the default of the seismic stage, {} of "
      "the static one (map courant of cases/verification/ATLAS.md)",
      usual_courant_number, fast_courant_number);
  return section.number_or(
      fallback, {"courant_number", meaning}, Dimension::none,
      {.lower = 0, .lower_allowed = false, .upper = stable_courant_number, .reason = reason});
}

/// `static`.
StaticSettings read_static(Section section)
{
  StaticSettings s;
  s.gravity = section.number_or(
      s.gravity, {"gravity", "downwards; 0: no static stage, mpm-seismic starts free of stress"},
      Dimension::acceleration, Interval::not_negative());
  s.ramp = section.number_or(s.ramp, {"ramp", "time over which gravity grows"}, Dimension::time,
                             Interval::positive());
  s.damping = section.number_or(s.damping, {"damping", "local damping, as a share of the unbalanced force"},
                                Dimension::none, {.lower = 0, .upper = 1, .upper_allowed = false});
  s.courant_number = read_courant_number(section, s.courant_number,
                                         "Courant number dt c_p / h; there are no waves to carry");
  s.mass_scaling = section.choice_or(0,
                                     {"masses", "scaled: inertia, not weight, such that waves are as slow "
                                                "everywhere as in the slowest material"},
                                     {"scaled", "physical"}) == 0;
  Section until = section.optional_section("until");
  s.until.unbalanced = until.number_or(
      s.until.unbalanced,
      {"unbalanced", "converged when the nodes' unbalanced force is this share of the forces on them"},
      Dimension::none, Interval::positive());
  s.until.kinetic = until.number_or(
      s.until.kinetic, {"kinetic", "and the kinetic energy this share of the potential energy of gravity"},
      Dimension::none, Interval::positive());
  // A ramp of any length leaves as much time again to settle.
  const double default_end = std::max(s.until.at_most, 2 * s.ramp);
  s.until.at_most = until.number_or(
      default_end,
      {"at_most", "model time after which the stage gives up (exit code 81)", "", "60 s, at least two ramps"},
      Dimension::time, Interval::positive());
  if (s.until.at_most < s.ramp)
    until.error("at_most", "ends before the ramp does; give more than static.ramp");
  return s;
}

/// Puts a profile of every case into the tree. What it sets follows from the case as it is without, --set
/// included; nothing in it speaks against cells that are tiny.
void apply_standard_profile(Case& case_file, YamlNode& tree, Problems& problems)
{
  YamlNode without = tree;
  Problems wrong;
  for (const std::string& text : case_file.overrides) apply_override(without, text, wrong);
  apply_override(without, "grid.spacing=1 mm", wrong);
  Case draft = case_file;
  read_parts(draft, without, wrong);
  wrong.throw_if_any();
  const ProfileChoice choice = choose(*standard_profile(case_file.profile), draft);
  for (const auto& [key, value] : choice.values) apply_override(tree, key + "=" + value, problems);
  case_file.chosen = choice.reasons;
}

/// All that was read, and what was looked at in another way as it stands.
Settings::Entries resolved(const Case& case_file, const YamlNode& tree, Settings settings)
{
  // What was looked at in another way than by a reader of numbers and words stands here as it was typed.
  for (const auto& [path, text] : flattened(tree))
    if (!settings.knows(path)) settings.set(path, text);
  const SeismicSettings& seismic = case_file.seismic;
  // "auto" depends on the ground; written out, the case means the same when a default changes.
  if (settings.knows("seismic.duration") && seismic.base == BaseKind::compliant && !seismic.spring)
    settings.set("seismic.base.spring", quantity_text(case_file.longest_period(), Dimension::time));
  return settings.entries();
}
} // namespace

void read_parts(Case& case_file, const YamlNode& tree, Problems& problems)
{
  const std::filesystem::path folder = case_file.path.parent_path();
  Section root(&tree, problems);
  check_schema(root);
  case_file.name = root.text_or(printable(case_file.path.stem().string(), ""),
                                {"name", "for messages and pictures", "", "name of the file"});
  case_file.grid = read_grid(root.section("grid"));
  case_file.domain = read_domain(root.section("domain"), problems);
  case_file.surfaces = read_surfaces(root, folder, problems);
  case_file.materials = read_materials(root, case_file.grid.spacing, problems);
  case_file.regions = read_regions(root, case_file.surfaces, case_file.materials, problems);
  case_file.static_stage = read_static(root.optional_section("static"));
  case_file.seismic = read_seismic(root, folder, problems);
  Section time_step = root.optional_section("time_step");
  case_file.courant_number = read_courant_number(
      time_step, case_file.courant_number,
      "Courant number dt c_p / h; with seismic.transfer: apic a smaller one damps waves more");
  case_file.output = read_output(root, case_file.materials, problems);
  if (const std::size_t count = problems.settings.entries().size(); count > most_settings)
    root.error("surfaces",
               fmt::format("are of so many points that the case has {} values, and {} are read; thin "
                           "them out, a point for each cell is enough",
                           count, most_settings));
}

Case load_case(const std::filesystem::path& path, const std::vector<std::string>& overrides,
               const std::string& profile)
{
  Case case_file;
  case_file.path = path;
  case_file.text = read_file(path);
  case_file.profile = profile;
  case_file.overrides = overrides;
  Problems problems;
  YamlNode tree = parse_yaml(case_file.text, path.string(), problems);
  if (tree.kind == YamlNode::Kind::empty) problems.throw_if_any(); // not YAML: nothing more can be said
  // The profile first: --set has the last word.
  std::vector<std::string> standard;
  for (const StandardProfile& each : standard_profiles) standard.emplace_back(each.name);
  if (!apply_profile(tree, profile, standard, problems) && standard_profile(profile) != nullptr)
    apply_standard_profile(case_file, tree, problems);
  for (const std::string& text : overrides) apply_override(tree, text, problems);
  read_parts(case_file, tree, problems);
  problems.throw_if_any();
  check_geometry(case_file, tree, problems);
  problems.throw_if_any();
  case_file.settings = resolved(case_file, tree, problems.settings);
  return case_file;
}
} // namespace mpm
