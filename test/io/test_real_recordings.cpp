// Recordings of real earthquakes, which are not ours to give. The environment variable SEISMPM_RECORDINGS
// names a folder that holds them; a test whose files are not all there says that it was skipped, and ctest
// counts it so.
//
// RSN numbers are those of PEER's NGA-West2 data base, https://ngawest2.berkeley.edu.

#include "test/io/record_texts.hpp"

#include <cstdlib>
#include <filesystem>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// Path of a recording, or nothing where there is none.
std::string recording(const std::string& file)
{
  const char* folder = std::getenv("SEISMPM_RECORDINGS");
  if (!folder) return {};
  const std::filesystem::path path = std::filesystem::path(folder) / file;
  return std::filesystem::exists(path) ? path.string() : std::string{};
}

/// Whether one of the files is missing; if so, says it in the words that ctest looks for (CMakeLists.txt).
template <class Table>
bool skipped(const Table& table)
{
  std::string missing;
  for (const auto& known : table)
    if (recording(known.file).empty()) missing += " " + known.file;
  if (missing.empty()) return false;
  WARN("skipped: SEISMPM_RECORDINGS names no folder with" << missing);
  return true;
}

double peak_of(const Record& record)
{
  double peak = 0;
  for (double value : record.values) peak = std::max(peak, std::abs(value));
  return peak;
}
} // namespace

TEST_CASE("real recordings have the peaks, times and durations they are known for", "[io]")
{
  struct Known
  {
    std::string file;
    double dt;
    bool dt_in_file;
    std::size_t count;
    double pga, pga_time, pgv, pgv_rounding; ///< g, s, m/s
  };
  const std::vector<Known> table{
      {"LomaPrieta1989_G06-090.txt", .005, false, 7758, .170, 4.63, .142, 5e-4},     // RSN 769
      {"ImperialValley1979_CHI-282.txt", .01, false, 3879, .254, 11.94, .298, 5e-4}, // RSN 165
      {"RSN1231_CHICHI_CHY080-E.AT2", .005, true, 18000, .809, 38.0, 1.07, 5e-3},
      {"RSN1231_CHICHI_CHY080-N.AT2", .005, true, 18000, .860, 38.0, .93, 5e-3},
      {"RSN1231_CHICHI_CHY080-V.AT2", .005, true, 18000, .730, 38.0, .41, 5e-3},
      {"ElCentro1940.AT2", .02, true, 1559, .319, NAN, .36, 5e-3},
  };
  if (skipped(table)) return;
  for (const Known& known : table)
  {
    INFO(known.file);
    const auto record = read_record({recording(known.file), "auto", known.dt_in_file ? NAN : known.dt,
                                     known.dt_in_file ? "" : "g", Quantity::acceleration});
    CHECK(record.dt == known.dt);
    CHECK(record.values.size() == known.count);
    MotionProcessing raw;
    raw.baseline = Baseline::none;
    const auto report = make_ground_motion(record, raw).report;
    CHECK(report.corrected.pga / standard_gravity ==
          Approx(known.pga).margin(5e-4)); // the table's last digit
    if (!std::isnan(known.pga_time)) CHECK(report.corrected.pga_time == Approx(known.pga_time).margin(0.1));
    CHECK(report.corrected.pgv == Approx(known.pgv).margin(known.pgv_rounding));
    const auto processed = make_ground_motion(record, {});
    CHECK(processed.velocity.back() == 0);
    CHECK(processed.report.warnings.empty());
  }
}

TEST_CASE("real files of archives have the peaks that their headers state", "[io]")
{
  struct Known
  {
    std::string file, component, name;
    std::size_t count;
    double dt, pga; ///< m/s2
  };
  const std::vector<Known> table{
      {"formats/0111a.smc", "", "360", 6001, .005, 1.0441},
      {"formats/2-ECU.dat", "N", "N", 6000, .02, .02931},
      {"formats/20180212_211557_WPWS_20.V2A", "S74E", "S74E", 5800, .02, .1940},
      {"formats/AOM0011801241951.EW", "", "E-W", 10200, .01, .04078},
      {"formats/AICH040010061330.EW2", "", "E-W", 28600, .005, .03896},
      {"formats/Cosmos12TimeSeriesTest.v1", "", "1: 340 deg", 7000, .01, 1.61962},
  };
  if (skipped(table)) return;
  for (const Known& known : table)
  {
    INFO(known.file);
    const Record record = read_record({.file = recording(known.file), .component = known.component});
    CHECK(record.component == known.name);
    CHECK(record.values.size() == known.count);
    CHECK(record.dt == Approx(known.dt).epsilon(1e-15));
    // half of the last digit of CWB's and K-NET's headers
    CHECK(peak_of(record) == Approx(known.pga).margin(6e-6));
  }
}
