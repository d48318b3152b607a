#include "solver/mpm/energy_balance.hpp"

#include "solver/mpm/domain.hpp"

namespace mpm
{
namespace
{
/// What the particles tell: sums in their order, which a checkpoint keeps.
struct Content
{
  double elastic = 0, plastic = 0;       ///< J per m
  double moment_x = 0, moment_y = 0;     ///< sum m x, kg m per m
  double momentum_x = 0, momentum_y = 0; ///< sum m v, N s per m
};

/// Elastic energy of particle k, J per m: V/2 sigma : C^-1 : sigma, taken back over `back` s.
double elastic_of(const Particles& p, int k, const Elastic& law, double back)
{
  const double xx = p.stress_xx[k], yy = p.stress_yy[k], zz = p.stress_zz[k], xy = p.stress_xy[k];
  const double trace = xx + yy + zz, square = xx * xx + yy * yy + zz * zz + 2 * xy * xy;
  const double stored = ((1 + law.poisson) * square - law.poisson * trace * trace) / (2 * law.young);
  const double power = xx * p.affine_xx[k] + yy * p.affine_yy[k] + xy * (p.affine_xy[k] + p.affine_yx[k]);
  return p.volume[k] * (stored - back * power);
}

Content content_of(const Domain& domain)
{
  const Particles& p = domain.particles;
  Content c;
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    const Material& material = domain.materials[m];
    const Elastic& law = material.elastic();
    const int begin = domain.material_begin[m], end = domain.material_begin[m + 1];
    for (int k = begin; k < end; ++k)
    {
      c.elastic += elastic_of(p, k, law, 0.5 * domain.energy.step.dt);
      c.moment_x += p.mass[k] * p.x[k];
      c.moment_y += p.mass[k] * p.y[k];
      c.momentum_x += p.mass[k] * p.velocity_x[k];
      c.momentum_y += p.mass[k] * p.velocity_y[k];
    }
    if (material.state.empty()) continue;
    for (int k = begin; k < end; ++k) c.plastic += p.mass[k] / law.density * material.dissipated(k - begin);
  }
  return c;
}

/// Work of gravity until now: since the last note by the trapezoidal rule, exact while gravity is constant.
double gravity_work(const Domain& domain, const Content& now)
{
  const EnergyBalance& l = domain.energy;
  return l.gravity_work + 0.5 * (l.gravity_x + domain.settings.gravity_x) * (now.moment_x - l.moment_x) +
         0.5 * (l.gravity_y + domain.settings.gravity_y) * (now.moment_y - l.moment_y);
}

/// What was brought less what is there or has left.
double brought(const Energies& flow)
{
  double sum = 0;
  for (std::size_t k = 0; k < energy_terms.size(); ++k) sum -= energy_terms[k].sign * flow.value[k];
  return sum;
}
} // namespace

double elastic_energy(const Domain& domain)
{
  return content_of(domain).elastic;
}

double dissipated_energy(const Domain& domain)
{
  return content_of(domain).plastic;
}

void open_energy_balance(Domain& domain)
{
  EnergyBalance& l = domain.energy = {};
  const Content now = content_of(domain);
  l.kinetic = kinetic_energy(domain);
  l.elastic = now.elastic;
  l.plastic = now.plastic;
  note_gravity(domain);
  l.gravity_work = 0;
}

void account(Domain& domain, double dt)
{
  EnergyBalance& l = domain.energy;
  Energies now;
  now[Energy::damping] = l.step.damping;
  for (const auto& boundary : domain.boundaries) boundary->measure_work(domain, dt, now);
  for (std::size_t k = 0; k < now.value.size(); ++k) l.flow.value[k] += now.value[k];
  l.work += l.step.work;
}

void note_gravity(Domain& domain)
{
  const Content now = content_of(domain);
  EnergyBalance& l = domain.energy;
  l.gravity_work = gravity_work(domain, now);
  l.moment_x = now.moment_x;
  l.moment_y = now.moment_y;
  l.gravity_x = domain.settings.gravity_x;
  l.gravity_y = domain.settings.gravity_y;
}

void book_departure(Domain& domain, const std::function<void()>& remove)
{
  note_gravity(domain);
  const Energies before = energies_of(domain);
  remove();
  EnergyBalance& l = domain.energy;
  const Content now = content_of(domain);
  l.moment_x = now.moment_x;
  l.moment_y = now.moment_y;
  const Energies after = energies_of(domain);
  const auto lost = [&](Energy term) { return before[term] - after[term]; };
  l.plastic -= lost(Energy::plastic);
  l.work -= lost(Energy::kinetic);
  // Of the gravitational energy it is the half step that energies_of takes back.
  l.flow[Energy::departed] += lost(Energy::kinetic) + lost(Energy::elastic) + lost(Energy::gravitational);
}

Energies energies_of(const Domain& domain)
{
  const EnergyBalance& l = domain.energy;
  const Content now = content_of(domain);
  const double gravity_back =
      0.5 * l.step.dt *
      (domain.settings.gravity_x * now.momentum_x + domain.settings.gravity_y * now.momentum_y);
  Energies e = l.flow;
  e[Energy::kinetic] = kinetic_energy(domain) - l.kinetic;
  e[Energy::elastic] = now.elastic - l.elastic;
  e[Energy::gravitational] = gravity_back - gravity_work(domain, now);
  e[Energy::plastic] = now.plastic - l.plastic;
  e[Energy::transfer] = l.work - e[Energy::kinetic];
  return e;
}

double residual(const Energies& balance)
{
  return -brought(balance);
}

double largest_term(const Energies& balance)
{
  double largest = 0;
  for (const double value : balance.value) largest = std::max(largest, std::fabs(value));
  return largest;
}

double unexplained_growth(const Energies& e)
{
  return e[Energy::kinetic] + e[Energy::elastic] + e[Energy::gravitational] + e[Energy::departed] -
         e[Energy::incoming] - e[Energy::reaction] - e[Energy::free_field];
}

void visit_energy_balance(StateVisitor& visitor, EnergyBalance& balance)
{
  std::vector<EnergyBalance> one{balance};
  RecordVisitor<EnergyBalance> list(visitor, "", one);
  for (std::size_t k = 0; k < energy_terms.size(); ++k)
    list.each("flow_" + std::string(energy_terms[k].name), "J/m",
              [k](EnergyBalance& l) -> double& { return l.flow.value[k]; });
  list.each("step", "s", [](EnergyBalance& l) -> double& { return l.step.dt; });
  list.member("work", "J/m", &EnergyBalance::work);
  list.member("opening_kinetic", "J/m", &EnergyBalance::kinetic);
  list.member("opening_elastic", "J/m", &EnergyBalance::elastic);
  list.member("opening_plastic", "J/m", &EnergyBalance::plastic);
  list.member("gravity_work", "J/m", &EnergyBalance::gravity_work);
  list.member("moment_x", "kg m/m", &EnergyBalance::moment_x);
  list.member("moment_y", "kg m/m", &EnergyBalance::moment_y);
  list.member("gravity_x", "m/s2", &EnergyBalance::gravity_x);
  list.member("gravity_y", "m/s2", &EnergyBalance::gravity_y);
  if (one.size() != 1) throw std::runtime_error("energy holds no energy balance");
  balance = one.front();
}
} // namespace mpm
