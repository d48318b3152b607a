// The motion that a run applies is the one that it reports.

#include "test/read_json.hpp"
#include "test/stages/block.hpp"
#include "test/stages/results.hpp"

#include <sstream>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
std::vector<double> values_of(const std::string& text)
{
  std::istringstream lines(text);
  std::vector<double> values;
  for (double value = 0; lines >> value;) values.push_back(value);
  return values;
}
} // namespace

TEST_CASE("the history holds the upgoing acceleration at the record's step, whatever the gauges'", "[stages]")
{
  const Block b;
  const auto record = values_of(contents(b / "shake.txt"));
  for (const std::string every : {"0.01 s", "0.1 s", "0.013 s"})
  {
    REQUIRE(b.run(every, {"--set", "seismic.duration=1.5 s", "--set", "output.gauges.every=" + every}).code ==
            0);
    const fs::path history = b / every / "history.h5";
    const auto time = open_complete(history).read_doubles("motion/time");
    const auto acceleration = horizontal(history, "upgoing_acceleration"),
               velocity = horizontal(history, "upgoing_velocity");
    REQUIRE(time.size() == 151);
    double v = 0; // trapezoidal, of half the record
    for (std::size_t i = 0; i < time.size(); ++i)
    {
      const double a = i < record.size() ? 0.5 * record[i] : 0;
      if (i > 0 && i < record.size()) v += 0.005 * (a + 0.5 * record[i - 1]);
      CHECK(time[i] == Approx(0.01 * double(i)));
      REQUIRE(acceleration[i] == Approx(a).margin(1e-12));
      REQUIRE(velocity[i] == Approx(v).margin(1e-12));
    }
  }
  CHECK(open_complete(b / "0.1 s/history.h5").attribute_string("recorded_as", "motion") == "outcrop");
}

TEST_CASE("two records of different steps are both held sample by sample", "[stages]")
{
  const Block b;
  put(b / "up.txt", sine(3, 5)); // as 4 ms: 0.48 s
  REQUIRE(b.run("out", {"--motion", b / "shake.txt", "--vertical", b / "up.txt", "--record-dt", "0.004",
                        "--record-unit", "m/s2"})
              .code == 0);
  put(b / "case.yaml", block + "profiles: {both: {seismic.motion.vertical: {file: up.txt, format: column, "
                               "dt: 0.004 s, unit: m/s2}}}\n");
  const Ending ending = b.run("both", {"--profile", "both"});
  INFO(ending.said);
  REQUIRE(ending.code == 0);
  const h5::File history = open_complete(b / "both/history.h5");
  const auto time = history.read_doubles("motion/time"),
             a = history.read_doubles("motion/upgoing_acceleration");
  CHECK(time[1] == Approx(0.002));
  const auto across = values_of(contents(b / "shake.txt")), up = values_of(contents(b / "up.txt"));
  for (std::size_t i = 0; i <= 60; ++i) REQUIRE(a[2 * 5 * i] == Approx(0.5 * across[i]).margin(1e-12));
  for (std::size_t i = 0; i <= 120; ++i) REQUIRE(a[2 * 2 * i + 1] == Approx(0.5 * up[i]).margin(1e-12));
}

TEST_CASE("one record in both directions is warned of, however it is scaled", "[stages]")
{
  const Block b;
  put(b / "twice.txt", sine(2, 5));
  put(b / "once.txt", sine(1, 5));
  put(b / "other.txt", sine(1, 7));
  const auto said = [&](const std::string& vertical)
  {
    const Ending ending = b.run("with-" + vertical, {"--motion", b / "twice.txt", "--vertical", b / vertical,
                                                     "--record-dt", "0.01", "--record-unit", "m/s2"});
    REQUIRE(ending.code == 0);
    return ending.said;
  };
  CHECK_THAT(said("once.txt"), Contains("horizontal and vertical are the same record"));
  CHECK_THAT(said("other.txt"), !Contains("the same record"));
}

TEST_CASE("a run reports what it applies of a record that goes on longer, and warns", "[stages]")
{
  const Block b;
  const auto record = values_of(contents(b / "shake.txt"));
  const Ending cut_short = b.run("cut", {"--set", "seismic.duration=0.4 s"});
  REQUIRE(cut_short.code == 0);
  const auto motion = b.summary("cut")["motion"]["horizontal"];
  CHECK(motion["applied"]["pga"].get<double>() == Approx(greatest(record, 41)));
  CHECK(motion["corrected"]["pga"].get<double>() == Approx(greatest(record, 121)));
  CHECK(2 * greatest(horizontal(b / "cut/history.h5", "upgoing_acceleration"), 1000) ==
        Approx(motion["applied"]["pga"].get<double>()).epsilon(1e-12));
  double within = 0, all = 0; // trapezoidal: ends are 0 or half
  for (std::size_t i = 1; i < record.size(); ++i)
  {
    const double piece = record[i - 1] * record[i - 1] + record[i] * record[i];
    all += piece;
    if (i <= 40) within += piece;
  }
  CHECK(motion["arias_share_beyond_end"].get<double>() == Approx(1 - within / all));
  CHECK_THAT(b.summary("cut")["warnings"].dump(),
             Contains("beyond the end of the run at 0.4 s") && Contains("record + 10 s"));
  CHECK_THAT(cut_short.said,
             Contains("as applied until 0.4 s: PGA") && Contains("beyond the end of the run"));
  REQUIRE(b.run("whole", {"--set", "seismic.duration=1.3 s"}).code == 0);
  CHECK_THAT(b.summary("whole")["warnings"].dump(), !Contains("beyond the end") && !Contains("correction"));
  CHECK(b.summary("whole")["motion"]["horizontal"]["applied"]["pga"].get<double>() ==
        Approx(greatest(record, 121)));
}

