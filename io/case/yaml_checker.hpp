#pragma once
// Strict reading of a YAML tree: whatever is not asked for is an unknown key, whatever is wrong is noted in
// `Problems` and answered with NaN, an empty text or a first choice, so that reading goes on.

#include "io/case/key.hpp"
#include "io/case/units.hpp"
#include "io/case/yaml_tree.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace mpm
{
/// "above 0 m and at most 2 m"
std::string interval_text(const Interval& interval, Dimension dimension);

// Each notes what is wrong at the node's location, and answers something with which reading can go on.

/// A number with a unit of the dimension, in SI; NaN where wrong or not of the interval.
double read_number(const YamlNode& node, Dimension dimension, const Interval& interval, Problems& problems);
/// A whole number from `least` to `most`; `least` where wrong.
int read_integer(const YamlNode& node, int least, int most, Problems& problems);
/// A text that is not empty.
std::string read_text(const YamlNode& node, Problems& problems);
/// Index of the value among `names`, -1 if it is none of them.
int read_choice(const YamlNode& node, const std::vector<std::string>& names, Problems& problems);
/// The elements of a list; `what` completes "is not a list: give ...".
std::vector<const YamlNode*> read_list(const YamlNode& node, std::string_view what, Problems& problems);
/// [x, y] in m; NaN where wrong.
struct Point
{
  double x, y;
};
Point read_point(const YamlNode& node, Problems& problems);

/// A map being read. Every key asked for is a known one; the others are reported when the section ends.
/// Of an absent section everything is absent and nothing is missing.
class Section
{
public:
  /// `path` tells where an absent section would stand: its defaults are settings too.
  Section(const YamlNode* node, Problems& problems, const std::string& path = {});
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;
  ~Section();

  bool given() const { return node_ != nullptr; }
  const YamlNode* find(const Key& key);    ///< null: absent
  const YamlNode* require(const Key& key); ///< null: absent, and said so
  void error(std::string_view key, const std::string& what) const;
  /// Notes the value that a key has after all, where it is not one of those that are read below.
  void resolve(std::string_view key, const std::string& value) const;
  /// Takes every key that is given for a known one.
  void accept_all();

  double number(const Key& key, Dimension dimension, const Interval& interval = {});
  double number_or(double fallback, const Key& key, Dimension dimension, const Interval& interval = {});
  int integer_or(int fallback, const Key& key, int least, int most);
  std::string text(const Key& key);
  std::string text_or(std::string fallback, const Key& key);
  /// Index among `names`; 0 if wrong.
  int choice(const Key& key, const std::vector<std::string>& names);
  int choice_or(int fallback, const Key& key, const std::vector<std::string>& names);
  Section section(std::string_view key); ///< absent: said so
  Section optional_section(std::string_view key);

  std::string path_of(std::string_view key) const;

private:
  const YamlNode* node_;
  Problems& problems_;
  std::string path_;
  bool named_; ///< whether the path is known
  std::vector<std::string> known_;

  const YamlNode* look_up(std::string_view key);
  const YamlNode* look_up_required(std::string_view key); ///< says so if it is absent
  const YamlNode* keep(const YamlNode* child) const;      ///< writes it out as it was typed
  /// For --keys; the key's own words go before these. No `otherwise`: it is required.
  void describe(const Key& key, const std::string& form, const std::string& otherwise = {}) const;
};
} // namespace mpm
