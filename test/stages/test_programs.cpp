// The two programs from outside: what a script that starts, stops and repeats them may rely on.

#include "io/hdf5.hpp"
#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace
{
using Arguments = std::vector<std::string>;

/// A cut of 5 m in softening clay over rock; the clay yields under the motion. Checkpoints come several times
/// a run.
const std::string cut = R"(schema: seismpm-case/1
name: cut
grid: {spacing: 1 m, particles_per_cell: 2}
domain: {x: [0 m, 30 m], bottom: 0 m}
surfaces:
  rockhead: {points: [[0 m, 4 m], [30 m, 4 m]]}
  ground: {points: [[0 m, 14 m], [11 m, 14 m], [18 m, 9 m], [30 m, 9 m]]}
regions:
  - {material: clay, above: rockhead, below: ground}
  - {material: rock, below: rockhead}
materials:
  rock: {model: elastic, density: 2200 kg/m3, young_modulus: 250 MPa, poisson_ratio: 0.25}
  clay:
    model: von_mises
    density: 1800 kg/m3
    young_modulus: 40 MPa
    poisson_ratio: 0.35
    strength: {peak: 80 kPa, residual: 40 kPa}
    softening: {displacement: 0.2 m}
static:
  gravity: 9.81 m/s2
  ramp: 3 s
  until: {unbalanced: 1e-4, kinetic: 1e-8, at_most: 30 s}
seismic:
  duration: 1.2 s
  motion: {recorded_as: outcrop, horizontal: {file: shake.txt, format: column, dt: 0.01 s, unit: m/s2}}
output:
  frames: {every: 0.1 s}
  gauges: {points: {crest: [10.5 m, 14 m], toe: [18.5 m, 9 m]}}
  checkpoint: {every: 0.05 s, keep: 2}
)";

/// 1.2 s of a sine in m/s2 that grows and fades.
std::string sine(double amplitude, double frequency)
{
  std::string text;
  for (int k = 0; k <= 120; ++k)
  {
    const double t = 0.01 * k, envelope = std::pow(std::sin(std::numbers::pi * t / 1.2), 2);
    text += std::to_string(amplitude * envelope * std::sin(2 * std::numbers::pi * frequency * t)) + "\n";
  }
  return text;
}

/// How a program ended, and what it said.
struct Ending
{
  int code; ///< exit code; minus the number of the signal that killed it
  std::string said;
};

