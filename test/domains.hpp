#pragma once
// Small bodies for the tests of the solver: lattices of particles, random states, and measures of them.
//
// A test makes a body, gives it a motion, steps it and measures:
//
//   Domain block = make_domain({{elastic(), {0, 0, 8, 8}}}); // 8 m by 8 m, 2 x 2 particles in cells of 1 m
//   random_velocities(block, 1, 7);                          // up to 1 m/s, from the seed 7
//   run(block, 100, 1e-3);                                   // 100 steps of 1 ms
//   CHECK(kinetic_energy(block) + strain_energy(block) < ...);

#include "solver/mpm/domain.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/mpm/step.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace domains
{
using namespace mpm;

/// Uses so many threads while it lives.
class Threads
{
public:
  explicit Threads(int count) { parallel::use_threads(count); }
  ~Threads() { parallel::use_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

private:
  int before_ = parallel::threads();
};

/// Random numbers that are the same on every machine: the standard's engine, and no distribution of the
/// library's.
class Random
{
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double lower, double upper)
  {
    return lower + (upper - lower) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

private:
  std::mt19937_64 engine_;
};

struct Rectangle
{
  double left, bottom, width, height; ///< m
};

/// A rectangle of one material, filled with a square lattice of particles.
struct Body
{
  Law law;
  Rectangle rectangle;
  double size = 0.5; ///< distance of the particles, m
};

/// Pa, -, kg/m3.
inline Elastic elastic(double young = 1e6, double poisson = 0.3, double density = 2000)
{
  Elastic law;
  law.density = density;
  law.young = young;
  law.poisson = poisson;
  return law;
}

/// Strengths are Mises stresses q in Pa; `strain` is the plastic strain at which the residual one is reached.
inline VonMises von_mises(double peak, double residual, double strain, double young = 1e6,
                          double poisson = 0.3)
{
  VonMises law;
  law.density = 2000;
  law.young = young;
  law.poisson = poisson;
  law.peak = peak;
  law.residual = residual;
  law.softening_strain = strain;
  return law;
}

/// Perfectly plastic ground of 2000 kg/m3 and E = 50 MPa; angles in degrees.
inline MohrCoulomb mohr_coulomb(double friction, double cohesion, double dilation = 0)
{
  constexpr double degree = std::numbers::pi / 180;
  MohrCoulomb law;
  law.density = 2000;
  law.young = 50e6;
  law.poisson = 0.3;
  law.friction_peak = friction * degree;
  law.cohesion_peak = cohesion;
  law.dilation = dilation * degree;
  if (const std::string problem = law.resolve(1); !problem.empty()) throw std::runtime_error(problem);
  return law;
}

/// A shear zone as stiff and heavy as that of the paper's Table 2, with a critical slip and a thickness in m.
inline SlipWeakening slip_weakening(double friction_peak, double friction_residual, double critical_slip,
                                    double thickness)
{
  SlipWeakening law;
  law.density = 2450;
  law.young = 1e9;
  law.poisson = 0.3;
  law.friction_peak = friction_peak;
  law.friction_residual = friction_residual;
  law.critical_slip = critical_slip;
  law.thickness = thickness;
  return law;
}

/// A domain of bodies, one material each, at rest and free of stress. `scatter` moves the particles at random
/// by up to so many of their distances.
inline Domain make_domain(const std::vector<Body>& bodies, double spacing = 1, double scatter = 0,
                          unsigned seed = 1)
{
  Domain domain;
  domain.name = "test";
  domain.grid.spacing = spacing;
  Random random(seed);
  std::vector<Material> materials;
  std::vector<int> counts;
  std::vector<double> x, y, mass, volume;
  for (const Body& body : bodies)
  {
    materials.push_back({"m" + std::to_string(materials.size()), body.law, {}});
    const int columns = static_cast<int>(std::lround(body.rectangle.width / body.size));
    const int rows = static_cast<int>(std::lround(body.rectangle.height / body.size));
    counts.push_back(columns * rows);
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
      {
        x.push_back(body.rectangle.left + (i + 0.5 + random(-scatter, scatter)) * body.size);
        y.push_back(body.rectangle.bottom + (j + 0.5 + random(-scatter, scatter)) * body.size);
        volume.push_back(body.size * body.size);
        mass.push_back(volume.back() * materials.back().elastic().density);
      }
  }
  set_materials(domain, std::move(materials), counts);
  Particles& p = domain.particles;
  p.x = p.reference_x = x;
  p.y = p.reference_y = y;
  p.mass = mass;
  p.volume = volume;
  sort_particles(domain);
  return domain;
}

/// Each component up to `speed` (m/s) in magnitude, each particle for itself: the roughest field that there
/// is.
inline void random_velocities(Domain& domain, double speed, unsigned seed)
{
  Random random(seed);
  for (auto* field : {&domain.particles.velocity_x, &domain.particles.velocity_y})
    for (double& v : *field) v = random(-speed, speed);
}

/// Each component of the affine matrix C up to `rate` (1/s) in magnitude.
inline void random_affine(Domain& domain, double rate, unsigned seed)
{
  Random random(seed);
  Particles& p = domain.particles;
  for (auto* field : {&p.affine_xx, &p.affine_xy, &p.affine_yx, &p.affine_yy})
    for (double& c : *field) c = random(-rate, rate);
}

/// Each component up to `stress` (Pa) in magnitude.
inline void random_stress(Domain& domain, double stress, unsigned seed)
{
  Random random(seed);
  Particles& p = domain.particles;
  for (auto* field : {&p.stress_xx, &p.stress_yy, &p.stress_zz, &p.stress_xy})
    for (double& s : *field) s = random(-stress, stress);
}

inline void set_velocity(Domain& domain, double vx, double vy)
{
  domain.particles.velocity_x.assign(domain.particles.size(), vx);
  domain.particles.velocity_y.assign(domain.particles.size(), vy);
}

/// A body in the corner of the grid lines x = -3 and y = 5, growing to the given sides, with everything
/// random.
inline Domain random_corner(double h, int to_x, int to_y)
{
  const double x = -3 * h, y = 5 * h, width = 9 * h, height = 7 * h;
  const Rectangle rectangle{to_x > 0 ? x : x - width, to_y > 0 ? y : y - height, width, height};
  Domain domain = make_domain({{elastic(), rectangle, h / 2}}, h, 0.49, 71);
  random_velocities(domain, 2, 72);
  random_affine(domain, 3, 73);
  random_stress(domain, 1e5, 74);
  domain.settings.gravity_x = 1.3;
  domain.settings.gravity_y = -9.81;
  return domain;
}

/// Steps so often, with the clock k dt.
inline void run(Domain& domain, int steps, double dt)
{
  const double start = domain.time;
  for (int k = 0; k < steps; ++k)
  {
    domain.time = start + k * dt;
    step(domain, dt);
  }
  domain.time = start + steps * dt;
}

/// A domain of its own with the same particles, materials and loads, but no occupied blocks and grid yet.
inline Domain same_particles(const Domain& from)
{
  Domain to;
  to.name = from.name;
  to.grid.spacing = from.grid.spacing;
  to.grid.origin_x = from.grid.origin_x;
  to.grid.origin_y = from.grid.origin_y;
  to.particles = from.particles;
  to.materials = from.materials;
  to.material_begin = from.material_begin;
  to.settings.gravity_x = from.settings.gravity_x;
  to.settings.gravity_y = from.settings.gravity_y;
  to.settings.local_damping = from.settings.local_damping;
  to.settings.plastic = from.settings.plastic;
  to.time = from.time;
  return to;
}

/// Whether all particles agree in order and in every bit of every field and history variable.
inline bool identical(const Domain& a, const Domain& b)
{
  bool same = a.particles.id == b.particles.id && a.blocks.drift == b.blocks.drift;
  for (const ParticleField& field : particle_fields)
    for (int c = 0; c < field.components; ++c)
      same = same && a.particles.*field.data[c] == b.particles.*field.data[c];
  for (std::size_t m = 0; m < a.materials.size(); ++m)
    same = same && a.materials[m].state == b.materials[m].state;
  return same;
}

inline double greatest(const std::vector<double>& values)
{
  double result = 0;
  for (const double v : values) result = std::max(result, std::fabs(v));
  return result;
}

/// Elastic strain energy in J per m: sum over particles of V/2 sigma : C^-1 : sigma, which for an isotropic
/// solid is V ((1 + nu) sigma : sigma - nu (tr sigma)^2) / 2E.
inline double strain_energy(const Domain& domain)
{
  const Particles& p = domain.particles;
  double sum = 0;
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    const Elastic& law = domain.materials[m].elastic();
    for (int k = domain.material_begin[m]; k < domain.material_begin[m + 1]; ++k)
    {
      const double trace = p.stress_xx[k] + p.stress_yy[k] + p.stress_zz[k];
      const double square = p.stress_xx[k] * p.stress_xx[k] + p.stress_yy[k] * p.stress_yy[k] +
                            p.stress_zz[k] * p.stress_zz[k] + 2 * p.stress_xy[k] * p.stress_xy[k];
      sum += p.volume[k] * ((1 + law.poisson) * square - law.poisson * trace * trace) / (2 * law.young);
    }
  }
  return sum;
}

/// Kinetic and elastic energy of a free run over the kinetic energy at its start.
struct EnergyShares
{
  double greatest, early, last; ///< of all steps, after 301 steps, at the end
};

inline EnergyShares energy_shares(Domain& domain, int steps, double dt)
{
  const double start = kinetic_energy(domain);
  EnergyShares shares{};
  for (int k = 0; k < steps; ++k)
  {
    step(domain, dt);
    shares.last = (kinetic_energy(domain) + strain_energy(domain)) / start;
    if (!std::isfinite(shares.last)) throw std::runtime_error("the run blew up");
    shares.greatest = std::max(shares.greatest, shares.last);
    if (k == 300) shares.early = shares.last;
  }
  return shares;
}
} // namespace domains
