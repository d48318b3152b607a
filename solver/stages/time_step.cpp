#include "solver/stages/time_step.hpp"

#include "solver/mpm/stability.hpp"
#include "solver/stages/session.hpp"

#include <cmath>
#include <limits>

namespace mpm
{
double greatest_wave_speed(const Domain& domain)
{
  const Particles& p = domain.particles;
  double greatest = 0;
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    const Material& material = domain.materials[m];
    const int begin = domain.material_begin[m];
    const auto* torn = material.field("opening");
    double lightest = std::numeric_limits<double>::infinity(); // density, kg/m3
    for (int k = begin; k < domain.material_begin[m + 1]; ++k)
    {
      const double opening = torn != nullptr ? (*torn)[k - begin] : 0;
      const double closed = opening > 0 ? p.volume[k] * std::exp(-opening) : p.volume[k];
      lightest = std::min(lightest, material.mass_scale * p.mass[k] / closed);
    }
    greatest = std::max(greatest, std::sqrt(material.elastic().p_modulus() / lightest));
  }
  return greatest;
}

double step_of(double courant_number, const Domain& domain)
{
  return courant_number * domain.grid.spacing / greatest_wave_speed(domain);
}

double unscaled_step(double courant_number, const Domain& domain)
{
  double greatest = 0;
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
    if (domain.material_begin[m + 1] > domain.material_begin[m])
      greatest = std::max(greatest, domain.materials[m].elastic().pressure_speed());
  return courant_number * domain.grid.spacing / greatest;
}

double step_dividing(double interval, double courant_number, const Domain& domain)
{
  return interval / std::ceil(interval / step_of(courant_number, domain));
}

// A wave takes h / c over a cell: with rho' = rho (c / c')^2 it is as slow as the slowest material's, c'.
// Only materials that have particles count.
void scale_masses(Model& model)
{
  const auto& materials = model.main->materials;
  const auto& begin = model.main->material_begin;
  double slowest = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < materials.size(); ++m)
    if (begin[m + 1] > begin[m]) slowest = std::min(slowest, materials[m].elastic().pressure_speed());
  for (const auto& [part, domain] : model.domains())
    for (Material& material : domain->materials)
      material.mass_scale = std::pow(material.elastic().pressure_speed() / slowest, 2);
}

void halve_step_if_outrun(Session& session, const Model& model, double courant_number, Clock& clock)
{
  const double h = session.case_file.grid.spacing;
  double speed = 0;
  for (const auto& [part, domain] : model.domains()) speed = std::max(speed, greatest_wave_speed(*domain));
  // Well below the limit of stability, or at it in a case that starts faster than is advisable.
  const double limit = courant_number < fast_courant_number ? fast_courant_number : stable_courant_number;
  if (clock.dt * speed <= limit * h) return;
  double dt = clock.dt;
  while (dt * speed > limit * h) dt /= 2;
  clock.change_step(dt);
  session.log.warn(
      "t = {:.3f} s: the ground has loosened to a wave speed of {:.0f} m/s; the step is halved to {:.3e} s{}",
      clock.time(), speed, clock.dt,
      session.options.seismic() ? ", which doubles the numerical damping of waves" : "");
}
} // namespace mpm