/// A program that runs beside the test; killed if the test leaves it behind.
class Running
{
public:
  /// No file that it writes may pass `most_bytes`, 0: no limit.
  Running(const std::string& program, Arguments arguments, const fs::path& said, rlim_t most_bytes = 0)
      : said_(said)
  {
    arguments.insert(arguments.begin(), std::string(BINARY_DIR) + "/" + program);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("cannot fork");
    if (pid_ > 0) return;
    setenv("OMP_WAIT_POLICY", "passive", 1); // two threads, and perhaps fewer processors
    const int file = open(said_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    if (most_bytes > 0)
    {
      const rlimit limit{most_bytes, most_bytes};
      setrlimit(RLIMIT_FSIZE, &limit);
      std::signal(SIGXFSZ, SIG_IGN); // then write() fails as it does on a full disk
    }
    execv(argv[0], argv.data());
    _exit(127);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running()
  {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  void signal(int number) const { kill(pid_, number); }

  Ending wait()
  {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), contents(said_)};
  }

  /// Until `happened`; false when the program ends before, or after a minute.
  bool wait_until(const std::function<bool()>& happened) const
  {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!happened())
    {
      siginfo_t info{};
      waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
      if (info.si_pid == pid_ || std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }

private:
  fs::path said_;
  pid_t pid_ = -1;
};

/// Paths of the checkpoints in a folder, oldest first.
std::vector<fs::path> checkpoints(const fs::path& folder)
{
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (const std::string name = entry.path().filename();
        name.starts_with("checkpoint-") && name.ends_with(".h5"))
      found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// The cut in a folder of its own, and the programs run on it.
class Bench
{
public:
  Bench()
  {
    put(folder_ / "case.yaml", cut);
    put(folder_ / "shake.txt", sine(12, 2));
  }
  fs::path operator/(const std::string& name) const { return folder_ / name; }
  std::string path(const std::string& name) const { return folder_ / name; }

  Arguments static_arguments(const std::string& out, const Arguments& more = {}) const
  {
    return joined({path("case.yaml"), "--out", path(out), "--threads", "1"}, more);
  }
  /// From the state in the folder `static`.
  Arguments seismic_arguments(const std::string& out, const Arguments& more = {}) const
  {
    return joined(
        {path("case.yaml"), "--from", path("static/final.h5"), "--out", path(out), "--threads", "1"}, more);
  }

  Ending run(const std::string& program, const Arguments& arguments, rlim_t most_bytes = 0) const
  {
    return Running(program, arguments, folder_ / "said.txt", most_bytes).wait();
  }
  Ending run_static(const std::string& out, const Arguments& more = {}) const
  {
    return run("mpm-static", static_arguments(out, more));
  }
  Ending run_seismic(const std::string& out, const Arguments& more = {}) const
  {
    return run("mpm-seismic", seismic_arguments(out, more));
  }
  void make_static() const
  {
    const Ending ending = run_static("static");
    INFO(ending.said);
    REQUIRE(ending.code == 0);
  }

private:
  /// The later of two `--threads` counts, as the caller's.
  static Arguments joined(Arguments first, const Arguments& more)
  {
    if (std::find(more.begin(), more.end(), "--threads") != more.end()) first.resize(first.size() - 2);
    first.insert(first.end(), more.begin(), more.end());
    return first;
  }
  TemporaryFolder folder_;
};

/// Every dataset below a group as path and bytes, in any type; and what the run remembers in attributes.
using Contents = std::map<std::string, std::string>;

std::string bytes(const std::vector<double>& values)
{
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

std::string dataset(const h5::Group& group, const std::string& name)
{
  std::string shape;
  for (const hsize_t extent : group.shape(name)) shape += std::to_string(extent) + " ";
  if (code_of([&] { group.read_doubles(name); }) == 0) return shape + bytes(group.read_doubles(name));
  if (code_of([&] { group.read_strings(name); }) == 0)
  {
    for (const std::string& text : group.read_strings(name)) shape += text + "\n";
    return shape;
  }
  return shape + group.read_text(name);
}

void collect(const h5::Group& group, const std::string& path, Contents& found)
{
  for (const char* name :
       {"step", "time", "dt", "start_time", "start_step", "drift", "plastic", "held", "unbalanced", "kinetic",
        "begin", "end", "gauge_time", "trigger_time", "since", "decided"})
    if (group.has_attribute(name)) found[path + "@" + name] = bytes(group.attribute_doubles(name));
  for (const std::string& name : group.children())
  {
    if (code_of([&] { group.open_group(name); }) == 0)
      collect(group.open_group(name), path + name + "/", found);
    else
      found[path + name] = dataset(group, name);
  }
}

Contents contents_of(const fs::path& file)
{
  Contents found;
  collect(open_complete(file), "/", found);
  return found;
}

/// What differs between two result files; empty: nothing.
std::string difference(const fs::path& one, const fs::path& other)
{
  const Contents a = contents_of(one), b = contents_of(other);
  std::string text;
  for (const auto& [path, value] : a)
    if (const auto same = b.find(path); same == b.end())
      text += path + " is missing\n";
    else if (same->second != value)
      text += path + " differs\n";
  for (const auto& [path, value] : b)
    if (!a.contains(path)) text += path + " is too many\n";
  return a.empty() ? "nothing to compare" : text;
}

/// Names of a folder's files that are results, without those that tell the time of day.
std::vector<std::string> result_files(const fs::path& folder)
{
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const fs::path path = entry.path(); path.extension() == ".h5" || path.extension() == ".hdf")
      names.push_back(path.filename());
  std::sort(names.begin(), names.end());
  return names;
}

void check_same_results(const fs::path& expected, const fs::path& actual)
{
  REQUIRE(result_files(actual) == result_files(expected));
  for (const std::string& name : result_files(expected))
  {
    INFO(name);
    CHECK(difference(expected / name, actual / name).empty());
  }
  CHECK(contents(actual / "frames.hdf.series") == contents(expected / "frames.hdf.series"));
}

double greatest_plastic_strain(const fs::path& final)
{
  double greatest = 0;
  for (const double strain : open_complete(final).read_doubles("materials/clay/plastic_strain"))
    greatest = std::max(greatest, strain);
  return greatest;
}

/// The ledgers of a seismic run: sampled from start to end, of all that there is, closed, and in the summary.
void check_ledger(const fs::path& folder, const std::vector<std::string>& groups)
{
  const h5::File history = open_complete(folder / "history.h5");
  for (const std::string& group : groups)
  {
    const auto last = [&](const std::string& term) { return history.read_doubles(group + term).back(); };
    CHECK(history.read_doubles(group + "time").size() == 13); // 1.2 s
    INFO(group << ": incoming " << last("incoming") << ", residual " << last("residual"));
    CHECK(last("incoming") > 0);
    CHECK(last("radiated_base") > 0.1 * last("incoming"));
    CHECK(last("plastic") > 0);
    CHECK(std::fabs(last("residual")) < 0.02 * std::max(last("incoming"), last("plastic")));
    const double sum = last("kinetic") + last("elastic") + last("gravitational") + last("plastic") +
                       last("transfer") + last("radiated_base") + last("radiated_sides") - last("incoming") -
                       last("free_field") - last("static_reaction");
    CHECK(last("residual") == Approx(sum).margin(1e-9 * last("incoming")));
  }
  CHECK_THAT(contents(folder / "summary.json"), Contains("\"left_column\"") && Contains("\"residual\""));
  CHECK_THAT(contents(folder / "log.txt"), Contains("energy in J/m: ") && !Contains("does not close"));
}

/// The ways in which a run may be cut short. Each leaves `out` to be gone on with.
void terminate(const Bench& bench, const std::string& program, const Arguments& arguments,
               const fs::path& out)
{
  Running running(program, arguments, bench / "said.txt");
  REQUIRE(running.wait_until([&] { return !checkpoints(out).empty(); }));
  running.signal(SIGTERM);
  const Ending ending = running.wait();
  INFO(ending.said);
  REQUIRE(ending.code == 75);
  CHECK_FALSE(fs::exists(out / "final.h5"));
}

void kill_after_checkpoints(const Bench& bench, const std::string& program, const Arguments& arguments,
                            const fs::path& out, std::size_t count)
{
  Running running(program, arguments, bench / "said.txt");
  REQUIRE(running.wait_until([&] { return checkpoints(out).size() >= count; }));
  running.signal(SIGKILL);
  REQUIRE(running.wait().code == -SIGKILL);
  CHECK_FALSE(fs::exists(out / "final.h5"));
}

void tear(const fs::path& file)
{
  fs::resize_file(file, fs::file_size(file) / 2);
}

void run_out_of_time(const Bench& bench, const std::string& program, Arguments arguments, const fs::path& out)
{
  arguments.insert(arguments.end(), {"--max-wall", "0.1 s"});
  const Ending ending = bench.run(program, arguments);
  INFO(ending.said);
  REQUIRE(ending.code == 75);
  CHECK_FALSE(checkpoints(out).empty());
}

/// The files of a folder and when they were written.
std::map<std::string, fs::file_time_type> times(const fs::path& folder)
{
  std::map<std::string, fs::file_time_type> all;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const std::string name = entry.path().filename(); name != "log.txt" && name != ".lock")
      all[name] = entry.last_write_time();
  return all;
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}
} // namespace

TEST_CASE("a static run that was cut short and resumed ends bit for bit as one that was not", "[stages]")
{
  const Bench bench;
  bench.make_static();
  for (const std::string threads : {"1", "2"})
  {
    const auto arguments = [&](const std::string& out) {
      return bench.static_arguments(out, {"--threads", threads});
    };
    const auto check_goes_on = [&](const std::string& out)
    {
      const Ending ending = bench.run("mpm-static", arguments(out));
      INFO(threads + " threads, " + out + "\n" + ending.said);
      REQUIRE(ending.code == 0);
      CHECK_THAT(ending.said, Contains("goes on from"));
      CHECK(difference(bench / "static/final.h5", bench / (out + "/final.h5")).empty());
      CHECK(checkpoints(bench / out).empty());
    };
    terminate(bench, "mpm-static", arguments("terminated" + threads), bench / ("terminated" + threads));
    check_goes_on("terminated" + threads);
    kill_after_checkpoints(bench, "mpm-static", arguments("killed" + threads), bench / ("killed" + threads),
                           1);
    check_goes_on("killed" + threads);
    run_out_of_time(bench, "mpm-static", arguments("stopped" + threads), bench / ("stopped" + threads));
    check_goes_on("stopped" + threads);
  }
}

TEST_CASE("a static run ends bit for bit the same on one thread and on two", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_static("two", {"--threads", "2"}).code == 0);
  CHECK(difference(bench / "static/final.h5", bench / "two/final.h5").empty());
}

