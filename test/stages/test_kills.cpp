// Runs that are killed, or whose disk fails, at any of their calls of the file system; and files of which a
// bit has flipped. Whatever happens, the same command again ends with the results of a run that nothing
// befell, or says why not. A part of the whole campaign, which is test/campaign/campaign.py.

#include "test/read_json.hpp"
#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

#include <random>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
const Arguments brief{"--set", "seismic.duration=0.15 s", "--set", "output.checkpoint.every=10 min"};
const Arguments often{"--set", "seismic.duration=0.15 s", "--set", "output.checkpoint.every=1 ms"};
const std::vector<std::string> modes{"kill", "torn", "EIO", "ENOSPC", "EROFS"};

Arguments with(Arguments first, const Arguments& more)
{
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

/// While it lives, programs that are started meet a fault at call `at` in `folder`.
class Fault
{
public:
  Fault(const fs::path& folder, int at, const std::string& mode, const fs::path& count)
  {
    set("FAULT_FOLDER", folder);
    set("FAULT_AT", std::to_string(at));
    set("FAULT_MODE", mode);
    set("FAULT_COUNT", count);
    set("ASAN_OPTIONS", "verify_asan_link_order=0");
    set("LD_PRELOAD", std::string(BINARY_DIR) + "/libseismpm-faults.so");
  }
  ~Fault()
  {
    for (const char* name : names_) unsetenv(name);
  }

private:
  void set(const char* name, const std::string& value)
  {
    setenv(name, value.c_str(), 1);
    names_.push_back(name);
  }
  std::vector<const char*> names_;
};

/// The cut with its static state, its results, and folders to be hurt: `start` as a run begins in them.
struct Campaign : Bench
{
  Campaign()
  {
    make_static();
    REQUIRE(run_seismic("whole", brief).code == 0);
    REQUIRE(run_seismic("other", other).code == 0);
    fs::create_directory(*this / "empty");
  }
  const Arguments other = with(brief, {"--set", "seismic.filter.time=2 s"});

  Ending with_fault(const Arguments& arguments, int at, const std::string& mode) const
  {
    fs::remove(*this / "count");
    const Fault fault(*this / "hurt", at, mode, *this / "count");
    return run("mpm-seismic", arguments);
  }
  void begin(const std::string& start) const
  {
    fs::remove_all(*this / "hurt");
    fs::copy(*this / start, *this / "hurt");
  }
  int calls(const std::string& start, const Arguments& more) const
  {
    begin(start);
    REQUIRE(with_fault(seismic_arguments("hurt", more), 0, "kill").code == 0);
    int count = 0;
    contents(*this / "count").copy(reinterpret_cast<char*>(&count), sizeof count);
    return count;
  }
  /// The folder holds a finished run with the results of `whole`, and says so.
  void check_finished(const std::string& whole, const Arguments& more) const
  {
    for (const auto& entry : fs::directory_iterator(*this / "hurt"))
      if (entry.path().extension() == ".unusable") fs::remove(entry.path());
    check_same_results(*this / whole, *this / "hurt");
    const auto summary = read_json(*this / "hurt/summary.json"),
               expected = read_json(*this / whole / "summary.json");
    for (const char* key : {"exit", "time", "steps", "dt", "slide", "gauges", "energy", "warnings"})
      CHECK(summary.at(key) == expected.at(key));
    CHECK_THAT(run_seismic("hurt", more).said, Contains("finished already"));
    CHECK(checkpoints(*this / "hurt").empty());
  }

  /// A fault at call `at`, then the same again.
  void hurt_and_go_on(const std::string& start, const Arguments& more, int at, const std::string& mode) const
  {
    begin(start);
    const Ending hurt = with_fault(seismic_arguments("hurt", more), at, mode);
    const Ending again = run_seismic("hurt", more);
    INFO(mode << " at call " << at << " of a run from '" << start << "'\n"
              << hurt.said << "\nthen\n"
              << again.said);
    CHECK((hurt.code == -SIGKILL || hurt.code == 74 || hurt.code == 0));
    CHECK((mode[0] == 'E' || hurt.code == -SIGKILL));
    REQUIRE(again.code == 0);
    check_finished("whole", brief);
  }
  /// A fault at call `at` of a new start over another run's results; then that other run again.
  void hurt_and_go_back(int at, const std::string& mode) const
  {
    begin("other");
    const Ending hurt = with_fault(seismic_arguments("hurt", with(brief, {"--fresh"})), at, mode);
    const Ending again = run_seismic("hurt", other);
    INFO(mode << " at call " << at << " of a new start\n" << hurt.said << "\nthen\n" << again.said);
    CHECK((again.code == 0 || again.code == 73));
    if (again.code == 0) check_finished("other", other);
  }
};

void every(const Campaign& bench, int stride)
{
  const Arguments fresh = with(brief, {"--fresh"});
  int k = 0;
  for (int at = 1, last = bench.calls("empty", brief); at <= last; at += stride)
    bench.hurt_and_go_on("empty", brief, at, modes[k++ % modes.size()]);
  for (int at = 1, last = std::min(40, bench.calls("other", fresh)); at <= last; at += stride)
  {
    bench.hurt_and_go_on("other", fresh, at, modes[k % modes.size()]);
    bench.hurt_and_go_back(at, modes[k++ % modes.size()]);
  }
}
} // namespace

TEST_CASE("a run that dies or whose disk fails at any call ends right when it is started again", "[stages]")
{
  every(Campaign(), 13);
}

namespace
{
/// Flips a bit of the file, seeded; HDF5's metadata, which is little, as often as the data.
void flip(const fs::path& file, std::mt19937& random)
{
  std::string bytes = contents(file);
  const std::size_t most = random() % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 60'000);
  const std::size_t at = std::uniform_int_distribution<std::size_t>(0, most - 1)(random);
  bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
  put(file, bytes);
}
} // namespace

TEST_CASE("a flipped bit in a state is told, and changes no result", "[stages]")
{
  const Campaign bench;
  std::mt19937 random(1906);
  kill_after_checkpoints(bench, "mpm-seismic", bench.seismic_arguments("stopped", often), bench / "stopped",
                         2);
  for (int k = 0; k < 8; ++k)
  {
    bench.begin(k % 2 ? "stopped" : "whole");
    if (k % 2 == 0) fs::remove(bench / "hurt/finished.json"); // the final state is to go on from
    flip(k % 2 ? checkpoints(bench / "hurt").back() : bench / "hurt/final.h5", random);
    const Ending again = bench.run_seismic("hurt", brief);
    INFO("flip " << k << "\n" << again.said);
    REQUIRE(again.code == 0);
    CHECK_THAT(again.said, Contains("trying an older one"));
    for (const auto& entry : fs::directory_iterator(bench / "hurt"))
      if (entry.path().extension() == ".unusable") fs::remove(entry.path());
    check_same_results(bench / "whole", bench / "hurt");
  }
}
