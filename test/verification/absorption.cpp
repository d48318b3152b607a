#include "test/domains.hpp"
#include "test/verification/cases.hpp"
#include "test/verification/column.hpp"
#include "test/verification/dashpot_reflection.hpp"

#include "io/case/units.hpp"

#include <fmt/format.h>

#include <numbers>

namespace mpm::verification
{
namespace
{
constexpr double wavelength = 12;           // m
constexpr double along = 0.6 * wavelength;  // standard deviation of a packet's envelope along its way, m
constexpr double across = 1.2 * wavelength; // and across it
constexpr double clear = 2.5;               // standard deviations between the packet's centre and an edge

/// One plane wave of a packet, v = amplitude d cos(k . (x - centre)).
struct Component
{
  double kx, ky, amplitude;
};

/// A packet of plane waves with a Gaussian envelope that goes down at `angle` from the vertical.
struct Packet
{
  WaveKind kind;
  double angle;         ///< rad
  double x, y;          ///< centre, m
  double width, height; ///< of the ground that it needs until it has met the base, m
  std::vector<Component> components;
};

/// The envelope's transform in 17 x 17 waves; they repeat after 16.8 deviations, out of sight.
/// sight.
Packet make_packet(WaveKind kind, double angle)
{
  const double s = std::sin(angle), c = std::cos(angle);
  const double reach_x = clear * std::hypot(along * s, across * c),
               reach_y = clear * std::hypot(along * c, across * s);
  Packet packet{kind, angle, reach_x, reach_y, 2 * (reach_x + reach_y * s / c), 2 * reach_y, {}};
  constexpr int steps = 8; // three eighths of a deviation each, to three deviations
  for (int i = -steps; i <= steps; ++i)
    for (int j = -steps; j <= steps; ++j)
    {
      const double a = 0.375 * i, b = 0.375 * j; // deviations of the wave number along and across
      const double k = 2 * std::numbers::pi / wavelength + a / along, q = b / across;
      const Component one{k * s + q * c, -k * c + q * s, std::exp(-0.5 * (a * a + b * b))};
      if (one.ky < 0) packet.components.push_back(one); // what would go up is not of the packet
    }
  return packet;
}

/// Velocity of a packet at its start and stress half a step later, as the scheme has them; exact for each
/// plane wave: sigma = -D (v sym k) / (c |k|).
void put(const Packet& packet, Domain& domain, const Elastic& law, double dt)
{
  Particles& p = domain.particles;
  const double c = speed_of(packet.kind, law);
  for (int n = 0; n < p.size(); ++n)
  {
    double vx = 0, vy = 0, xx = 0, yy = 0, xy = 0, C[4] = {};
    for (const Component& one : packet.components)
    {
      const double k = std::hypot(one.kx, one.ky), nx = one.kx / k, ny = one.ky / k;
      const double phase = one.kx * (p.x[n] - packet.x) + one.ky * (p.y[n] - packet.y);
      const double v = one.amplitude * std::cos(phase),
                   later = one.amplitude * std::cos(phase - 0.5 * dt * c * k),
                   slope = -one.amplitude * std::sin(phase);
      const double dx = packet.kind == WaveKind::P ? nx : ny, dy = packet.kind == WaveKind::P ? ny : -nx;
      vx += v * dx;
      vy += v * dy;
      xx -= later / c * (law.lame() * (nx * dx + ny * dy) + 2 * law.shear_modulus() * nx * dx);
      yy -= later / c * (law.lame() * (nx * dx + ny * dy) + 2 * law.shear_modulus() * ny * dy);
      xy -= later / c * law.shear_modulus() * (nx * dy + ny * dx);
      C[0] += slope * one.kx * dx;
      C[1] += slope * one.ky * dx;
      C[2] += slope * one.kx * dy;
      C[3] += slope * one.ky * dy;
    }
    constexpr double scale = 1e-6; // m/s: displacements stay far below a cell
    p.velocity_x[n] = scale * vx;
    p.velocity_y[n] = scale * vy;
    p.affine_xx[n] = scale * C[0];
    p.affine_xy[n] = scale * C[1];
    p.affine_yx[n] = scale * C[2];
    p.affine_yy[n] = scale * C[3];
    p.stress_xx[n] = scale * xx;
    p.stress_yy[n] = scale * yy;
    p.stress_xy[n] = scale * xy;
    p.stress_zz[n] = law.poisson * (p.stress_xx[n] + p.stress_yy[n]);
  }
}

/// Energy of a wave, J per m, as the equation of motion has it: the lumped mass moves with the nodes, whose
/// kinetic energy is the particles' with the affine part, (kh)^2/3 of the rest; consistent inertia moves with
/// the field, which is the particles' own velocity.
double energy(const Domain& domain)
{
  if (!domain.settings.consistent_inertia) return kinetic_energy(domain) + domains::strain_energy(domain);
  const Particles& p = domain.particles;
  double kinetic = 0;
  for (int k = 0; k < p.size(); ++k)
    kinetic += 0.5 * p.mass[k] * (p.velocity_x[k] * p.velocity_x[k] + p.velocity_y[k] * p.velocity_y[k]);
  return kinetic + domains::strain_energy(domain);
}

/// Share of the packet's energy that the base sends back: what is left at the end, over it and what the base
/// has absorbed. The transfers cost a wave some of its energy on its way; their rate is taken from the first
/// sixth of it, before the packet meets the base, and both are reckoned back with it.
double reflected(const Packet& packet, const std::filesystem::path& folder, double spacing,
                 const std::string& inertia)
{
  const Case case_file = load_case(
      folder / "case.yaml", {"grid.spacing=" + number_text(spacing) + " m", "seismic.inertia=" + inertia,
                             fmt::format("domain.x=[0 m, {} m]", std::ceil(packet.width)),
                             fmt::format("surfaces.ground.points=[[0 m, {} m]]", std::ceil(packet.height))});
  Model model = make_model(case_file);
  add_seismic_boundaries(model, case_file, std::make_shared<IncomingWave>(), false);
  Domain& domain = *model.main;
  const Elastic& law = case_file.materials[0].elastic();
  const double dt = case_file.courant_number * spacing / law.pressure_speed();
  put(packet, domain, law, dt);
  const double way = 2 * packet.y / std::cos(packet.angle); // until its tail has met the base
  const int steps = static_cast<int>(way / speed_of(packet.kind, law) / dt);
  double start = 0, work = 0, absorbed = 0, rate = 0;
  for (int k = 0; k < steps; ++k)
  {
    domains::run(domain, 1, dt);
    const double now = domain.energy.flow[Energy::radiated_base] - work;
    work += now;
    absorbed += now * std::exp(rate * k * dt);
    if (k == 0) start = energy(domain); // of the field as the grid carries it
    if (k == steps / 6) rate = -std::log((energy(domain) + work) / start) / (k * dt);
  }
  const double left = energy(domain) * std::exp(rate * steps * dt);
  return left / (left + absorbed);
}

/// The closed form, weighted over the packet's plane waves by their energies.
double expected(const Packet& packet, const Elastic& law)
{
  double reflected = 0, all = 0;
  for (const Component& one : packet.components)
  {
    const double energy = one.amplitude * one.amplitude;
    reflected += energy * reflected_energy(packet.kind, one.kx / std::hypot(one.kx, one.ky), law);
    all += energy;
  }
  return reflected / all;
}

double table_error(const std::map<std::string, std::vector<double>>& table, WaveKind kind, const Elastic& law)
{
  const auto& values = table.at(kind == WaveKind::P ? "P" : "S");
  double error = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    error = std::max(
        error,
        std::fabs(values[k] -
                  reflected_energy(kind, std::sin(table.at("angle")[k] * std::numbers::pi / 180), law)));
  return error;
}
/// Packets at these angles from the vertical, in degrees.
Findings absorb(const std::filesystem::path& folder, double spacing, const std::vector<double>& angles)
{
  const auto table = read_table(folder / "reference.csv");
  const Elastic law = case_at(folder, spacing).materials[0].elastic();
  Findings findings;
  findings.errors["table"] = 0;
  for (const auto& [kind, inertia] : {std::pair{WaveKind::P, "lumped"},
                                      {WaveKind::S, "lumped"},
                                      {WaveKind::P, "consistent"},
                                      {WaveKind::S, "consistent"}})
  {
    std::string name = kind == WaveKind::P ? "P" : "S";
    if (inertia == std::string("consistent")) name += ", consistent";
    Curve curve{name, "angle from the normal (degrees)", "share of energy reflected", angles, {}, {}};
    for (const double degrees : curve.x)
    {
      const Packet packet = make_packet(kind, degrees * std::numbers::pi / 180);
      curve.model.push_back(reflected(packet, folder, spacing, inertia));
      curve.reference.push_back(expected(packet, law));
      double& error = findings.errors[name];
      error = std::max(error, std::fabs(curve.model.back() - curve.reference.back()));
    }
    findings.errors["table"] = std::max(findings.errors["table"], table_error(table, kind, law));
    findings.curves.push_back(curve);
  }
  return findings;
}
} // namespace

Findings run_absorption(const std::filesystem::path& folder, double spacing)
{
  return absorb(folder, spacing, {0, 30, 50});
}

Findings run_absorption_steep(const std::filesystem::path& folder, double spacing)
{
  return absorb(folder / "../absorption", spacing, {60, 70});
}
} // namespace mpm::verification
