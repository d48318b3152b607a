// Lines of the ground from text files of x and y.

#include "io/case/sections.hpp"
#include "io/common/input_file.hpp"
#include "io/records/statements.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace mpm
{
using namespace records;

namespace
{
constexpr std::size_t most_points = 20'000; // each becomes a setting of the case

/// Why a file is no line of the ground, with its row.
struct BadRow
{
  int row;
  std::string what;
};

struct LengthUnit
{
  std::string_view name;
  double si;
};

/// A unit of length by a word of prose, where "in" and "foot" mean other things.
const LengthUnit* length_unit(std::string_view word)
{
  static constexpr std::array units{
      LengthUnit{"m", 1},           LengthUnit{"meter", 1},       LengthUnit{"meters", 1},
      LengthUnit{"metre", 1},       LengthUnit{"metres", 1},      LengthUnit{"cm", 0.01},
      LengthUnit{"mm", 0.001},      LengthUnit{"km", 1000},       LengthUnit{"ft", 0.3048},
      LengthUnit{"feet", 0.3048},   LengthUnit{"inch", 0.0254},   LengthUnit{"inches", 0.0254},
      LengthUnit{"yd", 0.9144},     LengthUnit{"yard", 0.9144},   LengthUnit{"yards", 0.9144},
      LengthUnit{"mile", 1609.344}, LengthUnit{"miles", 1609.344}};
  const auto found = std::ranges::find(units, word, &LengthUnit::name);
  return found == units.end() ? nullptr : &*found;
}

/// The units that a text in lower case names; not the lengths in it, as "5 ft".
std::vector<const LengthUnit*> units_in(std::string_view text)
{
  std::vector<const LengthUnit*> units;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t begin = at;
    while (at < text.size() && is_letter(text[at])) ++at;
    // "levels every 5 ft" says nothing of the columns.
    const std::size_t before = begin == 0 ? text.npos : text.find_last_not_of(" \t", begin - 1);
    const bool measures = before != text.npos && is_digit(text[before]);
    if (const LengthUnit* unit = length_unit(text.substr(begin, at - begin)); unit && !measures)
      units.push_back(unit);
    if (at == begin) ++at;
  }
  return units;
}

/// Refuses depths and columns in the other order: "y, x".
void check_names(const std::string& first, const std::string& second, int row)
{
  const auto begins = [](const std::string& name, std::string_view word)
  { return find_word(name, word) == 0; };
  if (begins(first, "depth") || begins(second, "depth"))
    // A depth read as a height would turn the ground upside down, and it would still be a ground.
    throw BadRow{row, "has depths; write heights y, positive upwards"};
  for (std::string_view height : {"y", "z", "elevation", "height", "level", "altitude"})
    if (begins(first, height) && !begins(second, height) && !begins(second, "z"))
      throw BadRow{row, "has '" + first + "' before '" + second + "'; write x first, then y"};
}

/// The unit of a heading's column; null if it names none. Refuses one in brackets that is not known.
const LengthUnit* unit_of_column(const std::string& name, int row)
{
  static constexpr LengthUnit foot{"ft", 0.3048}, inch{"in", 0.0254};
  const auto units = units_in(name);
  if (!units.empty()) return units.back();
  const std::size_t open = name.find_first_of("([");
  if (open == name.npos) return nullptr;
  const std::string_view inside = bracket(std::string_view(name).substr(open));
  if (inside == "foot") return &foot;
  if (inside == "in") return &inch;
  throw BadRow{row, "states the unit '" + std::string(inside) +
                        "', which is not known; write x (m), y (m), or cm, mm, km, ft, in"};
}

/// SI values of the units of both columns, as heading and comments above the numbers say; m by default.
class Units
{
public:
  /// A heading, or a comment that may be one.
  void add(const Line& line, std::string_view heading, bool is_comment)
  {
    const std::string text = lower(heading);
    const auto names = names_in(text, 2);
    if (names.size() == 2)
    {
      const std::string first(names[0]), second(names[1]);
      check_names(first, second, line.number);
      const LengthUnit *x = unit_of_column(first, line.number), *y = unit_of_column(second, line.number);
      if (x && y) columns_ = {x->si, y->si};
      if (x && y) return;
    }
    const auto units = units_in(text);
    const bool says = find_word(text, "units") != text.npos || find_word(text, "unit") != text.npos;
    if (units.empty() && says && is_comment)
      throw BadRow{line.number,
                   "states a unit that is not known, '" + text + "'; write m, cm, mm, km, ft or in"};
    for (const LengthUnit* unit : units)
    {
      if (all_ && all_->si != unit->si)
        throw BadRow{line.number, "names the unit " + std::string(unit->name) + " beside " +
                                      std::string(all_->name) + "; write a heading as 'x (m), y (ft)'"};
      all_ = unit;
    }
  }
  std::array<double, 2> si(int row) const
  {
    if (!columns_) return {all_ ? all_->si : 1, all_ ? all_->si : 1};
    if (all_ && all_->si != (*columns_)[0] && all_->si != (*columns_)[1])
      throw BadRow{row, "is below a heading and a comment of different units; mend either"};
    return *columns_;
  }

private:
  std::optional<std::array<double, 2>> columns_; ///< each with a unit of its own in a heading
  const LengthUnit* all_ = nullptr;
};

/// Two columns x, y; `#` begins a comment. The first line may be a heading.
Polyline parse_line(const std::vector<Line>& lines)
{
  Polyline polyline;
  Units units;
  bool heading_allowed = true;
  for (const Line& line : lines)
  {
    const std::size_t mark = std::min(line.text.find('#'), line.text.size());
    const std::string_view text = trimmed(line.text.substr(0, mark)), comment = line.text.substr(mark);
    const bool is_heading = heading_allowed && !names_in(text, 2).empty();
    if (is_heading) units.add(line, text, false);
    if (polyline.x.empty() && !comment.empty() && (text.empty() || is_heading))
      units.add(line, trimmed(comment.substr(std::min(comment.find_first_not_of('#'), comment.size()))),
                true);
    // Only the first line that is no comment: a word further down is damage.
    heading_allowed = heading_allowed && text.empty();
    if (text.empty() || is_heading) continue;
    if (has_decimal_commas(text)) throw BadRow{line.number, "has decimal commas; write decimal points"};
    const auto numbers = numbers_in(text);
    if (!numbers || numbers->size() != 2) throw BadRow{line.number, "must be two numbers, x and y in m"};
    if (polyline.x.size() == most_points)
      throw BadRow{line.number, "is the point after " + std::to_string(most_points) +
                                    ", more than are read; thin them out, a point for each cell is enough"};
    const auto [x_unit, y_unit] = units.si(line.number);
    polyline.x.push_back((*numbers)[0] * x_unit);
    polyline.y.push_back((*numbers)[1] * y_unit);
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
    return problems.add_missing(node.location, node.path,
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
    return problems.add(node.location, node.path, path.string() + row + ": " + bad.what), Polyline{};
  }
}

void check_extents(const Case& case_file, const YamlNode& tree, Problems& problems)
{
  for (const Surface& surface : case_file.surfaces)
  {
    const Polyline* line = std::get_if<Polyline>(&surface.shape);
    const YamlNode& node = *tree.child("surfaces")->child(surface.name);
    const YamlNode* own = node.child("file") ? node.child("file") : node.child("points");
    if (!line || !own || line->x.size() < 2) continue;
    const auto [low, high] = std::ranges::minmax(line->y);
    if (low == high || (line->x.front() < case_file.domain.right && line->x.back() > case_file.domain.left))
      continue;
    problems.add(own->location, own->path,
                 "lies beside the domain, from x = " + number_text(line->x.front()) + " m to " +
                     number_text(line->x.back()) + " m, where the domain has " +
                     number_text(case_file.domain.left) + " m to " + number_text(case_file.domain.right) +
                     " m: nothing of its shape enters the model; correct its x, or domain.x");
  }
}
} // namespace mpm
