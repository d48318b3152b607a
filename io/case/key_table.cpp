#include "io/case/key_table.hpp"

#include "io/case/sections.hpp"
#include "io/common/error.hpp"
#include "io/common/suggestion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

namespace mpm
{
namespace
{
// The readers describe what they ask for, so that reading a case with one of everything that people name
// describes all keys. It lacks nearly all that a case must have, which is no matter here: sections that are
// absent are asked for their keys as well. Surfaces and materials carry the names of their kinds.
constexpr std::string_view one_of_everything = R"(
surfaces: {offset: {offset: gaussian}, gaussian: {gaussian: {}}}
regions: [{}]
seismic: {motion: {horizontal: {}, vertical: {}}}
)";

/// A description, and the laws whose parameter it is.
struct Described
{
  KeyDescription key;
  std::vector<std::string> models;
};

/// "materials.elastic.density" as "materials.NAME.density", and elastic.
Described with_general_path(KeyDescription key)
{
  Described described{std::move(key), {}};
  std::string& path = described.key.path;
  for (const std::string_view branch : {"surfaces.", "materials."})
    if (path.starts_with(branch))
    {
      const auto end = path.find('.', branch.size());
      if (branch == "materials.") described.models = {path.substr(branch.size(), end - branch.size())};
      path.replace(branch.size(), end - branch.size(), "NAME");
    }
  return described;
}

/// Steps of a key path: "regions[0].x" as regions, 0 and x.
std::vector<std::string> steps_of(std::string_view path)
{
  std::vector<std::string> steps;
  while (!path.empty())
  {
    const auto end = std::min(path.find_first_of(".[]"), path.size());
    if (end > 0) steps.emplace_back(path.substr(0, end));
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  return steps;
}

/// Whether the key at `path` stands at or below `branch`.
bool stands_below(const std::string& path, const std::vector<std::string>& branch)
{
  const std::vector<std::string> steps = steps_of(path);
  return steps.size() >= branch.size() && std::equal(branch.begin(), branch.end(), steps.begin(),
                                                     [](const std::string& wanted, const std::string& step) {
                                                       return wanted == step || step == "NAME" || step == "N";
                                                     });
}

/// All key paths and what is above them.
std::vector<std::string> all_branches(const std::vector<KeyDescription>& keys)
{
  std::vector<std::string> branches;
  for (const KeyDescription& key : keys)
    for (std::size_t end = key.path.find('.');; end = key.path.find('.', end + 1))
    {
      branches.push_back(key.path.substr(0, end));
      if (end == std::string::npos) break;
    }
  return branches;
}

/// Breaks a text at blanks into lines of at most `width` letters.
std::vector<std::string> wrapped(std::string_view text, std::size_t width)
{
  std::vector<std::string> lines;
  // A word that is longer than a line stays whole.
  while (text.size() > width)
  {
    const auto blank = text.rfind(' ', width);
    if (blank == std::string_view::npos) break;
    lines.emplace_back(text.substr(0, blank));
    text.remove_prefix(blank + 1);
  }
  lines.emplace_back(text);
  return lines;
}
} // namespace

std::vector<KeyDescription> case_keys()
{
  std::vector<KeyDescription> found;
  Problems ignored;
  ignored.keys = &found;
  std::string text = std::string(one_of_everything) + "materials:\n";
  for (const std::string& model : model_names()) text += "  " + model + ": {model: " + model + "}\n";
  // Whatever is missing in it is noted in `ignored` and looked at by nobody.
  Case nothing;
  read_parts(nothing, parse_yaml(text, "", ignored), ignored);

  std::vector<Described> all;
  for (KeyDescription& key : found)
  {
    Described described = with_general_path(std::move(key));
    const auto same =
        std::ranges::find(all, described.key.path, [](const Described& d) { return d.key.path; });
    if (same == all.end())
      all.push_back(std::move(described));
    else
      same->models.insert(same->models.end(), described.models.begin(), described.models.end());
  }
  std::vector<KeyDescription> keys;
  for (Described& described : all)
  {
    if (!described.models.empty() && described.models.size() < model_names().size())
      described.key.meaning = fmt::format("{}: {}", fmt::join(described.models, ", "), described.key.meaning);
    keys.push_back(std::move(described.key));
  }
  // Profiles are taken out of the tree before it is read, so that no reader tells of them.
  keys.push_back({"profiles.NAME", "map of key paths to values", "none",
                  "values for --profile NAME, which go before the file's own; --set goes before both"});
  return keys;
}

std::vector<KeyDescription> case_keys(std::string_view path)
{
  std::vector<KeyDescription> keys = case_keys();
  const std::vector<std::string> branch = steps_of(path);
  std::vector<std::string> branches = all_branches(keys); // of which one as deep may be meant
  std::erase_if(branches, [&](const std::string& one) { return steps_of(one).size() != branch.size(); });
  std::erase_if(keys, [&](const KeyDescription& key) { return !stands_below(key.path, branch); });
  if (keys.empty())
    throw Error(exit_code::usage,
                fmt::format("--keys {}: there is no such key{}; --keys alone lists all of them", path,
                            suggestion(path, branches)));
  return keys;
}

std::vector<std::string> words_of(const std::string& form)
{
  if (!std::regex_match(form, std::regex("\\w+(, \\w+)* or \\w+"))) return {};
  const std::regex word("\\w+");
  std::vector<std::string> words;
  for (std::sregex_iterator found(form.begin(), form.end(), word), end; found != end; ++found)
    if (found->str() != "or") words.push_back(found->str());
  return words;
}

std::string text_of(const std::vector<KeyDescription>& keys)
{
  constexpr std::size_t columns = 100;
  std::size_t indent = 0;
  for (const KeyDescription& key : keys) indent = std::max(indent, key.path.size() + 2);
  std::string text;
  for (const KeyDescription& key : keys)
  {
    const std::string otherwise = key.otherwise.empty() ? "required" : "default: " + key.otherwise;
    // The path stands before the first line only.
    std::string margin = key.path;
    for (const std::string& part : {key.form + "; " + otherwise, key.meaning})
      for (const std::string& line : wrapped(part, columns - indent))
      {
        text += fmt::format("{:{}}{}\n", margin, indent, line);
        margin.clear();
      }
  }
  return text;
}

std::string units_text()
{
  std::string text;
  for (int d = 0; d <= static_cast<int>(last_dimension); ++d)
    if (const auto dimension = static_cast<Dimension>(d); dimension != Dimension::none)
      text += fmt::format("{}: {}\n", name_of(dimension), units_of(dimension));
  return text;
}
} // namespace mpm
