#include "io/record_statements.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

namespace mpm::records
{
namespace
{
using Names = std::initializer_list<std::string_view>;

/// How surely a line speaks of the recorded values; the first that occurs decides.
enum Rank
{
  of_the_values, ///< names the quantity: "ACCELERATION IN UNITS OF G"
  of_the_file,   ///< "units: g"
  in_passing,    ///< the word units in a title
  of_another,    ///< an instrument's, a peak's
};

struct Statement
{
  Rank rank;
  std::optional<RecordUnit> unit;
  std::string unknown;
  Line line;
};

bool has_word(std::string_view text, Names words)
{
  return std::ranges::any_of(words,
                             [&](std::string_view word) { return find_word(text, word) != text.npos; });
}

struct QuantityWord
{
  Quantity quantity;
  std::size_t end; ///< of the word in the line
};

std::optional<QuantityWord> quantity_word(std::string_view text)
{
  struct Word
  {
    std::string_view text;
    Quantity quantity;
  };
  using enum Quantity;
  constexpr std::array words{Word{"acceleration", acceleration},
                             Word{"accelerations", acceleration},
                             Word{"accel", acceleration},
                             Word{"acc", acceleration},
                             Word{"velocity", velocity},
                             Word{"velocities", velocity},
                             Word{"veloc", velocity},
                             Word{"vel", velocity},
                             Word{"displacement", displacement},
                             Word{"displacements", displacement},
                             Word{"displ", displacement},
                             Word{"disp", displacement}};
  for (const Word& word : words)
    if (const std::size_t at = find_word(text, word.text); at != text.npos)
      return QuantityWord{word.quantity, at + word.text.size()};
  return {};
}

/// The words up to a comma, a full stop, a wide gap or the end of a bracket.
std::string_view phrase(std::string_view text)
{
  text = trimmed(text);
  if (const std::string_view inside = bracket(text); !inside.empty()) return trimmed(inside);
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    const char c = text[i], next = i + 1 < text.size() ? text[i + 1] : ' ';
    depth += (c == '(' || c == '[') - (c == ')' || c == ']');
    const bool stop = c == ',' || c == ';' || c == '\t' || (c == '.' && is_blank(next)) ||
                      (is_blank(c) && is_blank(next) && i + 1 < text.size()) || depth < 0;
    if (stop) return trimmed(text.substr(0, i));
  }
  return text;
}

std::vector<std::string_view> words_of(std::string_view text)
{
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(" \t", at)) != text.npos;)
  {
    const std::size_t end = std::min(text.find_first_of(" \t", at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

/// Whether a word behind a unit makes it another: "g X 10", "g /100", "cm per".
bool goes_on(std::string_view word)
{
  constexpr std::array<std::string_view, 7> joints{"x", "by", "per", "times", "over", "squared", "cubed"};
  if (std::ranges::find(joints, std::string_view(lower(word))) != joints.end()) return true;
  return word.find_first_of("/*^%") != word.npos || word.starts_with("10") ||
         (word.size() > 1 && (word[0] == '-' || word[0] == '+') && is_digit(word[1]));
}

/// The unit at the front of a phrase, and what is stated where that is none.
Statement unit_at(std::string_view text, Rank rank, const Line& line)
{
  std::vector<std::string_view> words = words_of(phrase(text));
  const auto is = [&](std::size_t i, Names names)
  { return i < words.size() && std::ranges::find(names, std::string_view(lower(words[i]))) != names.end(); };
  if (is(0, {"s", "sec", "secs", "seconds"}) && is(1, {"and"})) words.erase(words.begin(), words.begin() + 2);
  if (words.empty()) return {rank, {}, {}, line};
  const auto first_words = [&](std::size_t n)
  {
    const std::string_view last = words[n - 1];
    return std::string_view(words[0].data(), std::size_t(last.data() + last.size() - words[0].data()));
  };
  for (std::size_t n = std::min<std::size_t>(words.size(), 7); n > 0; --n)
    if (const auto unit = parse_unit(first_words(n)))
    {
      if (n == words.size() || !goes_on(words[n])) return {rank, unit, {}, line};
      break;
    }
  return {rank, {}, std::string(first_words(std::min<std::size_t>(words.size(), 4))), line};
}

/// A component or a kind of processing in brackets, no unit: "(N45E)", "(corrected)", "(090)".
bool is_label(std::string_view text)
{
  constexpr std::array<std::string_view, 37> labels{
      "n",        "s",           "e",         "w",    "u",          "d",      "z",    "h",
      "v",        "ns",          "ew",        "ud",   "n-s",        "e-w",    "u-d",  "up",
      "down",     "vertical",    "vert",      "hor",  "horizontal", "long",   "tran", "longitudinal",
      "north",    "south",       "east",      "west", "transverse", "radial", "raw",  "corrected",
      "filtered", "uncorrected", "processed", "deg",  "component"};
  return std::ranges::all_of(words_of(bare(text)),
                             [&](std::string_view word)
                             {
                               const std::string name = lower(word);
                               if (std::ranges::find(labels, std::string_view(name)) != labels.end())
                                 return true;
                               if (std::ranges::all_of(name, is_digit)) return true;
                               return name.size() > 2 &&
                                      std::string_view("ns").find(name[0]) != std::string::npos &&
                                      std::string_view("ew").find(name.back()) != std::string::npos &&
                                      std::all_of(name.begin() + 1, name.end() - 1, is_digit);
                             });
}

bool looks_like_a_unit(std::string_view text)
{
  return text.find_first_of("/%^*\xB2") != text.npos || has_word(lower(text), {"counts", "count", "volts"});
}

/// A unit that follows the quantity: "ACCELERATION IN CM/S/S", "Velocity (cm/s)".
void add_after_quantity(std::vector<Statement>& found, const Line& line, std::size_t end)
{
  const std::string_view rest = line.text.substr(end);
  if (const std::size_t in = find_word(lower(rest), "in"); in != rest.npos && in + 2 < rest.size())
  {
    Statement statement = unit_at(rest.substr(in + 2), of_the_values, line);
    if (statement.unit ||
        looks_like_a_unit(words_of(statement.unknown).empty() ? "" : words_of(statement.unknown)[0]))
      found.push_back(std::move(statement));
  }
  for (std::size_t at = 0; (at = rest.find_first_of("([", at)) != rest.npos; ++at)
  {
    const std::string_view inside = bracket(rest.substr(at));
    const bool directly = trimmed(rest.substr(0, at)).empty();
    if (const auto unit = parse_unit(inside))
      found.push_back({of_the_values, unit, {}, line});
    else if ((directly && !is_label(inside)) || looks_like_a_unit(inside))
      found.push_back({of_the_values, {}, std::string(inside), line});
  }
}

/// Whether words speak of an instrument or a peak, not of the recorded values.
bool is_of_another(std::string_view text)
{
  return has_word(text, {"peak", "max", "maximum", "min", "minimum", "pga", "pgv", "pgd", "rms", "instrument",
                         "sensor", "recorder", "sensitivity", "digitizer", "threshold"}) &&
         text.find("time h") == text.npos && text.find("time s") == text.npos;
}

std::vector<Statement> statements_in(const Line& line)
{
  std::vector<Statement> found;
  const std::string text = lower(line.text);
  const auto quantity = quantity_word(text);
  bool has_units = false;
  for (std::string_view word : {"units", "unit"})
    for (std::size_t at = 0; (at = find_word(text, word, at)) != text.npos; at += word.size())
    {
      has_units = true;
      bool joined = false;
      const std::string_view rest = without_joints(line.text.substr(at + word.size()), joined);
      const bool other = is_of_another(text.substr(0, at));
      const Rank rank = other ? of_another : quantity ? of_the_values : joined ? of_the_file : in_passing;
      found.push_back(unit_at(rest, rank, line));
    }
  if (!has_units && quantity && !is_of_another(text)) add_after_quantity(found, line, quantity->end);
  std::erase_if(found, [](const Statement& s) { return !s.unit && s.unknown.empty(); });
  return found;
}

/// "VELOCITY TIME HISTORY": a line that says what is recorded, if not in which unit.
std::optional<Quantity> recorded_quantity(const Line& line)
{
  const std::string text = lower(line.text);
  const auto word = quantity_word(text);
  if (!word) return {};
  const std::string_view rest = trimmed(std::string_view(text).substr(word->end));
  const bool says =
      rest.starts_with("time series") || rest.starts_with("time history") || rest.starts_with("time-history");
  return says ? std::optional(word->quantity) : std::nullopt;
}

std::string name(const Statement& statement)
{
  return statement.unit ? statement.unit->name : shown(statement.unknown);
}
} // namespace

std::string_view without_joints(std::string_view text, bool& joined)
{
  for (bool again = true; again;)
  {
    again = false;
    while (!text.empty() && (is_blank(text[0]) || text[0] == ':' || text[0] == '='))
    {
      joined = joined || !is_blank(text[0]);
      text.remove_prefix(1);
    }
    for (std::string_view joint : {"of ", "are ", "is ", "in "})
      if (lower(text.substr(0, joint.size())) == joint)
      {
        text.remove_prefix(joint.size());
        joined = again = true;
      }
  }
  return text;
}

Said said_by(const RecordSource& source, const std::vector<Line>& lines)
{
  Said said;
  std::vector<Statement> all;
  for (const Line& line : lines)
  {
    std::ranges::move(statements_in(line), std::back_inserter(all));
    if (const auto quantity = recorded_quantity(line); quantity && !said.quantity)
    {
      said.quantity = quantity;
      said.line = line;
    }
  }
  std::erase_if(all, [](const Statement& s) { return s.rank == of_another; });
  if (all.empty()) return said;
  const Statement best = *std::ranges::min_element(all, {}, &Statement::rank);
  for (const Statement& other : all)
  {
    if (other.rank == in_passing && best.rank != in_passing) continue;
    const bool differs = best.unit && other.unit ? !(*best.unit == *other.unit)
                                                 : other.rank == best.rank && name(best) != name(other);
    if (differs)
      refuse(source, other.line,
             "states the unit " + name(other) + ", and line " + std::to_string(best.line.number) + " " +
                 name(best) + "; mend the header");
  }
  if (best.rank == in_passing && !best.unit) return said; // "UNITED UNITS LTD."
  said.unit = best.unit;
  said.unknown = best.unknown;
  said.line = best.line;
  if (const auto word = quantity_word(lower(best.line.text))) said.quantity = word->quantity;
  return said;
}

Said said_by_column(const Line& line, std::string_view name)
{
  Said said{{}, {}, {}, line};
  const std::string text = lower(name);
  if (const auto word = quantity_word(text)) said.quantity = word->quantity;
  for (std::size_t at = 0; (at = name.find_first_of("([", at)) != name.npos; ++at)
  {
    const std::string_view inside = bracket(name.substr(at));
    if (const auto unit = parse_unit(inside))
      said.unit = unit;
    else if (!is_label(inside))
      said.unknown = inside;
  }
  if (said.unit || !said.unknown.empty()) return said;
  const std::vector<std::string_view> words = words_of(name);
  std::vector<std::string_view> tails{name};
  if (const std::size_t in = find_word(text, "in"); in != text.npos && in > 0)
    tails.push_back(name.substr(in + 2));
  if (words.size() > 1) tails.push_back(words.back());
  if (const std::size_t bar = name.rfind('_'); bar != name.npos) tails.push_back(name.substr(bar + 1));
  for (std::string_view tail : tails)
    if (!said.unit) said.unit = parse_unit(tail);
  if (!said.unit && !words.empty() && looks_like_a_unit(words.back())) said.unknown = words.back();
  return said;
}
} // namespace mpm::records
