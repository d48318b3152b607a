// `output`: what is written and how often. Nothing of it changes what is computed but `gauges.every`, which
// the time step divides.

#include "io/case/sections.hpp"
#include "io/common/suggestion.hpp"

#include <algorithm>

namespace mpm
{
namespace
{
/// Displacement, velocity, stress and the history variables of these materials.
std::vector<std::string> fields_of(const std::vector<Material>& materials)
{
  std::vector<std::string> fields{"displacement", "velocity", "stress"};
  for (const Material& material : materials)
    for (const StateField& state : material.state_fields())
      if (std::find(fields.begin(), fields.end(), state.name) == fields.end())
        fields.emplace_back(state.name);
  return fields;
}

/// `output.frames`.
FrameSettings read_frames(Section section, const std::vector<Material>& materials, Problems& problems)
{
  FrameSettings frames;
  frames.every = section.number_or(frames.every, {"every", "time between frames"}, Dimension::time,
                                   Interval::positive());
  const YamlNode* fields =
      section.find({"fields", "what the frames hold of each particle",
                    "list of displacement, velocity, stress and the laws' history variables",
                    "all that the materials have"});
  // By default all that the materials of this case have.
  if (!fields)
  {
    frames.fields = fields_of(materials);
    return frames;
  }
  for (const YamlNode* field : read_list(*fields, "as [displacement, velocity]", problems))
  {
    const int known = read_choice(*field, frame_fields(), problems);
    if (known < 0) continue;
    // HDF5 would refuse the second, in the middle of the run.
    if (std::find(frames.fields.begin(), frames.fields.end(), field->text) != frames.fields.end())
      problems.add(field->location, field->path, "'" + field->text + "' is given twice; leave one");
    frames.fields.push_back(field->text);
  }
  return frames;
}

/// `output.gauges`. That the points lie in the ground is seen to in geometry.cpp.
GaugeSettings read_gauges(Section section, Problems& problems)
{
  GaugeSettings gauges;
  gauges.every = section.number_or(
      gauges.every, {"every", "sampling of gauges and free field, which the time step divides"},
      Dimension::time, Interval::positive());
  const YamlNode* points =
      section.find({"points", "gauges by name, as in the undeformed ground; each follows its material",
                    "map of names to [x, y], lengths", "none"});
  if (!points) return gauges;
  if (points->kind != YamlNode::Kind::map)
    problems.add(points->location, points->path, "must be a map of names, as {crest: [50 m, 35 m]}");
  for (const YamlNode& node : points->children)
  {
    if (node.key.empty()) continue;
    const Point p = read_point(node, problems);
    gauges.points.push_back({node.key, p.x, p.y});
  }
  return gauges;
}

SlideSettings read_slide(Section section)
{
  SlideSettings slide;
  slide.moved = section.number_or(slide.moved,
                                  {"moved", "ground that has moved as far, relative to the base, has slid"},
                                  Dimension::length, Interval::positive());
  slide.area =
      section.number_or(slide.area, {"area", "ground that has to slide for a slide to be self-driven"},
                        Dimension::area, Interval::positive());
  return slide;
}

CheckpointSettings read_checkpoint(Section section, Problems& problems)
{
  CheckpointSettings checkpoint;
  const YamlNode* every = section.find(
      {"every",
       "wall time between checkpoints; auto: 600 s, or 50 times what writing one takes where that is longer, "
       "so that they take no more than 2 % of a long run",
       "auto or a time, above 0 s", "auto"});
  if (!every) section.resolve("every", "auto");
  if (every && every->text != "auto")
  {
    checkpoint.adapts = false;
    if (every->kind == YamlNode::Kind::scalar && parse_quantity(every->text, Dimension::time).problem.empty())
      checkpoint.every = read_number(*every, Dimension::time, Interval::positive(), problems);
    else
      problems.add(every->location, every->path,
                   "must be auto or a time as '10 min'" + suggestion(every->text, {"auto"}));
  }
  checkpoint.keep = section.integer_or(checkpoint.keep, {"keep", "how many checkpoints stay"}, 1, 1000);
  return checkpoint;
}
} // namespace

OutputSettings read_output(Section& root, const std::vector<Material>& materials, Problems& problems)
{
  Section output = root.optional_section("output");
  OutputSettings settings;
  settings.frames = read_frames(output.optional_section("frames"), materials, problems);
  settings.gauges = read_gauges(output.optional_section("gauges"), problems);
  settings.slide = read_slide(output.optional_section("slide"));
  settings.checkpoint = read_checkpoint(output.optional_section("checkpoint"), problems);
  return settings;
}
} // namespace mpm
