#pragma once
// The verification ladder: cases with closed forms, run at growing resolution against stated bounds.
//
// A case is a folder cases/verification/NAME (README.md with the closed form, ladder.yaml with resolutions,
// norms and bounds, case and reference values) and a function that runs it at one resolution, named in
// cases.cpp.

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mpm::verification
{
/// Settings of the paper's method, as of `--set`: affine transfer, sharp interfaces, lumped mass, and ground
/// that softens particle by particle.
inline std::vector<std::string> papers_method()
{
  return {"seismic.transfer=apic", "grid.interfaces=sharp", "seismic.inertia=lumped", "grid.softening=local"};
}

/// What the model found over what it should have found, for a plot.
struct Curve
{
  std::string name;
  std::string x_label, y_label; ///< with units
  std::vector<double> x, model, reference;
};

/// A case run at one resolution: an error for each measure of its ladder.yaml, and curves.
struct Findings
{
  std::map<std::string, double> errors;
  std::vector<Curve> curves;
};

/// Runs a case at one resolution; `folder` is the case's.
using Runner = Findings (*)(const std::filesystem::path& folder, double resolution);

struct LadderCase
{
  std::string_view name; ///< folder in cases/verification
  Runner run;
};

/// All cases, from the kernel upwards (cases.cpp).
std::span<const LadderCase> ladder_cases();
/// Throws std::runtime_error where there is no such case.
const LadderCase& ladder_case(std::string_view name);

/// A number that is asked of an error or of its order.
struct Bound
{
  double value;
  bool after_measurement = false; ///< it was set when the result was known
};

/// An error that a case measures, and what is asked of it.
struct Measure
{
  std::string name;
  std::string norm;               ///< in words
  std::map<double, Bound> bounds; ///< greatest error, by resolution
  std::optional<Bound> order;     ///< least observed order between the two finest resolutions run,
  double order_down_to = 0;       ///< but none finer than this
};

/// ladder.yaml of a case.
struct Ladder
{
  std::string name, title;
  std::string resolution;    ///< what the resolution is, with unit
  std::vector<double> quick; ///< resolutions of the default tests, coarse to fine
  std::vector<double> full;  ///< resolutions of the whole ladder, coarse to fine
  std::vector<Measure> measures;
  std::filesystem::path folder;
};

/// Reads NAME/ladder.yaml of a folder of cases. Throws Error with all that is wrong.
Ladder load_ladder(std::string_view name, const std::filesystem::path& cases);

/// One line of the table.
struct Row
{
  std::string name, measure;
  double resolution;
  double error;
  double order;                            ///< observed from the resolution before; NaN at the first
  std::optional<Bound> bound, least_order; ///< where the ladder states them
  double seconds;                          ///< wall time of the run

  bool pass() const;
};

struct Result
{
  Ladder ladder;
  std::vector<Row> rows;                        ///< measure by measure, coarse to fine
  std::vector<std::pair<double, Curve>> curves; ///< with their resolutions
};

/// Runs a case at the given resolutions (coarse to fine).
Result climb(const LadderCase& ladder_case, const Ladder& ladder, std::span<const double> resolutions);

/// Columns of a CSV file with a line of names; lines that begin with # are remarks. Throws
/// std::runtime_error.
std::map<std::string, std::vector<double>> read_table(const std::filesystem::path& path);
} // namespace mpm::verification
