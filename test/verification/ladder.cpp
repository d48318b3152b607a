#include "test/verification/ladder.hpp"

#include "io/case/yaml_checker.hpp"

#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

namespace mpm::verification
{
namespace
{
std::vector<double> read_numbers(const YamlNode* node, Problems& problems)
{
  std::vector<double> values;
  if (!node) return values;
  for (const YamlNode* item : read_list(*node, "resolutions, coarse to fine", problems))
    values.push_back(read_number(*item, Dimension::none, {}, problems));
  return values;
}

/// `bound: VALUE` for every resolution, or `bounds: {RESOLUTION: VALUE, ...}`, with `suffix` behind the key.
void read_bounds(Section& section, const std::string& suffix, const Ladder& ladder, Measure& measure,
                 Problems& problems)
{
  const std::string bound = "bound" + suffix, bounds = "bounds" + suffix, least = "order" + suffix;
  const Bound every{section.number_or(0, std::string_view(bound), Dimension::none, Interval::positive()),
                    !suffix.empty()};
  if (every.value > 0)
    for (const auto* list : {&ladder.quick, &ladder.full})
      for (const double resolution : *list) measure.bounds[resolution] = every;
  if (const YamlNode* node = section.find(std::string_view(bounds)))
    for (const YamlNode& child : node->children)
      measure.bounds[std::stod(child.key)] = {
          read_number(child, Dimension::none, Interval::positive(), problems), !suffix.empty()};
  const double order = section.number_or(NAN, std::string_view(least), Dimension::none);
  if (!std::isnan(order)) measure.order = {order, !suffix.empty()};
}

Measure read_measure(const YamlNode& node, const Ladder& ladder, Problems& problems)
{
  Section section(&node, problems);
  Measure measure;
  measure.name = node.key;
  measure.norm = section.text("norm");
  measure.order_down_to = section.number_or(0, "order_down_to", Dimension::none);
  read_bounds(section, "", ladder, measure, problems);
  read_bounds(section, "_after_measurement", ladder, measure, problems);
  return measure;
}

double seconds_since(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
} // namespace

const LadderCase& ladder_case(std::string_view name)
{
  for (const LadderCase& one : ladder_cases())
    if (one.name == name) return one;
  throw std::runtime_error("verification: there is no case '" + std::string(name) +
                           "'; see seismpm-verify --list");
}

Ladder load_ladder(std::string_view name, const std::filesystem::path& cases)
{
  Ladder ladder;
  ladder.name = name;
  ladder.folder = cases / name;
  const std::filesystem::path path = ladder.folder / "ladder.yaml";
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  Problems problems;
  const YamlNode tree = parse_yaml(text, path.string(), problems);
  {
    Section section(&tree, problems);
    ladder.title = section.text("title");
    ladder.resolution = section.text("resolution");
    ladder.quick = read_numbers(section.require("quick"), problems);
    ladder.full = read_numbers(section.require("full"), problems);
    if (const YamlNode* measures = section.require("measures"))
      for (const YamlNode& child : measures->children)
        ladder.measures.push_back(read_measure(child, ladder, problems));
  }
  problems.throw_if_any();
  return ladder;
}

bool Row::pass() const
{
  return std::isfinite(error) && (!bound || error <= bound->value) &&
         (!least_order || order >= least_order->value);
}

Result climb(const LadderCase& ladder_case, const Ladder& ladder, std::span<const double> resolutions)
{
  Result result;
  result.ladder = ladder;
  std::vector<Findings> found;
  std::vector<double> seconds;
  for (const double resolution : resolutions)
  {
    const auto start = std::chrono::steady_clock::now();
    found.push_back(ladder_case.run(ladder.folder, resolution));
    seconds.push_back(seconds_since(start));
    for (const Curve& curve : found.back().curves) result.curves.push_back({resolution, curve});
  }
  for (const Measure& measure : ladder.measures)
    for (std::size_t k = 0; k < resolutions.size(); ++k)
    {
      Row row{ladder.name, measure.name, resolutions[k], found[k].errors.at(measure.name), NAN,
              {},          {},           seconds[k]};
      if (const auto bound = measure.bounds.find(row.resolution); bound != measure.bounds.end())
        row.bound = bound->second;
      if (k > 0)
        row.order = std::log(found[k - 1].errors.at(measure.name) / row.error) /
                    std::log(resolutions[k - 1] / resolutions[k]);
      const auto counts = [&](std::size_t at)
      { return at < resolutions.size() && resolutions[at] >= measure.order_down_to; };
      if (k > 0 && counts(k) && !counts(k + 1)) row.least_order = measure.order;
      result.rows.push_back(row);
    }
  return result;
}

std::map<std::string, std::vector<double>> read_table(const std::filesystem::path& path)
{
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  std::map<std::string, std::vector<double>> table;
  std::vector<std::string> names;
  for (std::string line; std::getline(file, line);)
  {
    if (line.empty() || line[0] == '#') continue;
    std::stringstream cells(line);
    std::size_t column = 0;
    const bool head = names.empty();
    for (std::string cell; std::getline(cells, cell, ','); ++column)
    {
      if (head)
        names.push_back(cell);
      else
        table[names.at(column)].push_back(std::stod(cell));
    }
    if (column != names.size())
      throw std::runtime_error(path.string() + ": a line has not as many cells as there are names: " + line);
  }
  return table;
}
} // namespace mpm::verification
