#include "io/case/schema.hpp"

#include "io/case/key_table.hpp"
#include "io/case/units.hpp"

#include <nlohmann/json.hpp>

#include <regex>

namespace mpm
{
namespace
{
using Json = nlohmann::ordered_json;

const std::string number_pattern = "^\\s*[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?\\s*";

/// A number with one of the units of a dimension: "0.25 m". Powers may be written m/s2 or m/s^2.
Json quantity(Dimension dimension)
{
  std::string units = std::regex_replace(units_of(dimension), std::regex(", | or "), "|");
  units = std::regex_replace(units, std::regex("([a-z])([0-9])"), "$1\\^?$2");
  return {{"type", "string"}, {"pattern", number_pattern + "(" + units + ")\\s*$"}};
}

/// What a key's form, as people read it, asks of its value. What it does not tell is left open.
Json value_of(const std::string& form)
{
  for (int d = 0; d <= static_cast<int>(last_dimension); ++d)
  {
    const auto dimension = static_cast<Dimension>(d);
    const std::string name(name_of(dimension));
    if (dimension != Dimension::none && (form.starts_with(name + ",") || form.starts_with(name + " in ")))
      return quantity(dimension);
  }
  if (const auto words = words_of(form); !words.empty()) return {{"enum", words}};
  std::smatch limits;
  if (std::regex_match(form, limits, std::regex("whole number from (\\d+) to (\\d+)")))
    return {{"type", "integer"}, {"minimum", std::stoi(limits[1])}, {"maximum", std::stoi(limits[2])}};
  // YAML of version 1.1 takes 1e-6 for a text.
  if (form.starts_with("number"))
    return {{"anyOf", {{{"type", "number"}}, {{"type", "string"}, {"pattern", number_pattern + "$"}}}}};
  if (form.starts_with("[") || form.starts_with("list of")) return {{"type", "array"}};
  if (form.starts_with("map of")) return {{"type", "object"}};
  return Json::object();
}

/// The part of the schema at a key path, made where it is not yet; `last` is the key in it.
Json& place(Json& schema, const std::string& path)
{
  Json* at = &schema;
  const std::regex step("[^.\\[\\]]+");
  for (std::sregex_iterator found(path.begin(), path.end(), step), end; found != end; ++found)
  {
    const std::string name = found->str();
    Json& node = *at;
    if (name == "N")
      at = &(node["items"]);
    else if (name == "NAME")
      at = &(node["additionalProperties"] = node.value("additionalProperties", Json::object()));
    else
    {
      node["type"] = "object";
      if (!node.contains("additionalProperties")) node["additionalProperties"] = false;
      at = &(node["properties"][name]);
    }
    if (at->is_null()) *at = Json::object();
  }
  return *at;
}

/// A key that is a word or a map of keys may be either.
void allow_words(Json& node, const std::string& word)
{
  Json map;
  for (const char* part : {"type", "additionalProperties", "properties"})
    if (node.contains(part))
    {
      map[part] = node[part];
      node.erase(part);
    }
  node["anyOf"] = {{{"const", word}}, map};
}
} // namespace

std::string case_schema()
{
  Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "case of seismpm"}};
  const std::vector<KeyDescription> keys = case_keys();
  for (const KeyDescription& key : keys)
  {
    Json& node = place(schema, key.path);
    node["description"] = key.form + "; " +
                          (key.otherwise.empty() ? "required" : "default: " + key.otherwise) + ". " +
                          key.meaning;
    node.update(value_of(key.form));
  }
  for (const KeyDescription& key : keys)
    if (const auto comma = key.form.find(", or a map of the keys below"); comma != std::string::npos)
      allow_words(place(schema, key.path), key.form.substr(0, comma));
  return schema.dump(2) + "\n";
}
} // namespace mpm
