// `surfaces` and `regions`: the ground as lines and what lies between them.

#include "io/case/sections.hpp"

namespace mpm
{
namespace
{
/// A surface whose shape is another's.
struct Offset
{
  int base = -1; ///< -1: not an offset
  double up = 0;
};

/// What is wrong with the order of a line's points; empty: nothing.
std::string rising_problem(const Polyline& line)
{
  // The height is a function of x: overhangs cannot be drawn, vertical faces only nearly.
  for (std::size_t i = 1; i < line.x.size(); ++i)
    if (line.x[i] <= line.x[i - 1])
      return "x must grow from point to point, and " + number_text(line.x[i]) + " m follows " +
             number_text(line.x[i - 1]) + " m";
  return {};
}

/// `points` of a surface.
Polyline read_points(const YamlNode& node, Problems& problems)
{
  Polyline line;
  for (const YamlNode* element : read_list(node, "of points, as [[0 m, 25 m], [50 m, 20 m]]", problems))
  {
    const Point p = read_point(*element, problems);
    line.x.push_back(p.x);
    line.y.push_back(p.y);
  }
  if (node.kind == YamlNode::Kind::list && line.x.empty())
    problems.add(node.location, node.path, "has no points");
  if (const std::string problem = rising_problem(line); !problem.empty())
    problems.add(node.location, node.path, problem);
  return line;
}

/// The points of a file as if they stood in the case: what they are makes the ground, not where they came
/// from.
void resolve_points(const Section& section, const Polyline& line, Problems& problems)
{
  for (std::size_t i = 0; i < line.x.size(); ++i)
  {
    const std::string point = "points[" + std::to_string(i) + "]";
    section.resolve(point + "[0]", quantity_text(line.x[i], Dimension::length));
    section.resolve(point + "[1]", quantity_text(line.y[i], Dimension::length));
  }
  // The points stand for the file.
  problems.settings.drop(section.path_of("file"));
}

/// `gaussian` of a surface.
GaussianHill read_hill(Section section)
{
  GaussianHill hill;
  hill.base = section.number({"base", "height of the lower level"}, Dimension::length);
  hill.rise = section.number({"height", "of the hill above it"}, Dimension::length);
  hill.centre = section.number({"centre", "x of its top"}, Dimension::length);
  hill.width = section.number({"width", "of the hill, where 37 % of its height are left"}, Dimension::length,
                              Interval::positive());
  hill.side = static_cast<GaussianHill::Side>(section.choice_or(
      0, {"side", "right or left: the hill falls on this side only, and keeps its full height on the other"},
      {"both", "right", "left"}));
  return hill;
}

constexpr std::string_view one_of_four = "none, but one of points, offset, file and gaussian is required";

/// One of `surfaces`; what it is measured from is answered, and resolved when all are known.
Offset read_surface(Section section, Surface& surface, const std::filesystem::path& folder,
                    const std::vector<std::string>& names, Problems& problems)
{
  // The four kinds of surface. All are asked for before any is looked at, so that a second one is no unknown
  // key.
  const YamlNode* points = section.find(
      {"points", "straight between the points, level beyond", "[[x, y], ...], lengths", one_of_four});
  const YamlNode* offset =
      section.find({"offset", "another surface, moved up", "name of a surface", one_of_four});
  const YamlNode* file =
      section.find({"file", "text file of x and y, in m or in the units of its heading: x (ft), y (ft)",
                    "path, relative to the case file", one_of_four});
  const YamlNode* hill = section.find(
      {"gaussian", "base + height exp(-((x - centre) / width)^2)", "map of the keys below", one_of_four});
  if (!section.given()) return {};
  if (!!points + !!offset + !!file + !!hill != 1)
  {
    section.error("", "must have exactly one of points, offset, file or gaussian");
    section.find("up");
    return {};
  }
  if (points) surface.shape = read_points(*points, problems);
  if (file)
  {
    Polyline line = read_ground_file(*file, folder, problems);
    if (const std::string problem = rising_problem(line); !problem.empty())
      problems.add(file->location, file->path,
                   (folder / file->text).lexically_normal().string() + ": " + problem);
    resolve_points(section, line, problems);
    surface.shape = std::move(line);
  }
  if (hill) surface.shape = read_hill(Section(hill, problems));
  if (!offset) return {};
  return {read_choice(*offset, names, problems),
          section.number({"up", "with offset: how far above the other surface"}, Dimension::length)};
}

/// Gives offset surfaces the shape at the end of their chain.
void resolve_offsets(std::vector<Surface>& surfaces, const std::vector<Offset>& offsets, const YamlNode& node,
                     Problems& problems)
{
  // A surface may be measured from one that is itself an offset, in any order of the file.
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    std::string chain = surfaces[i].name;
    int at = static_cast<int>(i);
    std::size_t steps = 0;
    double up = 0;
    // More steps than surfaces: the chain has come back to where it was.
    for (; offsets[at].base >= 0 && steps <= surfaces.size(); ++steps)
    {
      up += offsets[at].up;
      at = offsets[at].base;
      chain += " -> " + surfaces[at].name;
      if (at == static_cast<int>(i)) steps = surfaces.size();
    }
    if (steps <= surfaces.size())
    {
      surfaces[i].shape = surfaces[at].shape;
      surfaces[i].up = up;
    }
    else if (at == static_cast<int>(i)) // those that only lead into the circle are not at fault
    {
      const YamlNode& own = *node.child(surfaces[i].name)->child("offset");
      problems.add(own.location, own.path, "offsets go round in a circle: " + chain);
    }
  }
}

std::vector<std::string> surface_names(const std::vector<Surface>& surfaces)
{
  std::vector<std::string> names;
  for (const Surface& s : surfaces) names.push_back(s.name);
  return names;
}

/// One of `regions`.
Region read_region(const YamlNode& node, const std::vector<std::string>& surfaces,
                   const std::vector<std::string>& materials, Problems& problems)
{
  Region region;
  // Regions have no names; messages of later stages tell them by their line.
  region.location = node.location.text() + ": " + node.path;
  Section section(&node, problems);
  if (const YamlNode* name = section.require({"material", "one of the materials", "name"}))
    region.material = read_choice(*name, materials, problems);
  if (const YamlNode* name = section.find(
          {"above", "the surface that bounds the region below", "name of a surface", "the base"}))
    region.above = read_choice(*name, surfaces, problems);
  if (const YamlNode* name =
          section.find({"below", "the surface that bounds the region above", "name of a surface"}))
    region.below = read_choice(*name, surfaces, problems);
  else
    section.error("below", "is missing; the domain is open above, name the surface that bounds the region");
  if (const YamlNode* x = section.find({"x", "the sides of the region, to the nearest column of particles",
                                        "[left, right], lengths", "the sides of the domain"}))
  {
    const Point sides = read_point(*x, problems);
    if (sides.x >= sides.y) section.error("x", "the right end must lie right of the left one");
    region.left = sides.x;
    region.right = sides.y;
  }
  return region;
}
} // namespace

