#pragma once
// What a case says when every default is written out: key paths with their values in SI units.

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mpm
{
/// Key paths ("grid.spacing", "domain.x[0]") and the text of their values ("0.25 m"), which reads back to the
/// same value; in the order in which they were set first.
class Settings
{
public:
  using Entries = std::vector<std::pair<std::string, std::string>>;

  /// The value that a key has after all, given or default; the last one counts.
  void set(const std::string& path, const std::string& value);
  /// Takes a key out for good: others stand for it.
  void drop(const std::string& path);
  /// Whether a key was set or dropped.
  bool knows(const std::string& path) const { return indices_.contains(path); }
  /// All but those that were dropped.
  Entries entries() const;

private:
  Entries all_; ///< empty values: dropped
  std::map<std::string, std::size_t, std::less<>> indices_;
};

/// The value of an empty list.
inline constexpr std::string_view empty_list = "[]";

/// A key as part of a path: in quotation marks when it holds what parts a path.
std::string path_part(const std::string& key);

/// The settings as YAML that `load_case` reads back to the same settings.
std::string to_yaml(const Settings::Entries& settings);
} // namespace mpm
