#include "solver/stages/completion.hpp"

#include "io/case/key_table.hpp"
#include "io/case/profiles.hpp"
#include "io/case/yaml_tree.hpp"
#include "io/common/input_file.hpp"

#include <algorithm>

namespace mpm
{
namespace
{
/// The option that a word names, null if none; "--set" of "--set=a".
const CLI::Option* named(const CLI::App& app, const std::string& word)
{
  if (!word.starts_with("--")) return nullptr;
  return app.get_option_no_throw(word.substr(0, word.find('=')));
}

bool takes_value(const CLI::Option& option)
{
  return option.get_items_expected_max() > 0;
}

/// Options that can still be given, by their long names.
std::vector<Candidate> options_left(const CLI::App& app, const std::vector<std::string>& before)
{
  std::vector<Candidate> found;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames())
    {
      const bool repeatable = option->get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
      const auto given = [&](const std::string& word) { return named(app, word) == option; };
      if (!option->get_group().empty() && (repeatable || std::none_of(before.begin(), before.end(), given)))
        found.push_back({"--" + name, option->get_description()});
    }
  return found;
}

/// The tree of the case among the words; empty where there is none that can be read.
YamlNode case_among(const std::vector<std::string>& words)
{
  for (const std::string& word : words)
    if (word.ends_with(".yaml") || word.ends_with(".yml"))
    {
      Problems ignored;
      return parse_yaml(read_input(word, most_of_case).text, word, ignored);
    }
  return {};
}

/// "materials.NAME.density" and "regions[N].x" with the names and numbers that a case has, none for no case.
std::vector<std::string> with_own_names(const std::string& path, const YamlNode& tree)
{
  const auto at = std::min(path.find(".NAME"), path.find("[N]"));
  if (at == std::string::npos) return {path};
  const bool list = path[at] == '[';
  const std::string branch = path.substr(0, at), rest = path.substr(at + (list ? 3 : 5));
  const YamlNode* node = tree.child(branch);
  std::vector<std::string> found;
  for (std::size_t k = 0; node && k < node->children.size(); ++k)
    found.push_back(branch + (list ? "[" + std::to_string(k) + "]" : "." + node->children[k].key) + rest);
  return found;
}
} // namespace

std::string completion(const CLI::App& app, const std::vector<std::string>& words, const ValuesOf& values_of)
{
  const std::string last = words.empty() ? "" : words.back();
  const std::vector<std::string> before(words.begin(), words.end() - (words.empty() ? 0 : 1));
  const CLI::Option* open = before.empty() ? nullptr : named(app, before.back());
  if (open && (!takes_value(*open) || before.back().find('=') != std::string::npos)) open = nullptr;

  std::vector<Candidate> candidates;
  std::string prefix; // of "--out=DIR", which is one word
  if (open)
    candidates = values_of(*open, last, before);
  else if (const CLI::Option* option = named(app, last); option && last.find('=') != std::string::npos)
  {
    prefix = last.substr(0, last.find('=') + 1);
    if (takes_value(*option)) candidates = values_of(*option, last.substr(prefix.size()), before);
  }
  else if (last.starts_with("-"))
    candidates = options_left(app, before);
  else if (const auto arguments = app.get_options([](const CLI::Option* o) { return o->get_positional(); });
           !arguments.empty())
    candidates = values_of(*arguments.front(), last, before);

  std::string text;
  for (const Candidate& one : candidates)
    if (one.word.starts_with(":") || (prefix + one.word).starts_with(last))
      text += (one.word.starts_with(":") ? "" : prefix) + one.word + "\t" + one.meaning + "\n";
  return text;
}

std::vector<Candidate> case_values(const CLI::Option& option, const std::string& typed,
                                   const std::vector<std::string>& before)
{
  const std::string type = option.get_type_name();
  if (type == "DIR") return {{":folders", ""}};
  if (type == "FILE" || option.get_positional()) return {{":files", ""}};
  std::vector<Candidate> found;
  if (type == "NAME")
  {
    const YamlNode tree = case_among(before);
    if (const YamlNode* profiles = tree.child("profiles"))
      for (const YamlNode& profile : profiles->children)
        found.push_back({profile.key, "profile of the case"});
    for (const StandardProfile& each : standard_profiles)
      if (std::none_of(found.begin(), found.end(), [&](const Candidate& c) { return c.word == each.name; }))
        found.push_back({std::string(each.name), std::string(each.meaning)});
  }
  if (type == "[PATH]")
    for (const KeyDescription& key : case_keys()) found.push_back({key.path, key.meaning});
  if (type == "KEY=VALUE")
  {
    const YamlNode tree = case_among(before);
    for (const KeyDescription& key : case_keys())
      for (const std::string& path : with_own_names(key.path, tree))
        if (!typed.starts_with(path + "="))
          found.push_back({path + "=", key.form + ": " + key.meaning});
        else
          for (const std::string& word : words_of(key.form))
            found.push_back({path + "=" + word, key.meaning});
  }
  return found;
}
} // namespace mpm
