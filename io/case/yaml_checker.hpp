#pragma once
// Strict reading of a YAML tree: whatever is not asked for is an unknown key, whatever is wrong is noted in
// `Problems` and answered with NaN, an empty text or a first choice, so that reading goes on.

#include "io/case/units.hpp"
#include "io/case/yaml_tree.hpp"

#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace mpm
{
/// Interval of possible values, in SI.
struct Range
{
  double lower = -std::numeric_limits<double>::infinity();
  bool lower_allowed = true;
  double upper = std::numeric_limits<double>::infinity();
  bool upper_allowed = true;

  static Range positive() { return {.lower = 0, .lower_allowed = false}; }
  static Range not_negative() { return {.lower = 0}; }
  bool holds(double value) const;
  /// "above 0 m and at most 2 m"
  std::string text(Dimension dimension) const;
};

double read_number(const YamlNode& node, Dimension dimension, const Range& range, Problems& problems);
int read_integer(const YamlNode& node, int least, int most, Problems& problems);
std::string read_text(const YamlNode& node, Problems& problems);
/// Location of the value among `names`, -1 if it is none of them.
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
  Section(const YamlNode* node, Problems& problems, std::string path = {});
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;
  ~Section();

  bool given() const { return node_ != nullptr; }
  const YamlNode* find(std::string_view key);    ///< null: absent
  const YamlNode* require(std::string_view key); ///< null: absent, and said so
  void error(std::string_view key, const std::string& what) const;
  /// Notes the value that a key has after all, where it is not one of those that are read below.
  void resolve(std::string_view key, const std::string& value) const;

  double number(std::string_view key, Dimension dimension, const Range& range = {});
  double number_or(double fallback, std::string_view key, Dimension dimension, const Range& range = {});
  int integer_or(int fallback, std::string_view key, int least, int most);
  std::string text(std::string_view key);
  std::string text_or(std::string fallback, std::string_view key);
  /// Location among `names`; 0 if wrong.
  int choice(std::string_view key, const std::vector<std::string>& names);
  int choice_or(int fallback, std::string_view key, const std::vector<std::string>& names);
  Section section(std::string_view key); ///< absent: said so
  Section optional_section(std::string_view key);

  std::string path_of(std::string_view key) const;

private:
  const YamlNode* node_;
  Problems& problems_;
  std::string path_;
  bool named_; ///< whether the path is known
  std::vector<std::string> known_;
};
} // namespace mpm
