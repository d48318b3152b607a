#include "io/case/yaml_checker.hpp"

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
  problems.add(node.location, node.path, std::string(kind_of(node)) + "; give " + std::string(wanted));
  return false;
}
} // namespace

bool Range::holds(double value) const
{
  return (lower_allowed ? value >= lower : value > lower) && (upper_allowed ? value <= upper : value < upper);
}

std::string Range::text(Dimension dimension) const
{
  std::string text;
  if (std::isfinite(lower)) text = (lower_allowed ? "at least " : "above ") + quantity_text(lower, dimension);
  if (std::isfinite(upper))
    text += (text.empty() ? "" : " and ") + std::string(upper_allowed ? "at most " : "below ") +
            quantity_text(upper, dimension);
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
    problems.add(node.location, node.path, number.problem);
    return NAN;
  }
  problems.settings.set(node.path, quantity_text(number.value, dimension));
  if (range.holds(number.value)) return number.value;
  problems.add(node.location, node.path, "is " + node.text + "; must be " + range.text(dimension));
  return NAN;
}

int read_integer(const YamlNode& node, int least, int most, Problems& problems)
{
  if (!is_scalar(node, "a whole number", problems)) return least;
  int value = 0;
  const char* end = node.text.data() + node.text.size();
  const auto result = std::from_chars(node.text.data(), end, value);
  problems.settings.set(node.path, std::to_string(value));
  if (result.ec == std::errc{} && result.ptr == end && value >= least && value <= most) return value;
  problems.add(node.location, node.path,
               "is '" + node.text + "'; must be a whole number from " + std::to_string(least) + " to " +
                   std::to_string(most));
  return least;
}

std::string read_text(const YamlNode& node, Problems& problems)
{
  if (!is_scalar(node, "a text", problems)) return {};
  if (node.text.empty()) problems.add(node.location, node.path, "is empty; give a text");
  problems.settings.set(node.path, node.text);
  return node.text;
}

int read_choice(const YamlNode& node, const std::vector<std::string>& names, Problems& problems)
{
  if (!is_scalar(node, either(names), problems)) return -1;
  problems.settings.set(node.path, node.text);
  const auto found = std::find(names.begin(), names.end(), node.text);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  problems.add(node.location, node.path,
               "is '" + node.text + "'; must be " +
                   (names.empty() ? "a name given above, and there is none" : either(names)) +
                   suggestion(node.text, names));
  return -1;
}

std::vector<const YamlNode*> read_list(const YamlNode& node, std::string_view what, Problems& problems)
{
  std::vector<const YamlNode*> elements;
  if (node.kind != YamlNode::Kind::list)
    problems.add(node.location, node.path, std::string(kind_of(node)) + "; give a list " + std::string(what));
  else
    for (const YamlNode& child : node.children) elements.push_back(&child);
  if (node.kind == YamlNode::Kind::list && elements.empty())
    problems.settings.set(node.path, std::string(empty_list));
  return elements;
}

Point read_point(const YamlNode& node, Problems& problems)
{
  const auto pair = read_list(node, "[x, y], as [50 m, 25 m]", problems);
  if (pair.size() == 2)
    return {read_number(*pair[0], Dimension::length, {}, problems),
            read_number(*pair[1], Dimension::length, {}, problems)};
  if (node.kind == YamlNode::Kind::list)
    problems.add(node.location, node.path,
                 "has " + std::to_string(pair.size()) + " elements; must be two, x and y, as [50 m, 25 m]");
  return {NAN, NAN};
}

Section::Section(const YamlNode* node, Problems& problems, std::string path)
    : node_(node), problems_(problems), path_(node ? node->path : std::move(path)),
      named_(node || !path_.empty())
{
  if (!node || node->kind == YamlNode::Kind::map) return;
  problems.add(node->location, node->path, std::string(kind_of(*node)) + "; give a map of keys and values");
  node_ = nullptr;
}

Section::~Section()
{
  if (!node_) return;
  for (const YamlNode& child : node_->children)
    if (std::find(known_.begin(), known_.end(), child.key) == known_.end())
      problems_.add(child.key_location, child.path,
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
  const Location& own = node_->key_location.source.empty() ? node_->location : node_->key_location;
  problems_.add(child ? child->location : own, prefix + std::string(key), what);
}

std::string Section::path_of(std::string_view key) const
{
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

void Section::resolve(std::string_view key, const std::string& value) const
{
  if (named_) problems_.settings.set(path_of(key), value);
}

double Section::number(std::string_view key, Dimension dimension, const Range& range)
{
  const YamlNode* child = require(key);
  return child ? read_number(*child, dimension, range, problems_) : NAN;
}

double Section::number_or(double fallback, std::string_view key, Dimension dimension, const Range& range)
{
  const YamlNode* child = find(key);
  if (child) return read_number(*child, dimension, range, problems_);
  if (std::isfinite(fallback))
    resolve(key, quantity_text(fallback, dimension)); // else there is no text for it
  return fallback;
}

int Section::integer_or(int fallback, std::string_view key, int least, int most)
{
  const YamlNode* child = find(key);
  if (child) return read_integer(*child, least, most, problems_);
  resolve(key, std::to_string(fallback));
  return fallback;
}

std::string Section::text(std::string_view key)
{
  const YamlNode* child = require(key);
  return child ? read_text(*child, problems_) : "";
}

std::string Section::text_or(std::string fallback, std::string_view key)
{
  const YamlNode* child = find(key);
  if (child) return read_text(*child, problems_);
  resolve(key, fallback);
  return fallback;
}

int Section::choice(std::string_view key, const std::vector<std::string>& names)
{
  const YamlNode* child = require(key);
  return child ? std::max(0, read_choice(*child, names, problems_)) : 0;
}

int Section::choice_or(int fallback, std::string_view key, const std::vector<std::string>& names)
{
  const YamlNode* child = find(key);
  if (child) return std::max(0, read_choice(*child, names, problems_));
  resolve(key, names.at(fallback));
  return fallback;
}

Section Section::section(std::string_view key)
{
  return Section(require(key), problems_, path_of(key));
}

Section Section::optional_section(std::string_view key)
{
  return Section(find(key), problems_, path_of(key));
}
} // namespace mpm
