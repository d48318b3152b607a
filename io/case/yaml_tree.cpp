#include "io/case/yaml_tree.hpp"

#include "io/case/yaml_limits.hpp"
#include "io/common/printable.hpp"
#include "io/common/suggestion.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <unordered_set>
#include <utility>

namespace mpm
{
namespace
{
constexpr const char* too_large = "is nested too deeply or is too large";

/// What is wrong with a name; empty: nothing. Names become paths of keys, in which quotation marks hold them
/// together, and they are printed.
std::string name_problem(const std::string& name, bool is_path)
{
  if (name.empty()) return "has a key without a name";
  if (printable(name, "") != name) return "has a key with characters that do not print: '" + name + "'";
  if (!is_path && name.find('"') != name.npos) return "has a key with a quotation mark: '" + name + "'";
  return {};
}

/// Turns yaml-cpp's nodes into ours.
struct Builder
{
  std::string source;
  bool has_lines;
  Problems& problems;
  int nodes = 0;
  bool too_much = false;

  // yaml-cpp counts from 0, editors from 1.
  Location location_of(const YAML::Mark& mark) const
  {
    if (!has_lines || mark.is_null()) return {source, 0, 0};
    return {source, mark.line + 1, mark.column + 1};
  }

  YamlNode build(const YAML::Node& from, const std::string& path, int depth)
  {
    YamlNode node;
    node.path = path;
    node.location = location_of(from.Mark());
    if (depth > deepest_yaml || ++nodes > most_yaml_nodes)
    {
      if (!too_much) problems.add(node.location, path, too_large);
      too_much = true;
      return node;
    }
    if (from.IsScalar())
    {
      node.kind = YamlNode::Kind::scalar;
      node.text = from.Scalar();
      if (printable(node.text) != node.text)
        problems.add(node.location, path, "has characters that do not print: '" + node.text + "'");
    }
    else if (from.IsSequence())
    {
      node.kind = YamlNode::Kind::list;
      for (std::size_t i = 0; i < from.size() && !too_much; ++i)
        node.children.push_back(build(from[i], path + "[" + std::to_string(i) + "]", depth + 1));
    }
    else if (from.IsMap())
    {
      node.kind = YamlNode::Kind::map;
      std::unordered_set<std::string> names; // many keys are looked through once
      for (const auto& member : from)        // yaml-cpp keeps duplicates here
      {
        if (too_much) break;
        add_member(node, member.first, member.second, depth, names);
      }
    }
    return node;
  }

  void add_member(YamlNode& map, const YAML::Node& key, const YAML::Node& value, int depth,
                  std::unordered_set<std::string>& names)
  {
    const Location location = location_of(key.Mark());
    if (!key.IsScalar()) return problems.add(location, map.path, "has a key that is not a plain word");
    const std::string& name = key.Scalar();
    // The keys of a profile are paths, whose dots are no part of a name.
    const bool is_path = map.path.starts_with("profiles.");
    if (const std::string problem = name_problem(name, is_path); !problem.empty())
      return problems.add(location, map.path, problem + "; write another");
    const std::string part = is_path ? name : path_part(name);
    const std::string path = map.path.empty() ? part : map.path + "." + part;
    if (!names.insert(name).second)
    {
      const int first = map.child(name)->key_location.line;
      return problems.add(location, path,
                          "is given twice" +
                              (first ? ", first in line " + std::to_string(first) : std::string()) +
                              "; leave one");
    }
    YamlNode child = build(value, path, depth + 1);
    child.key = name;
    child.key_location = location;
    // An empty value has no location of its own.
    if (child.location.line == 0) child.location = location;
    map.children.push_back(std::move(child));
  }
};

/// "a.b[0].c" and "a.b.0.c" as a, b, 0, c; names in quotation marks are whole.
std::vector<std::string> parts_of(std::string_view path)
{
  std::vector<std::string> parts(1);
  bool quoted = false;
  for (const char c : path)
  {
    if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == '.' || c == '['))
      parts.emplace_back();
    else if (quoted || c != ']')
      parts.back() += c;
  }
  return parts;
}

/// The child of `node` on an override's way, made if it is a missing key; null (and a problem) if impossible.
YamlNode* step_down(YamlNode& node, const std::string& part, const Location& location, Problems& problems)
{
  const std::string here = node.path.empty() ? "the case" : node.path;
  // `seismic:` without anything below it becomes a map when a key is put there.
  if (node.kind == YamlNode::Kind::empty) node.kind = YamlNode::Kind::map;
  if (node.kind == YamlNode::Kind::scalar)
    return problems.add(location, node.path, "is a single value and has no '" + part + "' below it"), nullptr;
  if (node.kind == YamlNode::Kind::list)
  {
    std::size_t index = 0;
    const auto [end, failure] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (failure == std::errc{} && end == part.data() + part.size() && index < node.children.size())
      return &node.children[index];
    problems.add(location, node.path,
                 "is a list of " + std::to_string(node.children.size()) + ", counted from 0; it has no '" +
                     part + "'");
    return nullptr;
  }
  for (YamlNode& child : node.children)
    if (child.key == part) return &child;
  if (const std::string problem = name_problem(part, false); !problem.empty())
    return problems.add(location, node.path, problem + "; write another"), nullptr;
  YamlNode& made = node.children.emplace_back();
  made.key = part;
  made.path = node.path.empty() ? path_part(part) : node.path + "." + path_part(part);
  made.location = made.key_location = location;
  return &made;
}

