// What holds of any case: in which unit a number is given, in which order the keys, in which style the text
// is no matter. Drawn at random with a fixed seed, the same on every machine.

#include "boundaries/ground_motion/ground_motion.hpp"
#include "io/case/units.hpp"
#include "io/case/yaml_tree.hpp"
#include "solver/stages/identity.hpp"
#include "test/io/case_texts.hpp"
#include "test/io/record_samples.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <random>
#include <set>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// Sections that the small cases leave out, so that quantities of every dimension are there.
const std::string more = R"(seismic:
  duration: 3 s
  rest_below: 1 mm/s
  motion: {recorded_as: outcrop, horizontal: built_in, vertical: {file: r.txt, dt: 0.01 s, unit: g, scale: 0.5}}
output:
  gauges: {every: 0.02 s, points: {'top.1 [a]': [1 m, 9 m], bottom: [3 m, 1 m]}}
  slide: {moved: 0.5 m, area: 7 m2}
  checkpoint: {every: 5 min, keep: 3}
)";

std::vector<std::string> texts()
{
  return {small + more, landslide + more};
}

/// What tells the runs of both stages apart; numbers count to 15 digits there.
std::string identity_of(const std::string& text)
{
  const Case case_file = load(text);
  std::set<std::string> lines;
  for (const auto& settings : {static_settings(case_file), seismic_settings(case_file)})
    for (const auto& [key, value] : settings) lines.insert(key + " = " + value);
  return fmt::format("{}", fmt::join(lines, "\n"));
}

std::size_t below(std::mt19937& random, std::size_t n)
{
  return random() % n;
}

/// A tree as YAML, its maps in any order, with or without brackets, with comments and blanks where they may
/// stand.
class Scribe
{
public:
  explicit Scribe(unsigned seed) : random_(seed) {}

  std::string text_of(YamlNode node, int indent, bool in_brackets)
  {
    if (node.kind == YamlNode::Kind::scalar) return quoted(node.text);
    const bool is_map = node.kind == YamlNode::Kind::map;
    if (is_map)
      for (std::size_t k = node.children.size(); k > 1; --k)
        std::swap(node.children[k - 1], node.children[below(random_, k)]);
    if (in_brackets || node.children.empty() || below(random_, 3) == 0)
    {
      std::string text(1, is_map ? '{' : '[');
      for (std::size_t k = 0; k < node.children.size(); ++k)
        text += (k ? "," + blanks() : blanks()) + (is_map ? quoted(node.children[k].key) + ": " : "") +
                text_of(node.children[k], 0, true) + blanks();
      return text + (is_map ? '}' : ']');
    }
    std::string text;
    const int deeper = indent + 1 + int(below(random_, 4));
    for (const YamlNode& child : node.children)
    {
      if (below(random_, 4) == 0) text += "\n" + std::string(below(random_, 6), ' ') + "# a comment: [\n";
      text += "\n" + std::string(std::size_t(deeper), ' ') + (is_map ? quoted(child.key) + ":" : "-") + " " +
              text_of(child, deeper, false) + (below(random_, 4) ? "" : "  # of it") +
              std::string(below(random_, 3), ' ');
    }
    return text;
  }

private:
  std::string blanks() { return std::string(below(random_, 3), ' '); }
  std::string quoted(const std::string& text)
  {
    const bool plain = text.find_first_of("[]{},:#'\" ") == text.npos;
    const std::size_t style = below(random_, plain ? 3 : 2);
    return style == 0 ? "\"" + text + "\"" : style == 1 ? "'" + text + "'" : text;
  }
  std::mt19937 random_;
};

YamlNode tree_of(const std::string& text)
{
  Problems problems;
  YamlNode tree = parse_yaml(text, "case.yaml", problems);
  problems.throw_if_any();
  return tree;
}

/// Calls change(node) for every single value below.
void for_each_value(YamlNode& node, const std::function<void(YamlNode&)>& change)
{
  if (node.kind == YamlNode::Kind::scalar) change(node);
  for (YamlNode& child : node.children) for_each_value(child, change);
}

std::vector<std::string> units_of_dimension(Dimension dimension)
{
  std::vector<std::string> units;
  std::string names = units_of(dimension) + ",";
  for (std::size_t end = names.find(" or "); end != names.npos; end = names.find(" or "))
    names.replace(end, 4, ", ");
  for (std::size_t at = 0, end; (end = names.find(',', at)) != names.npos; at = end + 2)
    units.push_back(names.substr(at, end - at));
  return units;
}

