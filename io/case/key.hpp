#pragma once
// What is to be said about a key of the case file. It is said once, where the key is read, and `--keys`
// prints it: a key cannot be read without being described.

#include <string>
#include <string_view>

namespace mpm
{
/// A key as its reader names it. What the reader checks (dimension, range, words, default) is not told again.
struct Key
{
  std::string_view name;
  std::string_view meaning;   ///< one line, for people
  std::string_view form;      ///< what may be given, where only the reader's code tells: "[left, right] in m"
  std::string_view otherwise; ///< what holds without the key, where the reader states no default

  constexpr Key(std::string_view name, std::string_view meaning = {}, std::string_view form = {},
                std::string_view otherwise = {})
      : name(name), meaning(meaning), form(form), otherwise(otherwise)
  {
  }
  constexpr Key(const char* name) : Key(std::string_view(name)) {}
};

/// A key of the case file as `--keys` prints it.
struct KeyDescription
{
  std::string path;      ///< "materials.NAME.density"
  std::string form;      ///< type, unit and range: "density, above 0 kg/m3"
  std::string otherwise; ///< what holds without it; empty: it is required
  std::string meaning;   ///< one line
};
} // namespace mpm