TEST_CASE("a seismic run that was cut short and resumed ends bit for bit as one that was not", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("whole").code == 0);
  REQUIRE(greatest_plastic_strain(bench / "whole/final.h5") >
          0.01); // else the clay would have nothing to remember
  for (const std::string threads : {"1", "2"})
  {
    const auto arguments = [&](const std::string& out) {
      return bench.seismic_arguments(out, {"--threads", threads});
    };
    const auto check_goes_on = [&](const std::string& out)
    {
      const Ending ending = bench.run("mpm-seismic", arguments(out));
      INFO(threads + " threads, " + out + "\n" + ending.said);
      REQUIRE(ending.code == 0);
      CHECK_THAT(ending.said, Contains("goes on from"));
      check_same_results(bench / "whole", bench / out);
    };
    terminate(bench, "mpm-seismic", arguments("terminated" + threads), bench / ("terminated" + threads));
    check_goes_on("terminated" + threads);
    kill_after_checkpoints(bench, "mpm-seismic", arguments("killed" + threads), bench / ("killed" + threads),
                           1);
    check_goes_on("killed" + threads);
    run_out_of_time(bench, "mpm-seismic", arguments("stopped" + threads), bench / ("stopped" + threads));
    check_goes_on("stopped" + threads);
  }
}

