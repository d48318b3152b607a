// seismpm-bench: cost of a step of the slope in its seismic stage, beside what the machine can do.
//
//   build/seismpm-bench --out bench.json                 10^4 to 4 10^6 particles, one and all threads
//   build/seismpm-bench --particles 4000000 --threads 2

#include "io/case/case.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/stages/time_step.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <malloc.h>
#include <numeric>
#include <unistd.h>

namespace
{
using namespace mpm;
using Watch = std::chrono::steady_clock;

double seconds_since(Watch::time_point start)
{
  return std::chrono::duration<double>(Watch::now() - start).count();
}

double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// Giga multiply-adds per second of one thread, in registers; takes some milliseconds.
double multiply_adds()
{
  // Eight vectors: as many as two units need whose results take four cycles.
  constexpr int lanes = __BIGGEST_ALIGNMENT__, rounds = 2000000;
  alignas(64) double sum[lanes]{};
  const volatile double factor = 0.999999;
  const double f = factor;
  const auto start = Watch::now();
  for (int k = 0; k < rounds; ++k)
    for (int l = 0; l < lanes; ++l) sum[l] = sum[l] * f + 1;
  const double time = seconds_since(start);
  volatile double keep = 0;
  for (const double s : sum) keep = keep + s;
  return 1e-9 * lanes * rounds / time;
}

/// The same of each thread while all of them do it: processors of a shared host change their speed, and two
/// of them may share a core.
double multiply_adds_of_each()
{
  std::vector<double> rates(parallel::threads());
  parallel::for_each(parallel::threads(), 1000, [&](int k) { rates[k] = multiply_adds(); });
  return std::accumulate(rates.begin(), rates.end(), 0.0) / parallel::threads();
}

/// What a particle-step's arithmetic takes at least, ns: 805 operations, two to a multiply-add.
double arithmetic_floor(double giga_multiply_adds)
{
  return 805 / (2 * giga_multiply_adds);
}

/// GB/s that one thread reads and writes in place, in an array of `bytes`.
double bandwidth(std::size_t bytes)
{
  std::vector<double> values(bytes / sizeof(double), 1.0);
  std::vector<double> rates;
  for (int round = 0; round < 5; ++round)
  {
    const auto start = Watch::now();
    for (double& value : values) value = 0.5 * value + 1;
    rates.push_back(2e-9 * bytes / seconds_since(start));
  }
  return median(rates);
}

/// The slope at about `particles` particles, 3 x 3 a cell, with geostatic stress, at the switch.
Model shaken_slope(int particles, Case& case_file)
{
  const std::string path = SOURCE_DIR "/cases/slope/case.yaml";
  const Case usual = load_case(path);
  const double width = usual.domain.width();
  double area = 0; // m2 of the section
  for (int k = 0; k < 1000; ++k)
    area += width / 1000 *
            (usual.ground_height(usual.domain.left + (k + 0.5) * width / 1000) - usual.domain.bottom);
  double h = std::sqrt(9 * area / particles);
  h = width / std::ceil(width / h); // a whole number of cells
  case_file = load_case(path, {fmt::format("grid.spacing={:.17g} m", h), "grid.particles_per_cell=3"});
  Model model = make_model(case_file);
  for (const auto& [part, domain] : model.domains())
  {
    Particles& p = domain->particles;
    for (int k = 0; k < p.size(); ++k)
    {
      const double depth = case_file.ground_height(p.x[k]) - p.y[k];
      p.stress_yy[k] = -18e3 * depth;
      p.stress_xx[k] = p.stress_zz[k] = -9e3 * depth;
    }
    domain->settings.gravity_y = -case_file.static_stage.gravity;
  }
  add_static_boundaries(model, case_file);
  auto wave = std::make_shared<IncomingWave>();
  GroundMotion motion; // 0.3 m/s at 2 Hz
  motion.dt = 0.01;
  for (int k = 0; k < 10000; ++k)
  {
    motion.velocity.push_back(0.3 * std::sin(4 * M_PI * k * motion.dt));
    motion.acceleration.push_back(0.3 * 4 * M_PI * std::cos(4 * M_PI * k * motion.dt));
  }
  wave->horizontal = motion;
  add_seismic_boundaries(model, case_file, wave, false);
  for (const auto& [part, domain] : model.domains()) open_energy_balance(*domain);
  return model;
}

/// Memory that this process has in use, bytes.
double resident()
{
  std::ifstream file("/proc/self/statm");
  double total = 0, used = 0;
  file >> total >> used;
  return used * static_cast<double>(sysconf(_SC_PAGESIZE));
}

struct Run
{
  int particles, threads;
  double step;   ///< ns per particle-step and core, median over batches of steps
  double floors; ///< median of the batches' ratios to the arithmetic floor of that moment and all threads
  double bytes;  ///< of memory per particle, all that the case takes
  double
      checks; ///< of whether the motion diverges: a look every 100 steps over those steps, median of ratios
  std::array<double, phase_names.size()> phases;
};

Run measure(int particles, int threads)
{
  parallel::use_threads(threads);
  malloc_trim(0);
  const double before_model = resident();
  Case case_file;
  Model model = shaken_slope(particles, case_file);
  const double dt = step_of(case_file.courant_number, *model.main);
  const int count = model.main->particles.size();
  const int batch = std::max(3, static_cast<int>(2e7 / count) / 5);
  long step = 0;
  const auto go = [&](int steps)
  {
    for (int k = 0; k < steps; ++k, ++step) advance(model, step * dt, dt);
  };
  go(batch);
  malloc_trim(0);
  const double bytes = (resident() - before_model) / count;
  const double unit = 1e9 * threads / (static_cast<double>(count) * batch);
  const auto before = model.main->measures.times.seconds();
  std::vector<double> batches, floors, checks;
  for (int round = 0; round < 5; ++round)
  {
    const double rate = multiply_adds_of_each();
    const auto start = Watch::now();
    go(batch);
    const double seconds = seconds_since(start);
    batches.push_back(unit * seconds);
    floors.push_back(batches.back() / arithmetic_floor(0.5 * (rate + multiply_adds_of_each())));
    const auto looked = Watch::now();
    for (int k = 0; k < 3; ++k) check_health(model);
    checks.push_back(seconds_since(looked) / 3 / (100 * seconds / batch));
  }
  Run run{count, threads, median(batches), median(floors), bytes, median(checks), {}};
  for (std::size_t k = 0; k < run.phases.size(); ++k)
    run.phases[k] = unit * (model.main->measures.times.seconds()[k] - before[k]) / 5;
  return run;
}

/// Takes exactly `steps` steps after a first one, which sorts; for counts of instructions.
void take(int particles, int steps)
{
  parallel::use_threads(1);
  Case case_file;
  Model model = shaken_slope(particles, case_file);
  const double dt = step_of(case_file.courant_number, *model.main);
  for (int step = 0; step < steps; ++step) advance(model, step * dt, dt);
  fmt::print("{} particles\n{} steps\n", model.main->particles.size(), steps);
}
} // namespace

