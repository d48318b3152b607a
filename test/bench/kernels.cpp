// seismpm-kernels: cost of the step's kernels, each alone, in ns per particle (Google Benchmark).
//
//   build/seismpm-kernels --benchmark_filter=scatter

#include "solver/mpm/chunk.hpp"
#include "test/domains.hpp"

#include <benchmark/benchmark.h>

namespace
{
using namespace mpm;

constexpr double time_step = 1e-6; // s; short, so that the block stays as it is

/// Von Mises ground of about `particles` particles, 3 x 3 in a cell of 1 m, sorted, with random velocities.
Domain ground(int particles)
{
  const double width = std::round(std::sqrt(particles / 9.0));
  Domain domain =
      domains::make_domain({{domains::von_mises(1e4, 5e3, 0.1), {3, 3, width, width}, 1.0 / 3}}, 1, 0.2);
  domains::random_velocities(domain, 0.1, 2);
  particles_to_grid(domain, time_step);
  solve_grid(domain, time_step);
  return domain;
}

/// Reports processor time per particle.
void per_particle(benchmark::State& state, int particles)
{
  state.counters["per_particle"] = benchmark::Counter(
      particles, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void stencils(benchmark::State& state)
{
  Domain domain = ground(static_cast<int>(state.range(0)));
  const Particles& p = domain.particles;
  ChunkStencils chunk;
  for (auto _ : state)
    for (const OccupiedBlock& occupied : domain.blocks.occupied)
      for_each_chunk(occupied,
                     [&](int, int begin, int count)
                     {
                       chunk.fill(TileStencils(domain.grid, occupied.block), &p.x[begin], &p.y[begin], count);
                       benchmark::DoNotOptimize(chunk);
                     });
  per_particle(state, p.size());
}

void scatter(benchmark::State& state)
{
  Domain domain = ground(static_cast<int>(state.range(0)));
  for (auto _ : state) particles_to_grid(domain, time_step);
  per_particle(state, domain.particles.size());
}

void grid(benchmark::State& state)
{
  Domain domain = ground(static_cast<int>(state.range(0)));
  for (auto _ : state) solve_grid(domain, time_step);
  per_particle(state, domain.particles.size());
}

void gather(benchmark::State& state)
{
  Domain domain = ground(static_cast<int>(state.range(0)));
  domain.settings.flip = state.range(1) != 0;
  solve_grid(domain, time_step);
  for (auto _ : state) grid_to_particles(domain, time_step);
  per_particle(state, domain.particles.size());
}

void deformation_and_stress(benchmark::State& state)
{
  Domain domain = ground(static_cast<int>(state.range(0)));
  VelocityGradients still{};
  for (auto _ : state)
    for (const OccupiedBlock& occupied : domain.blocks.occupied)
      for_each_chunk(occupied, [&](int material, int begin, int count)
                     { update_particles(domain, material, begin, count, still, time_step); });
  per_particle(state, domain.particles.size());
}

void sort(benchmark::State& state)
{
  Domain domain = ground(static_cast<int>(state.range(0)));
  for (auto _ : state) sort_particles(domain);
  per_particle(state, domain.particles.size());
}
} // namespace

BENCHMARK(stencils)->Arg(100000);
BENCHMARK(scatter)->Arg(1000)->Arg(10000)->Arg(100000)->Arg(1000000);
BENCHMARK(grid)->Arg(100000);
BENCHMARK(gather)
    ->Args({1000, 0})
    ->Args({10000, 0})
    ->Args({100000, 0})
    ->Args({1000000, 0})
    ->Args({100000, 90});
BENCHMARK(deformation_and_stress)->Arg(100000);
BENCHMARK(sort)->Arg(100000)->Arg(1000000);

int main(int argc, char** argv)
{
  parallel::use_threads(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
