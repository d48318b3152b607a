#pragma once
// The energy balance of a domain: where energy is, where it went and where it came from, in J per m out of
// plane.

#include "solver/mpm/state.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace mpm
{
struct Domain;

/// The terms of the energy balance. All count from its opening.
enum class Energy
{
  kinetic,
  elastic,
  gravitational,
  plastic,
  damping,
  transfer,
  radiated_base,
  radiated_sides,
  departed,
  incoming,
  reaction,
  free_field,
};

struct EnergyTerm
{
  std::string_view name;
  int sign; ///< +1: is in the ground or has left it; -1: was brought
  std::string_view doc;
};

/// In the order of `Energy`.
inline constexpr std::array<EnergyTerm, 12> energy_terms{{
    {"kinetic", 1, "kinetic energy of the particles, with the affine part"},
    {"elastic", 1, "V/2 sigma : C^-1 : sigma"},
    {"gravitational", 1, "minus the work of gravity"},
    {"plastic", 1, "dissipated by plastic flow"},
    {"damping", 1, "taken by the local damping of the static stage"},
    {"transfer", 1, "numerical dissipation of the transfers between particles and grid"},
    {"radiated_base", 1, "downgoing waves: impedance (v - v_up)^2 at the base"},
    {"radiated_sides", 1, "scattered waves: impedance (v - v_column)^2 at the sides"},
    {"departed", 1, "kinetic and elastic energy of ground when it left the model"},
    {"incoming", -1, "upgoing wave: impedance v_up^2 at the base"},
    {"static_reaction", -1, "work of the static reaction of walls that have gone, and of the base's spring"},
    {"free_field", -1, "work of the free-field columns' stress and motion at the sides"},
}};

/// An amount for each term, J per m.
struct Energies
{
  std::array<double, energy_terms.size()> value{};

  double& operator[](Energy term) { return value[static_cast<std::size_t>(term)]; }
  double operator[](Energy term) const { return value[static_cast<std::size_t>(term)]; }
};

/// What solve_grid measures of a step.
struct StepWork
{
  double dt = 0;
  double work = 0;                  ///< of all forces: change of the grid's kinetic energy by them, J per m
  double damping = 0;               ///< taken by the local damping, J per m
  std::array<double, 2> momentum{}; ///< mean of the step's start and end, N s per m
};

/// Accumulated flows and opening state. Plain data; `account` keeps it, `energies_of` reads it.
struct EnergyBalance
{
  StepWork step;   ///< the last one
  Energies flow;   ///< of damping and boundaries, since the opening
  double work = 0; ///< of all forces on the grid, since the opening, less what left as kinetic energy
  double kinetic = 0, elastic = 0, plastic = 0; ///< at the opening
  double gravity_work = 0;                      ///< until gravity was last noted
  double moment_x = 0, moment_y = 0;            ///< sum m x (kg m per m) and gravity (m/s2) of then
  double gravity_x = 0, gravity_y = 0;
};

/// Elastic energy of the particles, J per m: V/2 sigma : C^-1 : sigma, half a step back.
double elastic_energy(const Domain& domain);

/// Energy that plastic flow has dissipated according to the laws' history, J per m.
double dissipated_energy(const Domain& domain);

/// Begins the energy balance with the domain as it is, at rest or free of stress.
void open_energy_balance(Domain& domain);

/// Books a step: to be called after the equation of motion, before velocities go back to the particles.
void account(Domain& domain, double dt);

/// Notes gravity as it is now. Between two notes gravity is taken to change linearly with the ground's
/// movement, so while it grows it is to be noted often; while it is constant never again.
void note_gravity(Domain& domain);

/// Books ground that leaves, which `remove` takes out of the domain: what it held of kinetic and elastic
/// energy has left; what it dissipated and what gravity did to it stay where they are.
void book_departure(Domain& domain, const std::function<void()>& remove);

/// The energy balance as it stands. Symplectic Euler keeps K(v) + U(x) - dt/2 v . grad U (Hairer, Lubich &
/// Wanner, Geometric Numerical Integration, 2006, IX.3): stresses and positions are half a step ahead of
/// velocities. So elastic and gravitational energy are taken back by half a step with the particles' own
/// velocity and its gradient; without that, their sum with the kinetic energy would swing by omega dt / 2 of
/// a wave's energy. Costs a pass over the particles.
Energies energies_of(const Domain& domain);

/// What is there and has left, less what was brought: zero if the energy balance closes, but for the error of
/// the time integration and of the hypoelastic rate.
double residual(const Energies& balance);

/// Greatest term, the measure of the residual.
double largest_term(const Energies& balance);

/// Kinetic, elastic and gravitational energy, with what left, that no source brought; below zero by what was
/// dissipated.
double unexplained_growth(const Energies& balance);

/// Saves or loads the energy balance.
void visit_energy_balance(StateVisitor& visitor, EnergyBalance& balance);
} // namespace mpm
