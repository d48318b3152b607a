// Records as files: one for every layout that is read, and some that are refused. All were made for these
// tests: wave packets of 400 values at 0.01 s, of 80 cm/s2 in the archives' layouts, of 0.1 g in shake.acc
// and of 0.2 g in the others.

#include "test/io/record_samples.hpp"
#include "test/io/record_texts.hpp"

using namespace mpm;
using namespace mpm::test;
using Catch::Contains;

namespace
{
const std::string folder = SOURCE_DIR "/test/io/records/";

/// A file, what the case says of it, and what is to come out: the greatest magnitude in SI, rounded as
/// stated.
struct Known
{
  RecordSource source;
  std::string format;
  double peak, rounding;
  Quantity quantity = Quantity::acceleration;
};

RecordSource file(const std::string& name, const std::string& component = "")
{
  return {.file = folder + name, .component = component};
}

RecordSource of_unit(RecordSource source, const std::string& unit, double dt = NAN)
{
  source.unit = unit;
  source.dt = dt;
  return source;
}

RecordSource of_format(RecordSource source, const std::string& format)
{
  source.format = format;
  return source;
}

double peak_of(const Record& record)
{
  double peak = 0;
  for (double value : record.values) peak = std::max(peak, std::abs(value));
  return peak;
}
} // namespace

TEST_CASE("a file of every layout is read from disk", "[io]")
{
  const double packet = std::abs(sample_peak()) / 100, g = standard_gravity;
  const std::vector<Known> table{
      {file("peer_nga.AT2"), "peer", packet, 1e-6},
      {file("peer_smd.txt"), "peer", packet, 1e-6},
      {file("column.txt"), "column", packet, 1e-6},
      {file("two_column.csv", "NS"), "two_column", packet, 1e-6},
      {of_unit(of_format(file("shake.acc"), "shake"), "g", 0.01), "shake", .092236 * g, 1e-6},
      {file("knet.EW"), "knet", packet, 2e-3}, // its mean is taken off
      {file("esm.HNE.ASC"), "esm", packet, 1e-6},
      {file("smc.smc"), "smc", packet, 1e-5},
      {file("cosmos.V2c", "340 deg"), "cosmos", packet, 1e-6},
      {file("csmip.V1"), "csmip", packet, 1e-5},
      {file("csmip.V2", "H1"), "csmip", packet, 1e-6},
      {file("cwb.dat", "U"), "cwb", packet, 1e-5},
      {file("geonet.V2A", "S16W"), "geonet", packet, 1e-4},
      {file("bhrc.V1", "L1"), "bhrc", packet, 1e-6},
      {file("unit_tenth_of_g.AT2"), "peer", .2 * g, 5e-4 * g},
      {file("unit_superscript.AT2"), "peer", .2 * g, 5e-4 * g},
      {file("step_in_ms.AT2"), "peer", .2 * g, 5e-4 * g},
      {file("unit_in_comment.csv"), "two_column", .2 * g, 5e-4 * g},
      {of_unit(file("count_first.txt"), "g", 0.01), "column", .2 * g, 5e-4 * g},
      {of_unit(file("count_and_step_first.txt"), "g"), "column", .2 * g, 5e-4 * g},
  };
  for (const Known& known : table)
  {
    INFO(known.source.file);
    const Record record = read_record(known.source);
    CHECK(record.format == known.format);
    CHECK(record.quantity == known.quantity);
    CHECK(record.dt == Approx(0.01).epsilon(1e-12));
    CHECK(record.values.size() == 400);
    CHECK(peak_of(record) == Approx(known.peak).margin(known.rounding));
  }
}

TEST_CASE("a header's unit goes before the file's extension, and the word UNITS in a title is none", "[io]")
{
  const Record inches = read_record(file("unit_inches.VT2"));
  CHECK(inches.quantity == Quantity::velocity);
  const Record instrument = read_record(file("instrument_units.AT2"));
  CHECK(peak_of(instrument) == Approx(.11 * standard_gravity).margin(5e-4 * standard_gravity));
}

TEST_CASE("files that do not say one thing are refused, with their line", "[io]")
{
  const auto refused = [](const RecordSource& source, const std::string& why)
  {
    const Failure failure = failure_of([&] { read_record(source); });
    INFO(source.file);
    CHECK(failure.code == exit_code::bad_input);
    CHECK_THAT(failure.message, Contains(why));
  };
  refused(file("three_columns.AT2"), "three_columns.AT2:4: holds 400 lines of 3 numbers");
  refused(of_unit(file("index_column.csv"), "g"), "index_column.csv:1: calls the first column 'n'");
  refused(of_unit(file("nan_first.txt"), "g", 0.01), "nan_first.txt:1: expected numbers");
  refused(of_unit(file("unit_in_comment.csv"), "m/s2"), "unit_in_comment.csv:1: ");
  refused(file("cosmos.V2c"), "holds the components");
}
