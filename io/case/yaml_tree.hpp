#pragma once
// A YAML file as a plain tree that knows where each key and value stands, with the command line's overrides
// put in.

#include "io/case/problems.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mpm
{
/// A value with its location. A map's children carry their keys, a list's do not.
struct YamlNode
{
  enum class Kind
  {
    empty,
    scalar,
    list,
    map,
  };
  Kind kind = Kind::empty;
  std::string key;                 ///< of a map's child
  std::string path;                ///< "materials.soil.density", "domain.x[0]"
  std::string text;                ///< of a scalar
  Location location, key_location; ///< of the value and of its key
  std::vector<YamlNode> children;  ///< of a list or map, in the file's order

  /// Of a map, by its key; null: there is none, or this is no map.
  const YamlNode* child(std::string_view key) const;
  /// The node at another key path, and all below it with it.
  void move_to(const std::string& new_path);
};

/// Reads YAML text; duplicate keys and broken syntax go to `problems`. `file` serves the messages.
YamlNode parse_yaml(const std::string& text, const std::string& file, Problems& problems);

/// Puts `key.path=value` into the tree: keys are made as needed, elements of lists ("domain.x[0]" or
/// "domain.x.0") must exist. The value is YAML itself.
void apply_override(YamlNode& root, const std::string& override_text, Problems& problems);

/// Takes `profiles` (`{NAME: {key.path: value, ...}}`) out of the tree and puts the values of the one called
/// `wanted` into it as `apply_override` would; they keep their locations in the file. Empty: none is wanted.
/// The form of all of them is checked. Returns whether the case has a profile of that name, or none is
/// wanted; a name that is not in `others` either is a problem.
bool apply_profile(YamlNode& root, const std::string& wanted, const std::vector<std::string>& others,
                   Problems& problems);

/// Every scalar of the tree: key path and text, in order.
std::vector<std::pair<std::string, std::string>> flattened(const YamlNode& root);
} // namespace mpm
