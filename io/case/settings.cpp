// Settings are kept flat, by key path, since comparing two runs wants a list; the tree comes back only to be
// printed as YAML. A value is text in SI that reads back to the same number, so that two cases are one if the
// texts are.

#include "io/case/settings.hpp"

#include "io/case/yaml_tree.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>

namespace mpm
{
namespace
{
using Kind = YamlNode::Kind;

/// A part of a key path.
struct Step
{
  std::string name;      ///< of a map's child, or the number of a list's
  bool is_index = false; ///< of a list
};

/// "a.b[0]" as a, b and 0; names in quotation marks are whole.
std::vector<Step> steps_of(std::string_view path)
{
  std::vector<Step> steps(1);
  bool quoted = false;
  for (const char c : path)
    if (c == '"')
      quoted = !quoted;
    else if (c == '.' && !quoted)
      steps.emplace_back();
    else if (c == '[' && !quoted)
      steps.push_back({"", true});
    else if (c != ']' || quoted)
      steps.back().name += c;
  return steps;
}

/// The child of that name or number, made at the end if there is none.
YamlNode& below(YamlNode& node, const Step& step)
{
  node.kind = step.is_index ? Kind::list : Kind::map;
  // Elements of lists, and the keys below them, come in their order: lists may be long.
  const bool is_next = step.is_index && step.name == std::to_string(node.children.size());
  if (!node.children.empty() && node.children.back().key == step.name) return node.children.back();
  for (YamlNode& child : node.children)
    if (!is_next && child.key == step.name) return child;
  YamlNode& made = node.children.emplace_back();
  made.key = step.name;
  return made;
}

/// Maps in block style, lists of plain values in one line.
void emit(YAML::Emitter& out, const YamlNode& node)
{
  // An empty list has no element that a path could name; it is kept as a value of its own.
  if (node.kind == Kind::scalar && node.text == empty_list)
  {
    out << YAML::Flow << YAML::BeginSeq << YAML::EndSeq;
    return;
  }
  if (node.kind == Kind::scalar)
  {
    out << node.text;
    return;
  }
  const auto is_map = [](const YamlNode& child) { return child.kind == Kind::map; };
  if (node.kind == Kind::list)
  {
    const bool short_items = std::none_of(node.children.begin(), node.children.end(), is_map);
    if (short_items) out << YAML::Flow;
    out << YAML::BeginSeq;
    for (const YamlNode& child : node.children) emit(out, child);
    out << YAML::EndSeq;
    return;
  }
  out << YAML::BeginMap;
  for (const YamlNode& child : node.children)
  {
    out << YAML::Key << child.key << YAML::Value;
    emit(out, child);
  }
  out << YAML::EndMap;
}
} // namespace

void Settings::set(const std::string& path, const std::string& value)
{
  const auto [entry, is_new] = indices_.try_emplace(path, all_.size());
  if (is_new)
    all_.emplace_back(path, value);
  else
    all_[entry->second].second = value;
}

// An empty value keeps the key known, so that the tree's own text does not come in for it.
void Settings::drop(const std::string& path)
{
  set(path, "");
}

Settings::Entries Settings::entries() const
{
  Entries kept;
  std::copy_if(all_.begin(), all_.end(), std::back_inserter(kept),
               [](const auto& entry) { return !entry.second.empty(); });
  return kept;
}

std::string path_part(const std::string& key)
{
  return key.find_first_of(".[]") == std::string::npos ? key : '"' + key + '"';
}

std::string to_yaml(const Settings::Entries& settings)
{
  YamlNode root;
  root.kind = Kind::map;
  for (const auto& [path, value] : settings)
  {
    YamlNode* node = &root;
    for (const Step& step : steps_of(path)) node = &below(*node, step);
    node->kind = Kind::scalar;
    node->text = value;
  }
  YAML::Emitter out;
  emit(out, root);
  return std::string(out.c_str()) + "\n";
}
} // namespace mpm
