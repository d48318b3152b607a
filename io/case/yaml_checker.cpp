// Every reader answers something, NaN or a first choice, after it has noted what is wrong: one mistake shall
// not hide those after it. What was read is noted in the settings in the same moment, in SI.

#include "io/case/yaml_checker.hpp"

#include "io/case/renamed_keys.hpp"
#include "io/common/suggestion.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace mpm
{
namespace
{
/// For messages, after the key.
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

/// "length, above 0 m", "number"
std::string form_of(Dimension dimension, const Interval& interval)
{
  const std::string type(dimension == Dimension::none ? "number" : name_of(dimension));
  const std::string bounds = interval_text(interval, dimension);
  if (!bounds.empty()) return type + ", " + bounds;
  return dimension == Dimension::none ? type : type + " in " + std::string(usual_unit(dimension));
}

/// A path without the indices of its lists' elements: regions[0].x as regions[N].x.
std::string without_indices(std::string path)
{
  for (auto open = path.find('['); open != std::string::npos; open = path.find('[', open + 1))
    path.replace(open + 1, path.find(']', open) - open - 1, "N");
  return path;
}

bool is_scalar(const YamlNode& node, std::string_view wanted, Problems& problems)
{
  if (node.kind == YamlNode::Kind::scalar) return true;
  problems.add(node.location, node.path, std::string(kind_of(node)) + "; give " + std::string(wanted));
  return false;
}
} // namespace

// In the unit that people write: 90 deg, not 1.5708 rad.
std::string interval_text(const Interval& interval, Dimension dimension)
{
  std::string text;
  if (std::isfinite(interval.lower))
    text = (interval.lower_allowed ? "at least " : "above ") + usual_quantity_text(interval.lower, dimension);
  if (std::isfinite(interval.upper))
    text += (text.empty() ? "" : " and ") + std::string(interval.upper_allowed ? "at most " : "below ") +
            usual_quantity_text(interval.upper, dimension);
  return text;
}

double read_number(const YamlNode& node, Dimension dimension, const Interval& interval, Problems& problems)
{
  // What to give is told also where the value is a list or a map.
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
  // Also where it is out of range: then nobody compares settings.
  problems.settings.set(node.path, quantity_text(number.value, dimension));
  if (interval.holds(number.value)) return number.value;
  const std::string reason = interval.reason.empty() ? "" : ", " + std::string(interval.reason);
  problems.add(node.location, node.path,
               "is " + node.text + "; must be " + interval_text(interval, dimension) + reason);
  return NAN;
}

int read_integer(const YamlNode& node, int least, int most, Problems& problems)
{
  if (!is_scalar(node, "a whole number", problems)) return least;
  int value = 0;
  const char* end = node.text.data() + node.text.size();
  // "3.0" and "3 " are no whole numbers: what is not understood in full is not understood.
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

Section::Section(const YamlNode* node, Problems& problems, const std::string& path)
    : node_(node), problems_(problems), path_(node ? node->path : path), named_(node || !path_.empty())
{
  if (!node || node->kind == YamlNode::Kind::map) return;
  problems.add(node->location, node->path, std::string(kind_of(*node)) + "; give a map of keys and values");
  node_ = nullptr;
}

Section::~Section()
{
  if (!node_) return;
  // What nobody has asked for by now is unknown, or had this name once.
  for (const YamlNode& child : node_->children)
    if (std::find(known_.begin(), known_.end(), child.key) == known_.end())
    {
      const std::string_view now = name_now(child.path);
      problems_.add(child.key_location, child.path,
                    now.empty() ? "unknown key '" + child.key + "'; allowed: " + either(known_) +
                                      suggestion(child.key, known_)
                                : "is now called " + std::string(now));
    }
}

// Asking for a key makes it known, whether it is there or not.
const YamlNode* Section::look_up(std::string_view key)
{
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return node_ ? node_->child(key) : nullptr;
}

// A section without a path is one of another kind of file, which --keys does not list.
void Section::describe(const Key& key, const std::string& form, const std::string& otherwise) const
{
  if (!problems_.keys || !named_) return;
  problems_.keys->push_back(
      {without_indices(path_of(key.name)), key.form.empty() ? form : std::string(key.form),
       key.otherwise.empty() ? otherwise : std::string(key.otherwise), std::string(key.meaning)});
}

// Who asks for a node reads it in a way of its own: it is written out as it was typed, in the place where its
// default would be.
const YamlNode* Section::keep(const YamlNode* child) const
{
  if (child && child->kind == YamlNode::Kind::scalar) resolve(child->key, child->text);
  return child;
}

const YamlNode* Section::find(const Key& key)
{
  describe(key, "");
  return keep(look_up(key.name));
}

const YamlNode* Section::require(const Key& key)
{
  describe(key, "");
  return keep(look_up_required(key.name));
}

const YamlNode* Section::look_up_required(std::string_view key)
{
  const YamlNode* child = look_up(key);
  if (node_ && !child) error(key, "is missing; it has no default");
  return child;
}

void Section::accept_all()
{
  if (!node_) return;
  for (const YamlNode& child : node_->children) look_up(child.key);
}

void Section::error(std::string_view key, const std::string& what) const
{
  if (!node_) return;
  const YamlNode* child = node_->child(key);
  const std::string prefix = node_->path.empty() || key.empty() ? node_->path : node_->path + ".";
  // A missing key has no location: that of its section has to do.
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

double Section::number(const Key& key, Dimension dimension, const Interval& interval)
{
  describe(key, form_of(dimension, interval));
  const YamlNode* child = look_up_required(key.name);
  return child ? read_number(*child, dimension, interval, problems_) : NAN;
}

double Section::number_or(double fallback, const Key& key, Dimension dimension, const Interval& interval)
{
  describe(key, form_of(dimension, interval), usual_quantity_text(fallback, dimension));
  const YamlNode* child = look_up(key.name);
  if (child) return read_number(*child, dimension, interval, problems_);
  if (std::isfinite(fallback))
    resolve(key.name, quantity_text(fallback, dimension)); // else there is no text for it
  return fallback;
}

int Section::integer_or(int fallback, const Key& key, int least, int most)
{
  describe(key, "whole number from " + std::to_string(least) + " to " + std::to_string(most),
           std::to_string(fallback));
  const YamlNode* child = look_up(key.name);
  if (child) return read_integer(*child, least, most, problems_);
  resolve(key.name, std::to_string(fallback));
  return fallback;
}

std::string Section::text(const Key& key)
{
  describe(key, "text");
  const YamlNode* child = look_up_required(key.name);
  return child ? read_text(*child, problems_) : "";
}

std::string Section::text_or(std::string fallback, const Key& key)
{
  describe(key, "text", fallback);
  const YamlNode* child = look_up(key.name);
  if (child) return read_text(*child, problems_);
  resolve(key.name, fallback);
  return fallback;
}

int Section::choice(const Key& key, const std::vector<std::string>& names)
{
  describe(key, either(names));
  const YamlNode* child = look_up_required(key.name);
  return child ? std::max(0, read_choice(*child, names, problems_)) : 0;
}

int Section::choice_or(int fallback, const Key& key, const std::vector<std::string>& names)
{
  describe(key, either(names), names.at(fallback));
  const YamlNode* child = look_up(key.name);
  if (child) return std::max(0, read_choice(*child, names, problems_));
  resolve(key.name, names.at(fallback));
  return fallback;
}

// What is below an absent section is asked for all the same: its defaults are settings, and its keys known.
Section Section::section(std::string_view key)
{
  return Section(look_up_required(key), problems_, path_of(key));
}

Section Section::optional_section(std::string_view key)
{
  return Section(look_up(key), problems_, path_of(key));
}
} // namespace mpm