std::vector<Surface> read_surfaces(Section& root, const std::filesystem::path& folder, Problems& problems)
{
  std::vector<Surface> surfaces;
  const YamlNode* node =
      root.require({"surfaces", "lines y(x) that bound the ground", "map of names to the keys below"});
  if (!node) return surfaces;
  if (node->kind != YamlNode::Kind::map)
    return problems.add(node->location, node->path,
                        "must be a map of names, as {ground: {points: [[0 m, 25 m]]}}"),
           surfaces;
  // Names first: a surface may be measured from one that comes later.
  for (const YamlNode& child : node->children) surfaces.push_back({child.key, Polyline{{0}, {0}}, 0});
  const std::vector<std::string> names = surface_names(surfaces);
  std::vector<Offset> offsets;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    offsets.push_back(
        read_surface(Section(&node->children[i], problems), surfaces[i], folder, names, problems));
  resolve_offsets(surfaces, offsets, *node, problems);
  return surfaces;
}

std::vector<Region> read_regions(Section& root, const std::vector<Surface>& surfaces,
                                 const std::vector<Material>& materials, Problems& problems)
{
  std::vector<std::string> known;
  for (const Material& m : materials) known.push_back(m.name);
  std::vector<Region> regions;
  const YamlNode* node =
      root.require({"regions", "the ground between surfaces; the first that holds a point has it",
                    "list of maps of the keys below"});
  if (!node) return regions;
  const auto elements = read_list(*node, "of regions, as [{material: rock, below: ground}]", problems);
  if (node->kind == YamlNode::Kind::list && elements.empty())
    problems.add(node->location, node->path, "is empty; there must be some ground");
  for (const YamlNode* element : elements)
    regions.push_back(read_region(*element, surface_names(surfaces), known, problems));
  return regions;
}
} // namespace mpm