TEST_CASE("a seismic run ends bit for bit the same on one thread and on two", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("one").code == 0);
  REQUIRE(bench.run_seismic("two", {"--threads", "2"}).code == 0);
  check_same_results(bench / "one", bench / "two");
  check_ledger(bench / "one", {"energy/", "energy/left/", "energy/right/"});
}

TEST_CASE("a torn checkpoint is passed over for the one before it, and the results stay the same", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("whole").code == 0);
  kill_after_checkpoints(bench, "mpm-seismic", bench.seismic_arguments("torn"), bench / "torn", 2);
  REQUIRE(checkpoints(bench / "torn").size() >= 2);
  tear(checkpoints(bench / "torn").back());
  const Ending ending = bench.run_seismic("torn");
  INFO(ending.said);
  REQUIRE(ending.code == 0);
  CHECK_THAT(ending.said, Contains("trying an older one"));
  check_same_results(bench / "whole", bench / "torn");
}

TEST_CASE("one static state serves two motions, and stays as it was", "[stages]")
{
  const Bench bench;
  bench.make_static();
  put(bench / "other.txt", sine(3, 4));
  const std::string state = contents(bench / "static/final.h5");
  REQUIRE(bench.run_seismic("a").code == 0);
  REQUIRE(bench
              .run_seismic(
                  "b", {"--motion", bench.path("other.txt"), "--record-dt", "0.01", "--record-unit", "m/s2"})
              .code == 0);
  CHECK(contents(bench / "static/final.h5") == state);
  CHECK(contents_of(bench / "a/history.h5")["/motion/upgoing_velocity"] !=
        contents_of(bench / "b/history.h5")["/motion/upgoing_velocity"]);
}

TEST_CASE("a finished run that is started again ends at once with 0 and rewrites nothing", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("a").code == 0);
  for (const std::string folder : {"static", "a"})
  {
    const auto before = times(bench / folder);
    const Ending again = folder == "a" ? bench.run_seismic("a") : bench.run_static("static");
    CHECK(again.code == 0);
    CHECK_THAT(again.said, Contains("finished already"));
    CHECK(times(bench / folder) == before);
  }
}

