// Lines of the ground from text files of x and y.

#include "io/case_sections.hpp"
#include "io/input_file.hpp"
#include "io/record_statements.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace mpm
{
using namespace records;

namespace
{
/// Why a file is no line of the ground, with its row.
struct BadRow
{
  int row;
  std::string what;
};

/// SI value of a unit of length; empty if the text is none.
std::optional<double> length_unit(std::string_view text)
{
  struct Unit
  {
    std::string_view name;
    double si;
  };
  constexpr std::array units{Unit{"m", 1},         Unit{"meter", 1},      Unit{"meters", 1},
                             Unit{"metre", 1},     Unit{"metres", 1},     Unit{"cm", 0.01},
                             Unit{"mm", 0.001},    Unit{"km", 1000},      Unit{"ft", 0.3048},
                             Unit{"foot", 0.3048}, Unit{"feet", 0.3048},  Unit{"in", 0.0254},
                             Unit{"inch", 0.0254}, Unit{"inches", 0.0254}};
  const auto found = std::ranges::find(units, std::string_view(lower(text)), &Unit::name);
  return found == units.end() ? std::nullopt : std::optional(found->si);
}

bool is_one_of(const std::string& name, std::initializer_list<std::string_view> names)
{
  return std::ranges::find(names, std::string_view(name)) != names.end();
}

/// What a heading says of a column: its name, and SI value of its unit (1 if it names none).
struct Column
{
  std::string name;
  double si = 1;
};

Column column_of(std::string_view cell, int row)
{
  const std::size_t open = cell.find_first_of("([");
  std::string_view name = cell.substr(0, open), unit;
  if (open != cell.npos) unit = cell.substr(open + 1, cell.find_last_of(")]") - open - 1);
  const std::size_t mark = name.find_last_of("_ ", name.find_last_not_of(" \t"));
  if (unit.empty() && mark != name.npos && length_unit(name.substr(mark + 1))) unit = name.substr(mark + 1);
  while (!name.empty() && is_blank(name.back())) name.remove_suffix(1);
  const auto si = unit.empty() ? 1 : length_unit(unit);
  if (!si)
    throw BadRow{row, "states the unit '" + std::string(unit) +
                          "', which is not known; write x (m), y (m), or cm, "
                          "mm, km, ft, in"};
  return {lower(name), *si};
}

/// The two columns of a heading "x (ft), y (ft)". Refuses depths and columns in the other order.
std::array<Column, 2> columns_in(const std::vector<std::string_view>& names, int row)
{
  const std::array columns{column_of(names[0], row), column_of(names[1], row)};
  const auto is_height = [](const std::string& name) {
    return is_one_of(name, {"y", "z", "elevation", "height", "level", "altitude"});
  };
  if (columns[0].name == "depth" || columns[1].name == "depth")
    throw BadRow{row, "has depths; write heights y, positive upwards"};
  if (is_height(columns[0].name) && !is_height(columns[1].name))
    throw BadRow{row,
                 "has '" + columns[0].name + "' before '" + columns[1].name + "'; write x first, then y"};
  return columns;
}

/// "units: ft", "coordinates in feet": the unit of both columns that a comment states; empty if it states
/// none.
std::optional<double> unit_of_comment(std::string_view comment, int row)
{
  const std::string text = lower(comment);
  for (std::string_view key : {"units", "unit", "in"})
    for (std::size_t at = 0; (at = find_word(text, key, at)) != text.npos; at += key.size())
    {
      std::string_view rest = std::string_view(text).substr(at + key.size());
      for (std::string_view joint : {" ", ":", "=", "of ", "are ", "is ", "in ", "(", " "})
        while (rest.starts_with(joint)) rest.remove_prefix(joint.size());
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t.,;)"));
      if (const auto si = length_unit(word)) return si;
      if (key != "in" && !word.empty())
        throw BadRow{row, "states the unit '" + std::string(word) +
                              "', which is not known; write m, cm, mm, km, ft or in"};
    }
  return {};
}

/// Two columns x, y; `#` begins a comment. A heading, in the first line or a comment above, may name them
/// with their units.
Polyline parse_line(const std::vector<Line>& lines)
{
  Polyline polyline;
  std::array<Column, 2> columns;
  bool above = true;
  for (const Line& line : lines)
  {
    std::string_view text = line.text.substr(0, line.text.find('#'));
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    std::string_view heading = text;
    if (text.empty())
      heading = line.text.substr(std::min(line.text.find_first_not_of("# \t"), line.text.size()));
    const auto names = above ? names_in(heading, 2) : std::vector<std::string_view>{};
    const bool comment = text.empty();
    const bool brackets = names.size() == 2 && names[0].find_first_of("([") != std::string_view::npos;
    if (names.size() == 2 && (!comment || brackets || lower(names[0]).starts_with("x")))
      columns = columns_in(names, line.number);
    else if (const auto si = comment && above ? unit_of_comment(heading, line.number) : std::nullopt)
      columns[0].si = columns[1].si = *si;
    above = above && comment;
    if (comment || names.size() == 2) continue;
    if (has_decimal_commas(text)) throw BadRow{line.number, "has decimal commas; write decimal points"};
    const auto numbers = numbers_in(text);
    if (!numbers || numbers->size() != 2) throw BadRow{line.number, "must be two numbers, x and y in m"};
    polyline.x.push_back((*numbers)[0] * columns[0].si);
    polyline.y.push_back((*numbers)[1] * columns[1].si);
  }
  if (polyline.x.empty()) throw BadRow{0, "has no points"};
  return polyline;
}
} // namespace

Polyline read_ground_file(const YamlNode& node, const std::filesystem::path& folder, Problems& problems)
{
  const std::string name = read_text(node, problems);
  if (name.empty()) return {};
  const std::filesystem::path path = (folder / name).lexically_normal();
  const InputText input = read_input(path, most_of_surface);
  if (!input.problem.empty())
    return problems.add_missing(node.place, node.path,
                                path.string() + ": " + input.problem +
                                    "; paths are relative to the case file"),
           Polyline{};
  try
  {
    return parse_line(lines_of(input.text));
  }
  catch (const BadRow& bad)
  {
    const std::string row = bad.row > 0 ? ":" + std::to_string(bad.row) : "";
    return problems.add(node.place, node.path, path.string() + row + ": " + bad.what), Polyline{};
  }
}

void check_extents(const Case& scene, const YamlNode& tree, Problems& problems)
{
  for (const Surface& surface : scene.surfaces)
  {
    const Polyline* line = std::get_if<Polyline>(&surface.shape);
    const YamlNode& node = *tree.child("surfaces")->child(surface.name);
    const YamlNode* own = node.child("file") ? node.child("file") : node.child("points");
    if (!line || !own || line->x.size() < 2) continue;
    const auto [low, high] = std::ranges::minmax(line->y);
    if (low == high || (line->x.front() < scene.domain.right && line->x.back() > scene.domain.left)) continue;
    problems.add(own->place, own->path,
                 "lies beside the domain, from x = " + number_text(line->x.front()) + " m to " +
                     number_text(line->x.back()) + " m, where the domain has " +
                     number_text(scene.domain.left) + " m to " + number_text(scene.domain.right) +
                     " m: nothing of its shape enters the model; correct its x, or domain.x");
  }
}
} // namespace mpm
