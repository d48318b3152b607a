#include "io/case/sections.hpp"

#include <algorithm>
#include <concepts>

namespace mpm
{
namespace
{
/// A law's parameter without the law's type: a number, or a word out of a few.
struct Target
{
  Key key; ///< below the section at hand
  Dimension dimension;
  Interval range;
  double* value;
  int* choice = nullptr;
  std::vector<std::string> names = {};

  bool required() const { return !choice && key.otherwise.empty(); }
};

template <class L>
/// The parameters of a law as targets, numbers first.
std::vector<Target> targets_of(L& law)
{
  std::vector<Target> targets;
  for (const auto& p : L::parameters())
    targets.push_back({{p.key, p.meaning, "", p.otherwise}, p.dimension, p.range, &(law.*p.value)});
  if constexpr (!L::choices().empty())
    for (const auto& c : L::choices())
      targets.push_back({{c.key, c.meaning},
                         Dimension::none,
                         {},
                         nullptr,
                         &(law.*c.value),
                         {c.names.begin(), c.names.end()}});
  return targets;
}

/// Reads the targets of one map; those with a dot in their key go, group by group, to the maps below it.
void read_targets(Section& section, const std::vector<Target>& targets)
{
  std::vector<std::string_view> groups;
  for (const Target& t : targets)
  {
    const std::string_view name = t.key.name;
    const auto dot = name.find('.');
    // A dot in a parameter's key parts the map that it stands in from its name there.
    if (dot == std::string_view::npos && t.choice)
      *t.choice = section.choice_or(*t.choice, t.key, t.names);
    else if (dot == std::string_view::npos)
      *t.value = t.required() ? section.number(t.key, t.dimension, t.range)
                              : section.number_or(*t.value, t.key, t.dimension, t.range);
    else if (std::find(groups.begin(), groups.end(), name.substr(0, dot)) == groups.end())
      groups.push_back(name.substr(0, dot));
  }
  for (const std::string_view group : groups)
  {
    std::vector<Target> below;
    for (Target t : targets)
      if (t.key.name.size() > group.size() && t.key.name.starts_with(group) &&
          t.key.name[group.size()] == '.')
      {
        t.key.name.remove_prefix(group.size() + 1);
        below.push_back(t);
      }
    const bool required =
        std::any_of(below.begin(), below.end(), [](const Target& t) { return t.required(); });
    Section child = required ? section.section(group) : section.optional_section(group);
    read_targets(child, below);
  }
}

/// Calls f(law) with a new law of each kind.
template <class F>
void for_each_law(const F& f)
{
  [&]<std::size_t... i>(std::index_sequence<i...>)
  {
    (f(std::variant_alternative_t<i, Law>{}), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Law>>{});
}

/// Notes what the law finds wrong as a whole, at the deepest key of its message that the file has.
void note_mismatch(const YamlNode& node, const std::string& message, Problems& problems)
{
  if (message.empty()) return;
  // Laws know no lines: they say "key: what", and the key is looked for in the file.
  const auto colon = message.find(": ");
  const std::string key = message.substr(0, colon);
  const YamlNode* at = &node;
  for (std::size_t from = 0; from < key.size();)
  {
    const auto dot = std::min(key.find('.', from), key.size());
    const YamlNode* child = at->child(std::string_view(key).substr(from, dot - from));
    if (!child) break;
    at = child;
    from = dot + 1;
  }
  problems.add(at->location, node.path + "." + key,
               colon == std::string::npos ? message : message.substr(colon + 2));
}

/// Notes what the law has found for keys that were left out, where it reads back to the same law: a residual
/// strength, and the width of the band that the softening is spread over.
template <class L>
void note_resolved(const std::string& path, L& law, double spacing, Settings& settings)
{
  for (const Target& t : targets_of(law))
    if (!t.choice && !t.key.name.starts_with("softening.") && std::isfinite(*t.value))
      settings.set(path + "." + std::string(t.key.name), quantity_text(*t.value, t.dimension));
  if constexpr (std::derived_from<L, LinearSoftening>)
  {
    if (std::isnan(law.softening_displacement) || !std::isnan(law.band_width)) return;
    const double cells = std::isnan(law.band_cells) ? L::usual_band_cells : law.band_cells;
    settings.drop(path + ".softening.band_cells");
    settings.set(path + ".softening.band_width", quantity_text(cells * spacing, Dimension::length));
  }
}

/// One of `materials`; where the model is not known, nothing else of it is looked at.
Material read_material(const YamlNode& node, double spacing, Problems& problems)
{
  Material material{node.key, {}, {}};
  Section section(&node, problems);
  if (!section.given()) return material;
  const std::vector<std::string> models = model_names();
  const std::string names = either(models);
  const YamlNode* model = section.require({"model", "the constitutive law", names});
  const int kind = model ? read_choice(*model, models, problems) : -1;
  if (kind < 0)
  {
    section.accept_all(); // every key is known while the model is not
    return material;
  }
  int i = 0;
  for_each_law(
      [&](auto law)
      {
        if (i++ != kind) return;
        // Parameters that are wrong by themselves are not looked at together: the second message would
        // mislead.
        const std::size_t before = problems.count();
        read_targets(section, targets_of(law));
        // A law that softens needs the cell size, which may itself be what is wrong.
        if (problems.count() == before && std::isfinite(spacing))
        {
          note_mismatch(node, law.resolve(spacing), problems);
          note_resolved(node.path, law, spacing, problems.settings);
        }
        material.law = law;
      });
  return material;
}
} // namespace

// In the order of the variant, so that the index of a name is that of its law.
std::vector<std::string> model_names()
{
  std::vector<std::string> names;
  for_each_law([&](const auto& law) { names.emplace_back(law.model); });
  return names;
}

std::vector<Material> read_materials(Section& root, double spacing, Problems& problems)
{
  std::vector<Material> materials;
  const YamlNode* node =
      root.require({"materials", "what the ground is made of", "map of names to the keys below"});
  if (!node) return materials;
  if (node->kind != YamlNode::Kind::map || node->children.empty())
    problems.add(node->location, node->path,
                 "holds no material; give a map of names, as 'rock: {model: elastic, ...}'");
  for (const YamlNode& child : node->children)
  {
    // States keep a material in a group of its name, and averaged ones in groups of "NAME ~1" and so on.
    if (child.key.find_first_of("/~") != std::string::npos || child.key == ".")
      problems.add(child.key_location, child.path,
                   "names a part of result files; write a name without / and ~");
    materials.push_back(read_material(child, spacing, problems));
  }
  return materials;
}

std::vector<std::string> frame_fields()
{
  // Of every particle, whatever its law.
  std::vector<std::string> names{"displacement", "velocity", "stress"};
  for_each_law(
      [&](const auto& law)
      {
        for (const StateField& field : law.state_fields())
          if (std::find(names.begin(), names.end(), field.name) == names.end())
            names.emplace_back(field.name);
      });
  return names;
}
} // namespace mpm