TEST_CASE("the option --fresh starts anew in a folder that holds results", "[stages]")
{
  const Bench bench;
  REQUIRE(bench.run_static("static").code == 0);
  const auto before = times(bench / "static");
  REQUIRE(bench.run_static("static", {"--fresh", "--set", "static.ramp=2 s"}).code == 0);
  CHECK(times(bench / "static")["final.h5"] > before.at("final.h5"));
}

TEST_CASE("a wrong command line exits with 64 and says so", "[stages]")
{
  const Bench bench;
  const std::string scene = bench.path("case.yaml"), out = bench.path("out");
  CHECK(bench.run("mpm-static", {}).code == 64);
  CHECK(bench.run("mpm-static", {scene, "--out", out, "--sideways"}).code == 64);
  CHECK(bench.run("mpm-static", {scene, "--out", out, "--threads", "0"}).code == 64);
  const Ending no_out = bench.run("mpm-static", {scene});
  CHECK(no_out.code == 64);
  CHECK_THAT(no_out.said, Contains("--out"));
  const Ending no_state = bench.run("mpm-seismic", {scene, "--out", out});
  CHECK(no_state.code == 64);
  CHECK_THAT(no_state.said, Contains("--from"));
  CHECK_FALSE(fs::exists(out));
}

TEST_CASE("a wall time that is none exits with 64", "[stages]")
{
  const Bench bench;
  for (const std::string time : {"soon", "2 fortnights", "", "1.2.3 s", "-1 s"})
  {
    INFO("'" + time + "'");
    CHECK(bench.run_static("out", {"--max-wall", time, "--check"}).code == 64);
  }
  CHECK(bench.run_static("out", {"--max-wall", "1.5 h", "--check"}).code == 0);
}

