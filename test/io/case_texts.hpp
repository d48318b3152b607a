#pragma once
// Cases as texts: read them, or hear why they are refused.

#include "io/case/case.hpp"
#include "io/common/error.hpp"
#include "test/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace mpm::test
{
using Catch::Contains;

/// A file of a folder, made with the folders on the way.
inline std::filesystem::path written(const TemporaryFolder& folder, const std::string& name,
                                     const std::string& text)
{
  std::filesystem::create_directories((folder / name).parent_path());
  put(folder / name, text);
  return folder / name;
}

inline Case load(const std::string& text, const std::vector<std::string>& overrides = {},
                 const std::string& profile = {})
{
  const TemporaryFolder folder;
  return load_case(written(folder, "case.yaml", text), overrides, profile);
}

/// The messages, without the folder; the exit code goes first.
inline std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {},
                           const std::string& profile = {})
{
  const TemporaryFolder folder;
  try
  {
    load_case(written(folder, "case.yaml", text), overrides, profile);
  }
  catch (const Error& error)
  {
    std::string all = error.what();
    const std::string prefix = folder.path().string() + "/";
    for (auto at = all.find(prefix); at != std::string::npos; at = all.find(prefix))
      all.erase(at, prefix.size());
    return std::to_string(error.code) + "\n" + all + "\n";
  }
  return "accepted";
}

/// Level ground of one material: no more than a case must have.
inline const std::string small = R"(schema: seismpm-case/1
grid: {spacing: 1 m}
domain: {x: [0 m, 40 m], bottom: 0 m}
surfaces:
  ground: {points: [[0 m, 10 m]]}
regions:
  - {material: soil, below: ground}
materials:
  soil:
    model: elastic
    density: 1800 kg/m3
    young_modulus: 40 MPa
    poisson_ratio: 0.35
)";

/// Rock that softens on a shear zone.
inline const std::string landslide = R"(schema: seismpm-case/1
grid: {spacing: 2 m}
domain: {x: [0 m, 40 m], bottom: 0 m}
surfaces:
  zone: {points: [[0 m, 10 m]]}
  ground: {points: [[0 m, 20 m]]}
regions:
  - {material: zone, below: zone}
  - {material: mass, below: ground}
materials:
  mass:
    model: mohr_coulomb
    density: 2450 kg/m3
    young_modulus: 3.6 GPa
    poisson_ratio: 0.3
    friction_angle: {peak: 38.5 deg, residual: 18.9 deg}
    cohesion: {peak: 980 kPa, residual: 0 kPa}
    softening: {displacement: 1.7 m}
  zone:
    model: slip_weakening
    density: 2450 kg/m3
    young_modulus: 1 GPa
    poisson_ratio: 0.3
    friction: {peak: 0.56, residual: 0.07}
    critical_slip: 1.7 m
    thickness: 4 m
    match: plane
)";
} // namespace mpm::test