TEST_CASE("a run that goes on for some time after its record follows the record it is given", "[stages]")
{
  const Block b;
  put(b / "long.txt", contents(b / "shake.txt") + contents(b / "shake.txt"));
  const Arguments after{"--set", "seismic.duration=record + 0.3 s"};
  REQUIRE(b.run("own", after).code == 0);
  CHECK(b.summary("own")["time"].get<double>() == Approx(1.5));
  Arguments other = b.record("long.txt");
  other.insert(other.end(), after.begin(), after.end());
  REQUIRE(b.run("long", other).code == 0);
  CHECK(b.summary("long")["time"].get<double>() == Approx(2.71));
  other[0] = "--vertical"; // beside the case's own, which is shorter
  REQUIRE(b.run("both", other).code == 0);
  CHECK(b.summary("both")["time"].get<double>() == Approx(2.71));
  const Ending same = b.run("own", {"--set", "seismic.duration=1.5 s"});
  CHECK(same.code == 0);
  CHECK_THAT(same.said, Contains("finished already"));
  CHECK(b.run("own", {"--set", "seismic.duration=record + 0.4 s"}).code == 73);
  const Ending check = b.run("x", {"--check", "--set", "seismic.duration=record"});
  CHECK(check.code == 0);
  CHECK_THAT(check.said, Contains("for 1.2 s"));
}

TEST_CASE("the end of a run is a frame and a sample of the slide, whatever their intervals", "[stages]")
{
  const Block b;
  REQUIRE(b.run("out", {"--set", "seismic.duration=0.57 s"}).code == 0);
  const auto series = read_json(b / "out/frames.hdf.series");
  CHECK(series["files"].size() == 4); // 0, 0.25, 0.5 and the end
  CHECK(series["files"].back()["time"].get<double>() == Approx(0.57));
  CHECK(open_complete(b / "out/history.h5").read_doubles("slide/time").back() == Approx(0.57));
  REQUIRE(b.run("even", {"--set", "seismic.duration=0.5 s"}).code == 0);
  CHECK(read_json(b / "even/frames.hdf.series")["files"].size() == 3);
}

TEST_CASE("a folder belongs to the motion as applied, not to the name of its record", "[stages]")
{
  const Block b;
  put(b / "copy.txt", contents(b / "shake.txt"));
  REQUIRE(b.run("a").code == 0);
  const Ending copy = b.run("a", b.record("copy.txt"));
  CHECK(copy.code == 0);
  CHECK_THAT(copy.said, Contains("finished already"));
  for (const Arguments& other :
       {b.record("copy.txt", "gal"), b.record("copy.txt", "m/s2", "0.02"), Arguments{"--scale", "2"},
        Arguments{"--set", "seismic.motion.recorded_as=upgoing"},
        Arguments{"--set", "seismic.motion.baseline=cubic"},
        Arguments{"--set", "seismic.motion.horizontal.unit=gal"}})
  {
    const Ending ending = b.run("a", other);
    INFO(other[0] << " " << other[1] << "\n" << ending.said);
    CHECK(ending.code == 73);
    CHECK_THAT(ending.said, Contains("motion."));
  }
  const Ending ended = b.run("a", {"--set", "seismic.motion.end=0.5 s"});
  CHECK(ended.code == 73);
  CHECK_THAT(ended.said, Contains("seismic.motion.end"));
}

TEST_CASE("a motion that is ended is reported as it fades", "[stages]")
{
  const Block b;
  REQUIRE(b.run("out", {"--set", "seismic.motion.end=0.55 s", "--set", "seismic.duration=1.3 s"}).code == 0);
  const auto motion = b.summary("out")["motion"]["horizontal"];
  const auto a = horizontal(b / "out/history.h5", "upgoing_acceleration");
  CHECK(motion["applied"]["pga"].get<double>() == Approx(2 * greatest(a, a.size())).epsilon(1e-12));
  CHECK(motion["applied"]["pga"].get<double>() < 0.9 * motion["corrected"]["pga"].get<double>());
  CHECK(motion["arias_share_beyond_end"].get<double>() == 0);
  for (std::size_t i = 56; i < a.size(); ++i) REQUIRE(a[i] == Approx(0).margin(1e-12));
  const Ending late = b.run("late", {"--set", "seismic.motion.end=0.7 s"});
  CHECK_THAT(late.said, Contains("seismic.motion.end: 0.7 s is after the end of the run at 0.6 s"));
}

TEST_CASE("twice a faint motion is twice the answer of elastic ground", "[stages]")
{
  const Block b;
  // Particles move by 1e-7 of a cell, and by as much the answer may differ; it is 3e-8.
  REQUIRE(b.run("once", {"--scale", "1e-6"}).code == 0);
  REQUIRE(b.run("twice", {"--scale", "2e-6"}).code == 0);
  for (const char* series : {"gauges/displacement", "gauges/velocity"})
  {
    const auto once = open_complete(b / "once/history.h5").read_doubles(series),
               twice = open_complete(b / "twice/history.h5").read_doubles(series);
    REQUIRE(once.size() == twice.size());
    const double peak = greatest(twice, twice.size());
    CHECK(peak > 0);
    double apart = 0;
    for (std::size_t k = 0; k < once.size(); ++k) apart = std::max(apart, std::abs(twice[k] - 2 * once[k]));
    CHECK(apart < 1e-7 * peak);
  }
}
