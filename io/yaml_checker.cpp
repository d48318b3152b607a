#include "io/yaml_checker.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace mpm
{
namespace
{
std::string_view kind_of(const YamlNode& node)
{
  switch (node.kind)
  {
  case YamlNode::Kind::empty:
    return "has no value";
  case YamlNode::Kind::scalar:
    return "is a single value";
  case YamlNode::Kind::list:
    return "is a list";
  case YamlNode::Kind::map:
    return "is a map";
  }
  return "";
}

bool is_scalar(const YamlNode& node, std::string_view wanted, Problems& problems)
{
  if (node.kind == YamlNode::Kind::scalar) return true;
  problems.add(node.place, node.path, std::string(kind_of(node)) + "; give " + std::string(wanted));
  return false;
}

std::string with_unit(double value, Dimension dimension)
{
  const std::string_view unit = si_unit(dimension);
  return number_text(value) + (unit.empty() ? "" : " " + std::string(unit));
}
} // namespace

bool Range::holds(double value) const
{
  return (lower_allowed ? value >= lower : value > lower) && (upper_allowed ? value <= upper : value < upper);
}

std::string Range::text(Dimension dimension) const
{
  std::string text;
  if (std::isfinite(lower)) text = (lower_allowed ? "at least " : "above ") + with_unit(lower, dimension);
  if (std::isfinite(upper))
    text += (text.empty() ? "" : " and ") + std::string(upper_allowed ? "at most " : "below ") +
            with_unit(upper, dimension);
  return text;
}

double read_number(const YamlNode& node, Dimension dimension, const Range& range, Problems& problems)
{
  const std::string wanted = dimension == Dimension::none
                                 ? "a number"
                                 : "a number with a unit of " + std::string(name_of(dimension));
  if (!is_scalar(node, wanted, problems)) return NAN;
  const Quantified number = parse_quantity(node.text, dimension);
  if (!number.problem.empty())
  {
    problems.add(node.place, node.path, number.problem);
    return NAN;
  }
  if (range.holds(number.value)) return number.value;
  problems.add(node.place, node.path, "is " + node.text + "; must be " + range.text(dimension));
  return NAN;
}

int read_integer(const YamlNode& node, int least, int most, Problems& problems)
{
  if (!is_scalar(node, "a whole number", problems)) return least;
  int value = 0;
  const char* end = node.text.data() + node.text.size();
  const auto result = std::from_chars(node.text.data(), end, value);
  if (result.ec == std::errc{} && result.ptr == end && value >= least && value <= most) return value;
  problems.add(node.place, node.path,
               "is '" + node.text + "'; must be a whole number from " + std::to_string(least) + " to " +
                   std::to_string(most));
  return least;
}

std::string read_text(const YamlNode& node, Problems& problems)
{
  if (!is_scalar(node, "a text", problems)) return {};
  if (node.text.empty()) problems.add(node.place, node.path, "is empty; give a text");
  return node.text;
}

int read_choice(const YamlNode& node, const std::vector<std::string>& names, Problems& problems)
{
  if (!is_scalar(node, either(names), problems)) return -1;
  const auto found = std::find(names.begin(), names.end(), node.text);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  problems.add(node.place, node.path,
               "is '" + node.text + "'; must be " +
                   (names.empty() ? "a name given above, and there is none" : either(names)) +
                   suggestion(node.text, names));
  return -1;
}

std::vector<const YamlNode*> read_list(const YamlNode& node, std::string_view what, Problems& problems)
{
  std::vector<const YamlNode*> elements;
  if (node.kind != YamlNode::Kind::list)
    problems.add(node.place, node.path, std::string(kind_of(node)) + "; give a list " + std::string(what));
  else
    for (const YamlNode& child : node.children) elements.push_back(&child);
  return elements;
}

Point read_point(const YamlNode& node, Problems& problems)
{
  const auto pair = read_list(node, "[x, y], as [50 m, 25 m]", problems);
  if (pair.size() == 2)
    return {read_number(*pair[0], Dimension::length, {}, problems),
            read_number(*pair[1], Dimension::length, {}, problems)};
  if (node.kind == YamlNode::Kind::list)
    problems.add(node.place, node.path,
                 "has " + std::to_string(pair.size()) + " elements; must be two, x and y, as [50 m, 25 m]");
  return {NAN, NAN};
}

Section::Section(const YamlNode* node, Problems& problems) : node_(node), problems_(problems)
{
  if (!node || node->kind == YamlNode::Kind::map) return;
  problems.add(node->place, node->path, std::string(kind_of(*node)) + "; give a map of keys and values");
  node_ = nullptr;
}

Section::~Section()
{
  if (!node_) return;
  for (const YamlNode& child : node_->children)
    if (std::find(known_.begin(), known_.end(), child.key) == known_.end())
      problems_.add(child.key_place, child.path,
                    "unknown key '" + child.key + "'; allowed: " + either(known_) +
                        suggestion(child.key, known_));
}

const YamlNode* Section::find(std::string_view key)
{
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return node_ ? node_->child(key) : nullptr;
}

const YamlNode* Section::require(std::string_view key)
{
  const YamlNode* child = find(key);
  if (node_ && !child) error(key, "is missing; it has no default");
  return child;
}

void Section::error(std::string_view key, const std::string& what) const
{
  if (!node_) return;
  const YamlNode* child = node_->child(key);
  const std::string prefix = node_->path.empty() || key.empty() ? node_->path : node_->path + ".";
  const Place& own = node_->key_place.source.empty() ? node_->place : node_->key_place;
  problems_.add(child ? child->place : own, prefix + std::string(key), what);
}

double Section::number(std::string_view key, Dimension dimension, const Range& range)
{
  const YamlNode* child = require(key);
  return child ? read_number(*child, dimension, range, problems_) : NAN;
}

double Section::number_or(double fallback, std::string_view key, Dimension dimension, const Range& range)
{
  const YamlNode* child = find(key);
  return child ? read_number(*child, dimension, range, problems_) : fallback;
}

int Section::integer_or(int fallback, std::string_view key, int least, int most)
{
  const YamlNode* child = find(key);
  return child ? read_integer(*child, least, most, problems_) : fallback;
}

std::string Section::text(std::string_view key)
{
  const YamlNode* child = require(key);
  return child ? read_text(*child, problems_) : "";
}

std::string Section::text_or(std::string fallback, std::string_view key)
{
  const YamlNode* child = find(key);
  return child ? read_text(*child, problems_) : fallback;
}

int Section::choice(std::string_view key, const std::vector<std::string>& names)
{
  const YamlNode* child = require(key);
  return child ? std::max(0, read_choice(*child, names, problems_)) : 0;
}

int Section::choice_or(int fallback, std::string_view key, const std::vector<std::string>& names)
{
  const YamlNode* child = find(key);
  return child ? std::max(0, read_choice(*child, names, problems_)) : fallback;
}

Section Section::section(std::string_view key)
{
  return Section(require(key), problems_);
}

Section Section::optional_section(std::string_view key)
{
  return Section(find(key), problems_);
}
} // namespace mpm