/// The node at a key path (parts), made where it is missing; null (and a problem) if impossible.
YamlNode* reach(YamlNode& root, const std::vector<std::string>& parts, const Location& location,
                Problems& problems)
{
  YamlNode* node = &root;
  for (const std::string& part : parts)
    if (!(node = step_down(*node, part, location, problems))) return nullptr;
  return node;
}

bool is_key_path(const std::vector<std::string>& parts)
{
  return std::find(parts.begin(), parts.end(), "") == parts.end();
}

/// Puts one `key.path: value` of a profile into the tree.
void apply_setting(YamlNode& root, YamlNode setting, Problems& problems)
{
  const std::vector<std::string> parts = parts_of(setting.key);
  if (!is_key_path(parts))
    return problems.add(setting.key_location, setting.path, "is not of the form key.path: value");
  YamlNode* node = reach(root, parts, setting.key_location, problems);
  if (!node) return;
  setting.key = node->key;
  setting.move_to(node->path);
  *node = std::move(setting);
}

bool is_map(const YamlNode& node, const std::string& wanted, Problems& problems)
{
  if (node.kind == YamlNode::Kind::map) return true;
  problems.add(node.location, node.path, "is not a map; give " + wanted);
  return false;
}

} // namespace

const YamlNode* YamlNode::child(std::string_view wanted) const
{
  if (kind != Kind::map) return nullptr;
  for (const YamlNode& node : children)
    if (node.key == wanted) return &node;
  return nullptr;
}

void YamlNode::move_to(const std::string& new_path)
{
  const std::size_t old_length = path.size();
  path = new_path;
  for (YamlNode& below : children) below.move_to(new_path + below.path.substr(old_length));
}

YamlNode parse_yaml(const std::string& text, const std::string& file, Problems& problems)
{
  YamlNode nothing;
  nothing.location = {file, 1, 1};
  try
  {
    if (const auto end = end_of_what_is_read(text))
      return problems.add({file, end->line + 1, end->column + 1}, "", too_large), nothing;
    // All of them: what follows "---" would otherwise be passed over in silence.
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) problems.add({file, 0, 0}, "", "holds several YAML documents; leave one");
    if (!documents.empty()) return Builder{file, true, problems}.build(documents[0], "", 0);
  }
  catch (const YAML::Exception& error)
  {
    const Location location = error.mark.is_null()
                                  ? Location{file, 0, 0}
                                  : Location{file, error.mark.line + 1, error.mark.column + 1};
    problems.add(location, "", "is not YAML: " + error.msg);
  }
  return nothing;
}

void apply_override(YamlNode& root, const std::string& override_text, Problems& problems)
{
  const Location location{"--set " + override_text, 0, 0};
  const auto equals = override_text.find('=');
  const std::string path = override_text.substr(0, equals);
  const std::vector<std::string> parts = parts_of(path);
  if (equals == std::string::npos || !is_key_path(parts))
    return problems.add(location, "", "is not of the form key.path=value");
  // The value is YAML itself, so that a list or a map can be given: --set "domain.x=[0 m, 90 m]".
  YAML::Node value;
  try
  {
    value = YAML::Load(override_text.substr(equals + 1));
  }
  catch (const YAML::Exception& error)
  {
    return problems.add(location, path, "the value is not YAML: " + error.msg);
  }
  YamlNode* node = reach(root, parts, location, problems);
  if (!node) return;
  const std::string key = node->key;
  *node = Builder{location.source, false, problems}.build(value, node->path, static_cast<int>(parts.size()));
  node->key = key;
  node->key_location = location;
}

bool apply_profile(YamlNode& root, const std::string& wanted, const std::vector<std::string>& others,
                   Problems& problems)
{
  YamlNode profiles;
  profiles.kind = YamlNode::Kind::map;
  const auto found = std::find_if(root.children.begin(), root.children.end(),
                                  [](const YamlNode& child) { return child.key == "profiles"; });
  if (found != root.children.end())
  {
    profiles = std::move(*found);
    root.children.erase(found);
    if (!is_map(profiles, "profiles by name, as {quick: {grid.spacing: 1 m}}", problems)) return false;
  }
  std::vector<std::string> names;
  for (const YamlNode& profile : profiles.children)
  {
    names.push_back(profile.key);
    if (!is_map(profile, "key paths with their values, as {grid.spacing: 1 m}", problems)) continue;
    if (profile.key != wanted) continue;
    for (const YamlNode& setting : profile.children) apply_setting(root, setting, problems);
  }
  const auto holds = [&](const std::vector<std::string>& all)
  { return std::find(all.begin(), all.end(), wanted) != all.end(); };
  if (wanted.empty() || holds(names)) return true;
  if (holds(others)) return false;
  std::string known = names.empty() ? "the case has none of its own" : "the case's profiles are";
  for (const std::string& name : names) known += (name == names.front() ? " " : ", ") + name;
  known += "; every case has";
  for (const std::string& name : others) known += (name == others.front() ? " " : ", ") + name;
  names.insert(names.end(), others.begin(), others.end());
  problems.add({"--profile " + wanted, 0, 0}, "", "no such profile; " + known + suggestion(wanted, names));
  return false;
}

std::vector<std::pair<std::string, std::string>> flattened(const YamlNode& root)
{
  if (root.kind == YamlNode::Kind::scalar) return {{root.path, root.text}};
  std::vector<std::pair<std::string, std::string>> all;
  for (const YamlNode& child : root.children)
    for (auto& setting : flattened(child)) all.push_back(std::move(setting));
  return all;
}

} // namespace mpm
