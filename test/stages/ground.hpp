#pragma once
// Level ground and what shakes it, for tests against closed forms.

#include "io/case/case.hpp"
#include "solver/stages/time_step.hpp"
#include "test/temporary_folder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace mpm::test
{
/// A case from text.
inline Case case_from(const std::string& text)
{
  const TemporaryFolder folder;
  put(folder.path() / "case.yaml", text);
  return load_case(folder.path() / "case.yaml");
}

/// Rock (rho 2200 kg/m3, E 250 MPa, nu .25) up to `rock` m, soil (1800, 40 MPa, .35) up to `top` m, `width` m
/// wide.
inline std::string level_ground(double spacing, int per_cell, double width, double rock, double top,
                                double gravity)
{
  return fmt::format(R"(schema: seismpm-case/1
name: level
grid: {{spacing: {} m, particles_per_cell: {}}}
domain: {{x: [0 m, {} m], bottom: 0 m}}
surfaces:
  rockhead: {{points: [[0 m, {} m], [{} m, {} m]]}}
  ground: {{points: [[0 m, {} m], [{} m, {} m]]}}
regions:
  - {{material: rock, below: rockhead}}
  - {{material: soil, above: rockhead, below: ground}}
materials:
  rock: {{model: elastic, density: 2200 kg/m3, young_modulus: 250 MPa, poisson_ratio: 0.25}}
  soil: {{model: elastic, density: 1800 kg/m3, young_modulus: 40 MPa, poisson_ratio: 0.35}}
static: {{gravity: {} m/s2}}
seismic:
  duration: 1 s
  base: {{kind: compliant}}
  sides: {{kind: free_field}}
  motion: {{recorded_as: upgoing, horizontal: built_in}}
)",
                     spacing, per_cell, width, rock, width, rock, top, width, top, gravity);
}

/// An upgoing velocity pulse v = peak * sin^4(pi t / length) for 0 < t < length (s): smooth to its third
/// derivative.
inline GroundMotion pulse(double peak, double length, double total)
{
  GroundMotion motion;
  motion.dt = length / 400;
  for (double t = 0; t < total; t += motion.dt)
  {
    const double a = std::numbers::pi * t / length, s = t < length ? std::sin(a) : 0;
    motion.velocity.push_back(peak * std::pow(s, 4));
    motion.acceleration.push_back(peak * 4 * std::pow(s, 3) * std::cos(a) * std::numbers::pi / length);
  }
  return motion;
}

inline double stable_step(const Case& case_file, const Model& model)
{
  return step_of(case_file.courant_number, *model.main);
}

/// K0 stress of level ground under gravity, exact to the particles' own spacing.
inline void settle_at_once(Model& model, const Case& case_file)
{
  for (const auto& [part, domain] : model.domains())
  {
    Particles& p = domain->particles;
    for (std::size_t m = 0; m < domain->materials.size(); ++m)
      for (int k = domain->material_begin[m]; k < domain->material_begin[m + 1]; ++k)
      {
        const double rock = case_file.surfaces[0].height(0), top = case_file.ground_height(0),
                     g = case_file.static_stage.gravity;
        const double soil = 1800 * g * (top - std::max(p.y[k], rock)),
                     rest = 2200 * g * std::max(0.0, rock - p.y[k]);
        const double nu = domain->materials[m].elastic().poisson;
        p.stress_yy[k] = -(soil + rest);
        p.stress_xx[k] = p.stress_zz[k] = nu / (1 - nu) * p.stress_yy[k];
      }
  }
}

/// Lets the ground find its discrete equilibrium between walls.
inline void relax(Model& model, const Case& case_file, double duration, bool grow)
{
  add_static_boundaries(model, case_file);
  const double dt = stable_step(case_file, model);
  for (int k = 0; k * dt < duration; ++k)
  {
    const double s = grow ? std::min(1.0, 2 * k * dt / duration) : 1;
    for (const auto& [part, domain] : model.domains())
      domain->settings.gravity_y = -case_file.static_stage.gravity * s * s * s * (10 + s * (6 * s - 15));
    advance(model, k * dt, dt);
  }
}
} // namespace mpm::test
