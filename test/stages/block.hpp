#pragma once
// A block of rock that a motion enters, and runs of it.

#include "test/read_json.hpp"
#include "test/stages/programs.hpp"
#include "test/stages/results.hpp"

namespace mpm::test
{
/// A block of rock without gravity, shaken by shake.txt: 1.2 s in steps of 10 ms, peak 12 m/s2.
inline const std::string block = R"(schema: seismpm-case/1
name: block
grid: {spacing: 2 m, particles_per_cell: 2}
domain: {x: [0 m, 8 m], bottom: 0 m}
surfaces:
  ground: {points: [[0 m, 6 m]]}
regions:
  - {material: rock, below: ground}
materials:
  rock: {model: elastic, density: 2000 kg/m3, young_modulus: 200 MPa, poisson_ratio: 0.25}
static: {gravity: 0 m/s2}
seismic:
  duration: 0.6 s
  motion:
    recorded_as: outcrop
    horizontal: {file: shake.txt, format: column, dt: 0.01 s, unit: m/s2}
    baseline: none
output:
  frames: {every: 0.25 s}
  gauges: {points: {top: [4 m, 6 m]}}
)";

class Block
{
public:
  Block()
  {
    put(bench_ / "case.yaml", block);
    put(bench_ / "shake.txt", sine(12, 2));
  }
  fs::path operator/(const std::string& name) const { return bench_ / name; }
  Ending run(const std::string& out, const Arguments& more = {}) const
  {
    Arguments all{bench_.path("case.yaml"), "--out", bench_.path(out), "--threads", "1"};
    all.insert(all.end(), more.begin(), more.end());
    return bench_.run("mpm-seismic", all);
  }
  Ending program(const std::string& name, const Arguments& arguments) const
  {
    return bench_.run(name, arguments);
  }
  nlohmann::json summary(const std::string& out) const { return read_json(bench_ / out / "summary.json"); }
  /// Motion `name` in another unit and step.
  Arguments record(const std::string& name, const std::string& unit = "m/s2",
                   const std::string& dt = "0.01") const
  {
    return {"--motion", bench_.path(name), "--record-dt", dt, "--record-unit", unit};
  }

private:
  Bench bench_;
};

/// The horizontal part of a series of /motion.
inline std::vector<double> horizontal(const fs::path& history, const std::string& name)
{
  std::vector<double> part;
  const std::vector<double> both = open_complete(history).read_doubles("motion/" + name);
  for (std::size_t i = 0; i < both.size(); i += 2) part.push_back(both[i]);
  return part;
}

/// Greatest magnitude of the first `count` values.
inline double greatest(const std::vector<double>& values, std::size_t count)
{
  double most = 0;
  for (std::size_t i = 0; i < std::min(count, values.size()); ++i) most = std::max(most, std::abs(values[i]));
  return most;
}
} // namespace mpm::test