TEST_CASE("a bad case exits with 65, names file, line and column of every error, and makes no folder",
          "[stages]")
{
  const Bench bench;
  put(bench / "case.yaml",
      replaced(replaced(cut, "spacing: 1 m", "spacing: 1"), "poisson_ratio: 0.35", "poison_ratio: 0.35"));
  for (const std::string program : {"mpm-static", "mpm-seismic"})
  {
    const Ending bad = bench.run(program, {bench.path("case.yaml"), "--out", bench.path("out")});
    CHECK(bad.code == 65);
    CHECK_THAT(bad.said, Contains(bench.path("case.yaml") + ":3:17: grid.spacing: needs a unit"));
    CHECK_THAT(bad.said, Contains(bench.path("case.yaml") + ":17:5: materials.clay.poison_ratio: ") &&
                             Contains("did you mean 'poisson_ratio'?"));
  }
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("a bad override exits with 65 and names it", "[stages]")
{
  const Bench bench;
  const Ending bad = bench.run_static("out", {"--set", "time_step.safety=0.9"});
  CHECK(bad.code == 65);
  CHECK_THAT(bad.said, Contains("--set time_step.safety=0.9") && Contains("0.78"));
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("a record that is none exits with 65 and makes no folder", "[stages]")
{
  const Bench bench;
  bench.make_static();
  put(bench / "shake.txt", "0.1\nnonsense\n0.3\n");
  const Ending bad = bench.run_seismic("out");
  CHECK(bad.code == 65);
  CHECK_THAT(bad.said, Contains("shake.txt:2"));
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("an input that is missing exits with 66, names it, and makes no folder", "[stages]")
{
  const Bench bench;
  const Ending no_case = bench.run("mpm-static", {bench.path("none.yaml"), "--out", bench.path("out")});
  CHECK(no_case.code == 66);
  CHECK_THAT(no_case.said, Contains("none.yaml"));
  const Ending no_state = bench.run_seismic("out");
  CHECK(no_state.code == 66);
  CHECK_THAT(no_state.said, Contains("static/final.h5"));
  const Ending no_record = bench.run_seismic("out", {"--motion", bench.path("none.txt")});
  CHECK(no_record.code == 66);
  CHECK_THAT(no_record.said, Contains("none.txt"));
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("a folder that holds another setting's run is refused with 73 and the key that differs", "[stages]")
{
  const Bench bench;
  bench.make_static();
  const auto before = times(bench / "static");
  const Ending other = bench.run_static("static", {"--set", "materials.clay.young_modulus=50 MPa"});
  CHECK(other.code == 73);
  CHECK_THAT(other.said,
             Contains("materials.clay.young_modulus") && Contains("50 MPa") && Contains("40 MPa"));
  const Arguments short_run{"--set", "seismic.duration=0.1 s"};
  REQUIRE(bench.run_seismic("a", short_run).code == 0);
  Arguments scaled = short_run;
  scaled.insert(scaled.end(), {"--scale", "0.5"});
  const Ending other_motion = bench.run_seismic("a", scaled);
  CHECK(other_motion.code == 73);
  CHECK_THAT(other_motion.said, Contains("motion.horizontal"));
  CHECK(bench.run("mpm-static", bench.static_arguments("a")).code == 73);
  CHECK(times(bench / "static") == before);
}

TEST_CASE("a profile, --set and a case that says the same itself are one run", "[stages]")
{
  const Bench bench;
  put(bench / "case.yaml",
      cut + "profiles: {soft: {materials.clay.young_modulus: 30 MPa, static.ramp: 2 s}}\n");
  REQUIRE(bench.run_static("static", {"--profile", "soft"}).code == 0);
  const Ending same = bench.run_static(
      "static", {"--set", "materials.clay.young_modulus=30 MPa", "--set", "static.ramp=2 s"});
  CHECK(same.code == 0);
  CHECK_THAT(same.said, Contains("finished already"));
  const Ending plain = bench.run_static("static");
  CHECK(plain.code == 73);
  CHECK_THAT(plain.said, Contains("materials.clay.young_modulus is 40 MPa, but 30 MPa"));
  CHECK(open_complete(bench / "static/final.h5").attribute_string("profile", "case") == "soft");
  CHECK_THAT(contents(bench / "static/summary.json"), Contains("\"profile\": \"soft\""));
  REQUIRE(bench.run_seismic("a", {"--profile", "soft", "--set", "seismic.duration=0.1 s"}).code == 0);
  const Ending unknown = bench.run_static("b", {"--profile", "sofd"});
  CHECK(unknown.code == 65);
  CHECK_THAT(unknown.said, Contains("did you mean 'soft'"));
  CHECK_FALSE(fs::exists(bench / "b"));
}

TEST_CASE("a profile file with another text makes another ground: 73 in its folder, 65 for its static state",
          "[stages]")
{
  const Bench bench;
  put(bench / "case.yaml",
      replaced(cut, "{points: [[0 m, 14 m], [11 m, 14 m], [18 m, 9 m], [30 m, 9 m]]}", "{file: cut.csv}"));
  put(bench / "cut.csv", "0, 14\n11, 14\n18, 9\n30, 9\n");
  bench.make_static();
  CHECK(bench.run_static("static").code == 0);
  put(bench / "cut.csv", "0, 14\n11.2, 14\n17.8, 9\n30, 9\n");
  const Ending again = bench.run_static("static");
  CHECK(again.code == 73);
  CHECK_THAT(again.said, Contains("surfaces.ground"));
  const Ending shaken = bench.run_seismic("a", {"--max-wall", "0.1 s"});
  CHECK(shaken.code == 65);
  CHECK_THAT(shaken.said, Contains("surfaces.ground"));
}

TEST_CASE("a folder that a live run holds is refused with 73, and free again when that run has ended",
          "[stages]")
{
  const Bench bench;
  bench.make_static();
  const Arguments arguments = bench.seismic_arguments("a", {"--set", "seismic.duration=100 s"});
  Running first("mpm-seismic", arguments, bench / "first.txt");
  REQUIRE(first.wait_until([&] { return fs::exists(bench / "a/frame-00001.hdf"); }));
  const Ending second = bench.run("mpm-seismic", arguments);
  CHECK(second.code == 73);
  CHECK_THAT(second.said, Contains("another run holds it"));
  first.signal(SIGUSR1);
  CHECK(first.wait().code == 75);
  Running third("mpm-seismic", arguments, bench / "third.txt");
  REQUIRE(third.wait_until(
      [&] { return contents(bench / "third.txt").find("goes on from") != std::string::npos; }));
  third.signal(SIGINT);
  CHECK(third.wait().code == 75);
}

TEST_CASE("a write that fails exits with 74 and leaves the last checkpoint to go on from", "[stages]")
{
  const Bench bench;
  bench.make_static();
  REQUIRE(bench.run_seismic("whole").code == 0);
  const Arguments arguments = bench.seismic_arguments("full");
  terminate(bench, "mpm-seismic", arguments, bench / "full");
  const auto saved = checkpoints(bench / "full");
  const Ending full = bench.run("mpm-seismic", arguments, 100'000);
  INFO(full.said);
  CHECK(full.code == 74);
  CHECK(checkpoints(bench / "full") == saved);
  REQUIRE(bench.run("mpm-seismic", arguments).code == 0);
  check_same_results(bench / "whole", bench / "full");
}

TEST_CASE("an output folder that cannot be made exits with 74", "[stages]")
{
  const Bench bench;
  put(bench / "file", "in the way");
  CHECK(bench.run_static("file/out").code == 74);
  CHECK(contents(bench / "file") == "in the way");
}

TEST_CASE("a run that blows up exits with 80 and keeps its last good checkpoint", "[stages]")
{
  const Bench bench;
  bench.make_static();
  // The pulse has 10 km/s, 12 cells a step.
  put(bench / "blow.txt", sine(12, 2) + "1000000\n-1000000\n" + sine(12, 2));
  const Ending ending = bench.run_seismic("out", {"--motion", bench.path("blow.txt"), "--record-dt", "0.01",
                                                  "--record-unit", "m/s2", "--set", "seismic.duration=2 s",
                                                  "--set", "output.checkpoint.every=0.05 s"});
  INFO(ending.said);
  CHECK(ending.code == 80);
  CHECK_THAT(ending.said, Contains("t = ") && Contains("quarter of a cell"));
  CHECK_FALSE(fs::exists(bench / "out/final.h5"));
  REQUIRE_FALSE(checkpoints(bench / "out").empty());
  CHECK(code_of([&] { open_complete(checkpoints(bench / "out").back()); }) == 0);
}

TEST_CASE("a static stage without equilibrium in time exits with 81, says what fails, and writes no state",
          "[stages]")
{
  const Bench bench;
  const Ending ending = bench.run_static("out", {"--set", "static.until.at_most=3.02 s"});
  CHECK(ending.code == 81);
  CHECK_THAT(ending.said, Contains("static.until.at_most") && Contains("unbalanced force"));
  CHECK_FALSE(fs::exists(bench / "out/final.h5"));
}

TEST_CASE("a static state of another ground is refused with 65 and the key that differs", "[stages]")
{
  const Bench bench;
  bench.make_static();
  const Ending finer = bench.run_seismic("finer", {"--set", "grid.spacing=0.5 m"});
  CHECK(finer.code == 65);
  CHECK_THAT(finer.said, Contains("grid.spacing = 1 m") && Contains("grid.spacing = 0.5 m"));
  const Ending softer = bench.run_seismic("softer", {"--set", "materials.clay.young_modulus=30 MPa"});
  CHECK(softer.code == 65);
  CHECK_THAT(softer.said, Contains("materials.clay.young_modulus"));
}

TEST_CASE("a static state that is incomplete, damaged or none is refused with 65", "[stages]")
{
  const Bench bench;
  bench.make_static();
  const fs::path good = bench / "static/final.h5", bad = bench / "bad.h5";
  const auto refused = [&]
  {
    const Ending ending = bench.run(
        "mpm-seismic", {bench.path("case.yaml"), "--from", bad, "--out", bench.path("out"), "--fresh"});
    CHECK_THAT(ending.said, Contains("bad.h5"));
    return ending.code == 65;
  };
  put(bad, "no HDF5 at all");
  CHECK(refused());
  put(bad, contents(good));
  tear(bad);
  CHECK(refused());

  std::string flipped = contents(good);
  const auto at = flipped.find(bytes({open_complete(good).read_doubles("particles/stress")[0]}));
  REQUIRE(at != std::string::npos);
  flipped[at + 3] = static_cast<char>(flipped[at + 3] ^ 1);
  put(bad, flipped);
  CHECK(refused());

  put(bad, contents(good));
  const hid_t file = H5Fopen(bad.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  REQUIRE(H5Adelete(file, "complete") >= 0);
  H5Fclose(file);
  CHECK(refused());

  REQUIRE(bench.run_seismic("a", {"--set", "seismic.duration=0.1 s"}).code == 0);
  put(bad, contents(bench / "a/final.h5"));
  CHECK(refused());
}

TEST_CASE("a refused static state leaves the output folder free for the right one", "[stages]")
{
  const Bench bench;
  REQUIRE(bench.run_static("static", {"--set", "materials.clay.young_modulus=30 MPa"}).code == 0);
  CHECK(bench.run_seismic("a").code == 65);
  REQUIRE(bench.run_static("static", {"--fresh"}).code == 0);
  CHECK(bench.run_seismic("a", {"--max-wall", "0.1 s"}).code == 75);
}

TEST_CASE("the option --check tells the cost, runs and writes nothing, and exits with 0", "[stages]")
{
  const Bench bench;
  const Ending statics = bench.run("mpm-static", {bench.path("case.yaml"), "--check"});
  CHECK(statics.code == 0);
  CHECK_THAT(statics.said, Contains("particles") && Contains("MB") && Contains("steps") && Contains("c_s"));
  const Ending seismic =
      bench.run("mpm-seismic", {bench.path("case.yaml"), "--from", bench.path("static/final.h5"), "--out",
                                bench.path("out"), "--check"});
  CHECK(seismic.code == 0);
  CHECK_THAT(seismic.said, Contains("carried to") && Contains("Arias"));
  CHECK_FALSE(fs::exists(bench / "out"));
}

TEST_CASE("a run tells what it carries of the motion, warns of what it loses, and of a small step",
          "[stages]")
{
  const Bench bench;
  const auto summary_of = [&](const std::string& out, std::vector<std::string> more)
  {
    more.insert(more.end(), {"--set", "seismic.duration=0.1 s", "--set", "static.gravity=0 m/s2"});
    std::vector<std::string> arguments{bench.path("case.yaml"), "--out", bench.path(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    REQUIRE(bench.run("mpm-seismic", arguments).code == 0);
    return nlohmann::json::parse(contents(bench / out / "summary.json"));
  };
  const auto usual = summary_of("usual", {}),
             small = summary_of("small", {"--set", "time_step.safety=0.125"});
  const auto waves = [](const nlohmann::json& summary)
  { return summary["resolution"]["materials"]["clay"]["S"]; };
  CHECK(waves(usual)["carried_to"] ==
        std::min(waves(usual)["phase_limit"].get<double>(), waves(usual)["damping_limit"].get<double>()));
  CHECK(waves(usual).contains("arias_share_above"));
  CHECK(waves(small)["damping_limit"].get<double>() < waves(usual)["damping_limit"].get<double>());
  CHECK(waves(small)["arias_share_above"].get<double>() >= waves(usual)["arias_share_above"].get<double>());
  CHECK_THAT(usual["warnings"].dump(), !Contains("time_step.safety"));
  CHECK_THAT(small["warnings"].dump(), Contains("time_step.safety"));
  const auto coarse = summary_of("coarse", {"--set", "materials.clay.young_modulus=1 MPa"});
  CHECK_THAT(coarse["warnings"].dump(), Contains("Arias"));
}

TEST_CASE("a case without gravity starts without a static state and says so", "[stages]")
{
  const Bench bench;
  const Ending ending =
      bench.run("mpm-seismic", {bench.path("case.yaml"), "--out", bench.path("out"), "--set",
                                "static.gravity=0 m/s2", "--set", "seismic.duration=0.2 s"});
  CHECK(ending.code == 0);
  CHECK_THAT(ending.said, Contains("stress-free"));
  CHECK(fs::exists(bench / "out/final.h5"));
  CHECK(bench.run_static("static", {"--set", "static.gravity=0 m/s2"}).code == 65);
}

TEST_CASE("summary.json tells how a run ended, and the log all runs of the folder", "[stages]")
{
  const Bench bench;
  terminate(bench, "mpm-static", bench.static_arguments("static"), bench / "static");
  CHECK_THAT(contents(bench / "static/summary.json"),
             Contains("\"exit\": 75") && Contains("\"stage\": \"static\""));
  bench.make_static();
  CHECK_THAT(contents(bench / "static/summary.json"), Contains("\"exit\": 0"));
  CHECK_THAT(contents(bench / "static/log.txt"), Contains("ends with 75") && Contains("ends with 0"));
}
