#pragma once
// The two programs from outside, on a small case: to start, stop and repeat them as a script does.

#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <map>
#include <numbers>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace mpm::test
{
namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

/// A cut of 5 m in softening clay over rock; the clay yields under the motion. Checkpoints come several times
/// a run.
inline const std::string cut = R"(schema: seismpm-case/1
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
inline std::string sine(double amplitude, double frequency)
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
inline std::vector<fs::path> checkpoints(const fs::path& folder)
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

/// The ways in which a run may be cut short. Each leaves `out` to be gone on with.
inline void terminate(const Bench& bench, const std::string& program, const Arguments& arguments,
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

inline void kill_after_checkpoints(const Bench& bench, const std::string& program, const Arguments& arguments,
                                   const fs::path& out, std::size_t count)
{
  Running running(program, arguments, bench / "said.txt");
  REQUIRE(running.wait_until([&] { return checkpoints(out).size() >= count; }));
  running.signal(SIGKILL);
  REQUIRE(running.wait().code == -SIGKILL);
  CHECK_FALSE(fs::exists(out / "final.h5"));
}

/// Changes one bit in the middle of a file.
inline void flip_a_bit(const fs::path& file)
{
  std::string bytes = contents(file);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  put(file, bytes);
}

inline void tear(const fs::path& file)
{
  fs::resize_file(file, fs::file_size(file) / 2);
}

inline void run_out_of_time(const Bench& bench, const std::string& program, Arguments arguments,
                            const fs::path& out)
{
  arguments.insert(arguments.end(), {"--max-wall", "0.1 s"});
  const Ending ending = bench.run(program, arguments);
  INFO(ending.said);
  REQUIRE(ending.code == 75);
  CHECK_FALSE(checkpoints(out).empty());
}

/// The files of a folder and when they were written.
inline std::map<std::string, fs::file_time_type> times(const fs::path& folder)
{
  std::map<std::string, fs::file_time_type> all;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const std::string name = entry.path().filename(); name != "log.txt" && name != ".lock")
      all[name] = entry.last_write_time();
  return all;
}
} // namespace mpm::test
