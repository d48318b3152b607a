// Headers are written by people: "Acceleration time history in units of g", "Component: N45E (corrected)".
// What is looked for in them are single words, whole and in any case, never parts of words: "g" occurs in
// every line.

#include "io/records/words.hpp"

#include <algorithm>
#include <array>

namespace mpm::records
{
bool has_word(std::string_view text, Names words)
{
  return std::ranges::any_of(words,
                             [&](std::string_view word) { return find_word(text, word) != text.npos; });
}

std::optional<QuantityWord> quantity_word(std::string_view text)
{
  struct Word
  {
    std::string_view text;
    Quantity quantity;
  };
  // Where a line names two, as "acceleration from velocity", the first of this list counts.
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
      return QuantityWord{word.quantity, at, at + word.text.size()};
  return {};
}

// A full stop ends a phrase only before a blank: "cm/s. Filter" but not "0.5". Two blanks in a row are a gap
// between columns of text.
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

// "units of: in g": joints come in any number and order.
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

// The inch is told from the word by what follows: "in/s2" and "in.", but "in g" and "in (g)".
std::size_t behind_in(std::string_view text)
{
  const std::string all = lower(text);
  for (std::size_t at = 0; (at = find_word(all, "in", at)) != all.npos; at += 2)
    if (at + 2 < all.size() && (is_blank(all[at + 2]) || all[at + 2] == '(')) return at + 2;
  return all.npos;
}

bool is_label(std::string_view text)
{
  // Components, then kinds of processing.
  constexpr std::string_view labels =
      " n s e w u d z h v x y t l r fn fp ns ew ud n-s e-w u-d up down vertical vert hor horizontal long "
      "tran "
      "longitudinal transverse radial north south east west deg component comp "
      "raw corrected uncorrected filtered unfiltered processed ";
  // "n45e", an azimuth: a quadrant's letters around digits; "090", an azimuth in degrees.
  return std::ranges::all_of(words_of(bare(text)),
                             [&](std::string_view word)
                             {
                               const std::string name = lower(word);
                               if (labels.find(" " + name + " ") != labels.npos) return true;
                               if (std::ranges::all_of(name, is_digit)) return true;
                               return name.size() > 2 &&
                                      std::string_view("ns").find(name[0]) != std::string::npos &&
                                      std::string_view("ew").find(name.back()) != std::string::npos &&
                                      std::all_of(name.begin() + 1, name.end() - 1, is_digit);
                             });
}

// A header that says "PERCENT G" or "COUNTS" states a unit that is not known, which must not be taken for
// none: then the unit of the extension or of the case would be used in its stead. N/S and the like are no
// fractions.
bool hints_at_unit(std::string_view text)
{
  std::string all = lower(text);
  for (std::string_view pair : {"n/s", "e/w", "u/d", "n/a"})
    if (const std::size_t at = find_word(all, pair); at != all.npos) all.replace(at, pair.size(), " ");
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i] == '/' && is_letter(all[i - 1])) return true;
  if (all.find_first_of("%^*\xB2\xB5") != all.npos) return true;
  return has_word(all, {"g",           "gs",     "gal",     "gals",   "mg",          "ug",
                        "cm",          "cms",    "mm",      "km",     "um",          "nm",
                        "dm",          "ft",     "feet",    "foot",   "inch",        "inches",
                        "meter",       "meters", "metre",   "metres", "centimeter",  "centimeters",
                        "milli",       "micro",  "percent", "pct",    "gravity",     "gravities",
                        "count",       "counts", "volt",    "volts",  "mv",          "sec",
                        "seconds",     "millig", "microg",  "kg",     "millimeters", "millimetres",
                        "centimetres", "mps"});
}
} // namespace mpm::records
