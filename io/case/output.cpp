#include "io/case/sections.hpp"

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

FrameSettings read_frames(Section section, const std::vector<Material>& materials, Problems& problems)
{
  FrameSettings frames;
  frames.every = section.number_or(frames.every, "every", Dimension::time, Range::positive());
  const YamlNode* fields = section.find("fields");
  if (!fields)
  {
    frames.fields = fields_of(materials);
    return frames;
  }
  for (const YamlNode* field : read_list(*fields, "as [displacement, velocity]", problems))
  {
    const int known = read_choice(*field, frame_fields(), problems);
    if (known < 0) continue;
    if (std::find(frames.fields.begin(), frames.fields.end(), field->text) != frames.fields.end())
      problems.add(field->location, field->path, "'" + field->text + "' is given twice; leave one");
    frames.fields.push_back(field->text);
  }
  return frames;
}

GaugeSettings read_gauges(Section section, Problems& problems)
{
  GaugeSettings gauges;
  gauges.every = section.number_or(gauges.every, "every", Dimension::time, Range::positive());
  const YamlNode* points = section.find("points");
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

CheckpointSettings read_checkpoint(Section section)
{
  CheckpointSettings checkpoint;
  checkpoint.every = section.number_or(checkpoint.every, "every", Dimension::time, Range::positive());
  checkpoint.keep = section.integer_or(checkpoint.keep, "keep", 1, 1000);
  return checkpoint;
}
} // namespace

OutputSettings read_output(Section& root, const std::vector<Material>& materials, Problems& problems)
{
  Section output = root.optional_section("output");
  OutputSettings settings;
  settings.frames = read_frames(output.optional_section("frames"), materials, problems);
  settings.gauges = read_gauges(output.optional_section("gauges"), problems);
  settings.checkpoint = read_checkpoint(output.optional_section("checkpoint"));
  return settings;
}
} // namespace mpm