/// The quantity in another unit of its dimension; empty for what is none.
std::string in_other_unit(const std::string& text, std::mt19937& random)
{
  for (int d = 1; d <= static_cast<int>(Dimension::frequency); ++d)
  {
    const auto dimension = static_cast<Dimension>(d);
    const Quantified value = parse_quantity(text, dimension);
    if (!value.problem.empty()) continue;
    const std::vector<std::string> units = units_of_dimension(dimension);
    const std::string& unit = units[below(random, units.size())];
    return fmt::format("{:.17g} {}", value.value / parse_quantity("1 " + unit, dimension).value, unit);
  }
  return {};
}
} // namespace

TEST_CASE("a case is the same in any unit of its quantities", "[io]")
{
  std::mt19937 random(20240229);
  std::set<std::string> units;
  for (const std::string& text : texts())
  {
    const std::string truth = identity_of(text);
    for (int draw = 0; draw < 40; ++draw)
    {
      YamlNode tree = tree_of(text);
      for_each_value(tree,
                     [&](YamlNode& node)
                     {
                       const std::string other = in_other_unit(node.text, random);
                       if (other.empty()) return;
                       node.text = other;
                       units.insert(other.substr(other.find(' ') + 1));
                     });
      const std::string changed = Scribe(1).text_of(tree, 0, true);
      INFO(changed);
      CHECK(identity_of(changed) == truth);
    }
  }
  CHECK(units.size() >= 20); // nearly all that there are
}

TEST_CASE("a case is the same in any order of keys and any style of YAML", "[io]")
{
  for (const std::string& text : texts())
  {
    const std::string truth = identity_of(text);
    const YamlNode tree = tree_of(text);
    std::set<std::string> different;
    for (unsigned seed = 0; seed < 100; ++seed)
    {
      std::string changed = Scribe(seed).text_of(tree, -1, false) + "\n";
      if (seed % 3 == 1)
        for (std::size_t at = 0; (at = changed.find('\n', at)) != changed.npos; at += 2)
          changed.replace(at, 1, "\r\n");
      INFO(changed);
      CHECK(identity_of(changed) == truth);
      different.insert(changed);
    }
    CHECK(different.size() == 100);
  }
}

TEST_CASE("twice the record is twice the motion to the last bit, whatever is done to it", "[io]")
{
  for (const Sample& sample : samples())
    for (const Baseline baseline : {Baseline::none, Baseline::linear, Baseline::cubic})
      for (const double high_pass : {0., 0.2})
      {
        INFO(sample.source.file << ", baseline " << name_of(baseline) << ", high pass " << high_pass);
        const Record record = parse_record(sample.text, sample.source);
        Record twice = record;
        for (double& value : twice.values) value *= 2;
        const MotionProcessing once{.baseline = baseline, .high_pass = high_pass};
        MotionProcessing scaled = once;
        scaled.scale = 2;
        const GroundMotion a = make_ground_motion(record, once), b = make_ground_motion(twice, once),
                           c = make_ground_motion(record, scaled);
        REQUIRE(a.velocity.size() == b.velocity.size());
        bool same = true;
        for (std::size_t k = 0; k < a.velocity.size(); ++k)
          same = same && 2 * a.velocity[k] == b.velocity[k] && 2 * a.acceleration[k] == b.acceleration[k] &&
                 b.velocity[k] == c.velocity[k] && b.acceleration[k] == c.acceleration[k];
        CHECK(same);
        CHECK(b.report.recorded.pga == 2 * a.report.recorded.pga);
      }
}

TEST_CASE("a record of any format is read again from what is printed of it", "[io]")
{
  for (const Sample& sample : samples())
  {
    INFO(sample.source.file);
    const Record record = parse_record(sample.text, sample.source);
    const Record again = parse_record(peer_text(record), {.file = "printed.txt"});
    CHECK(again.quantity == record.quantity);
    CHECK(again.dt == Approx(record.dt).epsilon(1e-8)); // 9 digits
    REQUIRE(again.values.size() == record.values.size());
    double apart = 0, greatest = 0;
    for (std::size_t k = 0; k < record.values.size(); ++k)
    {
      apart = std::max(apart, std::fabs(again.values[k] - record.values[k]));
      greatest = std::max(greatest, std::fabs(record.values[k]));
    }
    CHECK(apart < 1e-8 * greatest);
  }
}
