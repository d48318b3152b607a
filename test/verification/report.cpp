#include "test/verification/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace mpm::verification
{
namespace
{
std::ofstream open(const std::filesystem::path& folder, const char* name)
{
  std::filesystem::create_directories(folder);
  std::ofstream file(folder / name);
  if (!file) throw std::runtime_error((folder / name).string() + ": cannot be written");
  return file;
}

std::string text_of(const std::optional<Bound>& bound)
{
  return bound ? fmt::format("{:.3g}{}", bound->value, bound->after_measurement ? " *" : "") : "";
}

std::string order_text(const Row& row)
{
  if (!std::isfinite(row.order)) return "";
  const std::string order = fmt::format("{:.2f}", row.order);
  return row.least_order ? order + " (at least " + text_of(row.least_order) + ")" : order;
}
} // namespace

std::string table_line(const Row& row)
{
  return fmt::format("| {} | {} | {:g} | {:.2e} | {} | {} | {} |", row.name, row.measure, row.resolution,
                     row.error, order_text(row), text_of(row.bound), row.pass() ? "yes" : "**no**");
}

void write_table(const std::filesystem::path& folder, const std::vector<Result>& results)
{
  std::ofstream file = open(folder, "RESULTS.md");
  file << "# Results of the verification ladder\n\n"
          "Written by `scripts/verify`. Closed forms, norms and the reasons of the bounds stand in each "
          "case's README. An\n"
          "order is observed between a row and the one above it; where an order is asked for, it is asked of "
          "the finest\n"
          "pair, or of the finest above a floor that the README explains. Numbers marked * were set after "
          "the measurement.\n"
          "\n"
          "| case | measure | resolution | error | order | bound | pass |\n"
          "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Result& result : results)
    for (const Row& row : result.rows) file << table_line(row) << '\n';
  file << "\n## Norms\n";
  for (const Result& result : results)
  {
    file << fmt::format("\n**[{0}]({0}/README.md)**: {1}. Resolution: {2}.\n\n", result.ladder.name,
                        result.ladder.title, result.ladder.resolution);
    for (const Measure& measure : result.ladder.measures)
      file << fmt::format("- {}: {}\n", measure.name, measure.norm);
  }
}

void write_curves(const std::filesystem::path& folder, const std::vector<Result>& results)
{
  nlohmann::json all = nlohmann::json::array();
  for (const Result& result : results)
  {
    nlohmann::json one{{"name", result.ladder.name},
                       {"title", result.ladder.title},
                       {"resolution", result.ladder.resolution}};
    for (const Row& row : result.rows)
      one["rows"].push_back({{"measure", row.measure},
                             {"resolution", row.resolution},
                             {"error", row.error},
                             {"bound", row.bound ? row.bound->value : NAN},
                             {"order", row.order},
                             {"seconds", row.seconds},
                             {"pass", row.pass()}});
    one["curves"] = nlohmann::json::array();
    for (const auto& [resolution, curve] : result.curves)
      one["curves"].push_back({{"name", curve.name},
                               {"resolution", resolution},
                               {"x_label", curve.x_label},
                               {"y_label", curve.y_label},
                               {"x", curve.x},
                               {"model", curve.model},
                               {"reference", curve.reference}});
    all.push_back(one);
  }
  open(folder, "results.json") << all.dump(1) << '\n';
}
} // namespace mpm::verification
