#include "solver/stages/resolved_case.hpp"

#include "io/case/units.hpp"
#include "solver/stages/identity.hpp"
#include "solver/stages/version.hpp"

#include <fmt/format.h>

namespace mpm
{
namespace
{
/// Puts a record of the command line instead of the case's.
void replace_record(Settings& settings, const Case& case_file, const std::string& record,
                    const std::string& file, const std::string& component, const Options& options)
{
  for (const auto& [path, value] : case_file.settings)
    if (path.starts_with(record)) settings.drop(path);
  settings.set(record + ".file", std::filesystem::absolute(file).string());
  settings.set(record + ".format", options.record_format.empty() ? "auto" : options.record_format);
  if (std::isfinite(options.record_dt))
    settings.set(record + ".dt", quantity_text(options.record_dt, Dimension::time));
  if (!options.record_unit.empty()) settings.set(record + ".unit", options.record_unit);
  if (!component.empty()) settings.set(record + ".component", component);
  settings.set(record + ".scale", "1");
}
} // namespace

std::string resolved_case(const Case& case_file, const Options& options)
{
  Settings settings;
  for (const auto& [key, value] : case_file.settings) settings.set(key, value);
  for (const auto& [key, file, component] :
       {std::tuple{horizontal_record, &options.motion, &options.record_component},
        std::tuple{vertical_record, &options.vertical, &options.vertical_component}})
  {
    const std::string record(key);
    if (!file->empty()) replace_record(settings, case_file, record, *file, *component, options);
    for (const auto& [path, value] : settings.entries())
      if (path == record + ".scale") settings.set(path, number_text(std::stod(value) * options.scale));
  }
  std::string heading =
      fmt::format("# every default written out by {} {}\n", options.program, version::number);
  for (const std::string& reason : case_file.chosen)
    heading += fmt::format("# profile {}: {}\n", case_file.profile, reason);
  return heading + to_yaml(settings.entries());
}
} // namespace mpm
