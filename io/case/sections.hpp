#pragma once
// The parts that load_case is made of; nobody else needs them.

#include "io/case/case.hpp"
#include "io/case/yaml_checker.hpp"

namespace mpm
{
/// Reads all of a case from its tree, but for what only shows when the parts are put together.
void read_parts(Case& case_file, const YamlNode& tree, Problems& problems);
/// The map `surfaces`, with offsets resolved. `folder` is the case file's, for files of points.
std::vector<Surface> read_surfaces(Section& root, const std::filesystem::path& folder, Problems& problems);
/// A line of the ground from a text file of x and y, in m unless its heading names another unit of length.
Polyline read_ground_file(const YamlNode& node, const std::filesystem::path& folder, Problems& problems);
/// Refuses a line of the ground whose shape lies wholly beside the domain.
void check_extents(const Case& case_file, const YamlNode& tree, Problems& problems);
/// The list `regions`, with materials and surfaces by index.
std::vector<Region> read_regions(Section& root, const std::vector<Surface>& surfaces,
                                 const std::vector<Material>& materials, Problems& problems);
/// The names of the laws, in the order of `Law`.
std::vector<std::string> model_names();
/// The map `materials`. `spacing` (m) is the grid's, over which laws spread their softening.
std::vector<Material> read_materials(Section& root, double spacing, Problems& problems);
/// `seismic`; without it the duration is 0. `folder` is the case file's, for the records.
SeismicSettings read_seismic(Section& root, const std::filesystem::path& folder, Problems& problems);
/// `output`; the materials say which fields there are by default.
OutputSettings read_output(Section& root, const std::vector<Material>& materials, Problems& problems);

/// What only shows when the parts are put together: grid, gauges and regions that do not fit, with the
/// location of the key at fault. Adds warnings to the case.
void check_geometry(Case& case_file, const YamlNode& tree, Problems& problems);

/// Warns of what the laws say against their parameters, and of strength that falls faster than stress
/// unloads.
void warn_of_laws(Case& case_file);
/// Refuses a case that this machine cannot hold, or whose cells or coordinates numbers cannot tell apart; to
/// be called before anything goes through the columns. Warns of one that it hardly holds.
void check_size(Case& case_file, const YamlNode& tree, Problems& problems);

/// Warns of values that no ground has and of ground that yields at rest; refuses what cannot be computed
/// with.
void check_magnitudes(Case& case_file, const YamlNode& tree, Problems& problems);
} // namespace mpm