int main(int argc, char** argv)
{
  CLI::App app("Cost of a step of the slope in its seismic stage.", "seismpm-bench");
  std::string out;
  std::vector<int> sizes{10000, 100000, 1000000, 4000000}, threads{1, parallel::processors()};
  app.add_option("--out", out, "file for the figures (JSON)");
  app.add_option("--particles", sizes, "sizes of the case_file");
  app.add_option("--threads", threads, "numbers of threads");
  int steps = 0;
  app.add_option("--steps", steps, "take this many steps of the first size and measure nothing");
  CLI11_PARSE(app, argc, argv);
  if (steps > 0)
  {
    take(sizes.front(), steps);
    return 0;
  }
  if (threads.size() == 2 && threads[0] == threads[1]) threads.pop_back();

  const double fma = multiply_adds(), near = bandwidth(100 << 20), far = bandwidth(std::size_t{800} << 20);
  fmt::print("vectors: {}; one thread: {:.1f} giga multiply-adds/s, in place {:.1f} GB/s in 100 MB, {:.1f} "
             "in 800 MB\n",
             vector_path, fma, near, far);
  const double arithmetic = arithmetic_floor(fma);
  const double memory = 351 / near; // 328 + 23 bytes a particle-step with 9 particles a cell
  fmt::print("floors: arithmetic {:.1f}, memory {:.1f} ns per particle-step\n\n", arithmetic, memory);
  measure(1000, threads.front()); // what the program takes for itself is no case's
  fmt::print("{:>10} {:>8} {:>8}", "particles", "threads", "step");
  for (const auto name : phase_names) fmt::print(" {:>10}", name);
  fmt::print("  floor x  bytes  checks\n");
  nlohmann::json runs;
  for (const int size : sizes)
    for (const int count : threads)
    {
      const Run run = measure(size, count);
      fmt::print("{:>10} {:>8} {:>8.1f}", run.particles, run.threads, run.step);
      for (const double phase : run.phases) fmt::print(" {:>10.2f}", phase);
      fmt::print("  {:>7.1f} {:>6.0f} {:>5.2f} %\n", run.floors, run.bytes, 100 * run.checks);
      std::cout.flush();
      nlohmann::json one{
          {"particles", run.particles},      {"threads", run.threads},          {"step", run.step},
          {"arithmetic_floors", run.floors}, {"bytes_per_particle", run.bytes}, {"checks_share", run.checks}};
      for (std::size_t k = 0; k < phase_names.size(); ++k) one[std::string(phase_names[k])] = run.phases[k];
      runs.push_back(one);
    }
  if (out.empty()) return 0;
  const nlohmann::json all{{"vectors", vector_path},
                           {"giga_multiply_adds", fma},
                           {"gigabytes_100_mb", near},
                           {"gigabytes_800_mb", far},
                           {"floor_arithmetic", arithmetic},
                           {"floor_memory", memory},
                           {"runs", runs}};
  std::ofstream(out) << all.dump(2) << '\n';
  return 0;
}
