#pragma once
// A YAML file as a plain tree that knows where each key and value stands, with the command line's overrides
// put in.

#include "io/case/settings.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mpm
{
/// Where a key or value stands.
struct Location
{
  std::string source; ///< the file, or "--set key.path=value"
  int line = 0;       ///< from 1; 0: the source has no lines
  int column = 0;

  std::string text() const; ///< FILE:LINE:COLUMN
};

/// What comes of reading an input: all that is wrong with it, collected so that its user sees everything at
/// once, and all that it says, defaults written out.
class Problems
{
public:
  Settings settings;

  /// `path` is the key path; empty for the file as a whole.
  void add(const Location& location, const std::string& path, const std::string& what);
  /// A file named by the input that cannot be read.
  void add_missing(const Location& location, const std::string& path, const std::string& what);
  std::size_t count() const { return entries_.size(); }
  /// Throws `Error` with all messages in the file's order, if there are any: input_missing when nothing is
  /// wrong but missing files, else bad_input.
  void throw_if_any() const;

private:
  struct Entry
  {
    Location location;
    std::string message;
  };
  std::vector<Entry> entries_;
  bool only_missing_ = true;
};

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
  std::string key;
  std::string path; ///< "materials.soil.density", "domain.x[0]"
  std::string text; ///< of a scalar
  Location location, key_location;
  std::vector<YamlNode> children;

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
/// `wanted` into it as `apply_override` would; they keep their locations in the file. Empty: none is wanted. The
/// form of all of them is checked, and an unknown name is a problem.
void apply_profile(YamlNode& root, const std::string& wanted, Problems& problems);

/// Every scalar of the tree: key path and text, in order.
std::vector<std::pair<std::string, std::string>> flattened(const YamlNode& root);

/// The name most like `wrong`, empty if none is.
std::string nearest(std::string_view wrong, const std::vector<std::string>& names);
/// "; did you mean 'x'?" or nothing.
std::string suggestion(std::string_view wrong, const std::vector<std::string>& names);
} // namespace mpm
