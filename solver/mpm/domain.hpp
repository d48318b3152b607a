#pragma once

#include "materials/material.hpp"
#include "solver/mpm/boundary.hpp"
#include "solver/mpm/departures.hpp"
#include "solver/mpm/filters.hpp"
#include "solver/mpm/grid.hpp"
#include "solver/mpm/parallel.hpp"
#include "solver/mpm/particles.hpp"
#include "solver/mpm/phases.hpp"
#include "solver/mpm/rest.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>

namespace mpm
{
/// The particles [begin, end) of one material in one block.
struct ParticleRange
{
  int material;
  int begin, end;
};

/// A block that holds particles, and its ranges in the order in which they are summed.
struct OccupiedBlock
{
  BlockIndex block;
  Neighbours around;
  std::vector<ParticleRange> ranges;
  bool asleep = false; ///< see Rest
  /// Greatest speed in the time that Rest watches, m/s.
  double greatest = std::numeric_limits<double>::infinity();

  int particles() const
  {
    int sum = 0;
    for (const ParticleRange& range : ranges) sum += range.end - range.begin;
    return sum;
  }
};

/// How a gauge's ground moves otherwise than the field in which averaged moduli smooth the kink at an
/// interface (kink_at). With the normal n, the tangent t and the field's velocity v,
///
///   v_n - (normal dv_n/dn + lateral dv_t/dt),   v_t - shear (dv_t/dn + dv_n/dt).
struct Kink
{
  double normal_x = 0, normal_y = 0;         ///< n, towards the softer side
  double normal = 0, lateral = 0, shear = 0; ///< m; all zero: no interface within reach
  double stretch = 0, slip = 0; ///< what dv_n/dn and dv_t/dn + dv_n/dt have come to since the start, 1
};

/// A massless point of the ground whose motion is recorded: it moves with the interpolated grid velocity.
struct Gauge
{
  double x, y;                     ///< position, m; not a number once its ground has left the domain
  double reference_x, reference_y; ///< where it began, m
  double velocity_x = 0, velocity_y = 0;
  Kink kink = {};
};

/// What the stage asks of every step.
struct StepSettings
{
  double gravity_x = 0, gravity_y = 0; ///< body acceleration of now, m/s2
  double local_damping = 0; ///< beta of eq. (1): the share of a node's force that resists its motion
  bool flip =
      false; ///< whether particles keep their velocities and take the change only, see grid_to_particles
  NullSpaceFilter filter;
  bool average_flow = false;       ///< bands soften by their slip over the width of the law, see average_flow
  bool average_volume = false;     ///< volume changes averaged over the cell, see average_volume_changes
  bool consistent_inertia = false; ///< whether the step corrects the lumped mass, see correct_inertia
  bool plastic = true;             ///< whether the laws may yield
  bool measure_force_balance = false; ///< whether the step fills StepMeasures::force_balance
};

/// The blocks that hold particles, and how threads share them.
struct Blocks
{
  std::vector<OccupiedBlock> occupied;    ///< sorted by block
  std::vector<int> occupied_in;           ///< index in `occupied` by index in Grid::blocks; -1: holds nothing
  parallel::Group awake;                  ///< indices of occupied blocks that take part in steps
  std::array<parallel::Group, 4> colours; ///< the same by colour; blocks of one colour share no node
  double drift = 0; ///< greatest distance that a particle may have moved since the sort, cells

  /// Whether some ground sleeps.
  bool rests() const { return awake.items.size() < occupied.size(); }
  /// Whether ground in one of these blocks is awake.
  bool awake_around(const Neighbours& around) const
  {
    return std::any_of(around.begin(), around.end(),
                       [this](int block) {
                         return block >= 0 && occupied_in[block] >= 0 && !occupied[occupied_in[block]].asleep;
                       });
  }
};

/// How far the last step was from equilibrium, over the nodes that carry more than 1 % of a full cell:
/// lighter ones at a ragged surface never come to rest.
struct ForceBalance
{
  double unbalanced = 0; ///< sum |f|, N per m
  double total = 0;      ///< twice the weight: what |f_int| + |f_ext| come to in equilibrium, N per m
  double ratio() const { return total > 0 ? unbalanced / total : 0; }
};

/// What a step tells about itself; nothing of it goes into the next one.
struct StepMeasures
{
  ForceBalance force_balance;
  double greatest_move = 0; ///< greatest displacement component of a particle, cells
  PhaseTimes times;         ///< of all steps since the program began
};

/// The motion has blown up, or is no number any more.
struct Diverged : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// A body of ground on its own grid, with its boundaries: the model itself, or a free-field column.
struct Domain
{
  std::string name;

  // The state: what a checkpoint keeps.
  double time = 0; ///< at the start of the step, s
  Particles particles;
  std::vector<Material> materials;
  std::vector<int> material_begin; ///< particles of material k: [material_begin[k], material_begin[k + 1])
  std::vector<std::unique_ptr<Boundary>> boundaries;
  std::vector<Gauge> gauges;
  std::vector<Departed> departed; ///< particles that have left, in the order in which they did
  Rest rest;
  EnergyBalance energy;

  Grid grid;     ///< filled anew in every step
  Blocks blocks; ///< follow from the particles' positions at the last sort
  StepSettings settings;
  StepMeasures measures;

  /// How many particles there were in the undeformed ground; their ids are below.
  std::size_t planted() const { return particles.id.size() + departed.size(); }
};

/// Sorts the particles, with their materials' state, by block and cell; rebuilds blocks and grid and binds
/// the boundaries.
void sort_particles(Domain& domain);

/// Makes grid, groups of blocks and bindings of the boundaries from Blocks::occupied and the order of the
/// particles, both of which stay: after a sort or a restart.
void rebuild(Domain& domain);

/// Gives a domain its materials and makes room for counts[k] particles of material k, with ids 0 .. n-1 in
/// that order; the caller fills their fields and sorts.
void set_materials(Domain& domain, std::vector<Material> materials, const std::vector<int>& counts);

/// Kinetic energy in J per m, sum m/2 (v^2 + h^2/3 C : C): the affine part is what particles give to the grid
/// beside their velocity.
double kinetic_energy(const Domain& domain);

/// Greatest particle speed in m/s.
double greatest_speed(const Particles& particles);

/// Torn particles larger than the 4 h x 4 h that their spline covers fly alone: no neighbour corrects their
/// affine velocity, which would spread them without end. Sets their volume to that, and their opening to as
/// much less, so that they will close at the volume at which they would have closed.
void limit_openings(Domain& domain);
} // namespace mpm
