#pragma once
// A case file (YAML) as the programs use it: SI units, everything checked at the door. README.md lists the
// keys.

#include "boundaries/ground_motion/ground_motion.hpp"
#include "io/case/settings.hpp"
#include "io/case/surface.hpp"
#include "io/records/reader.hpp"
#include "materials/material.hpp"
#include "solver/mpm/stability.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mpm
{
/// `grid.interfaces`: the elastic moduli of particles near an interface.
enum class Interfaces
{
  sharp,
  averaged ///< see average_interfaces
};

/// `grid`: cell size in m, particles per cell and direction.
struct GridSettings
{
  double spacing = NAN;
  double frequency = 10; ///< Hz up to which the profiles of every case carry S waves; no step knows it
  int particles_per_cell = 3;
  bool average_flow = true;    ///< bands soften by their slip over the width of the law, see average_flow
  bool average_volume = false; ///< volume changes of the cell, not of the particle
  Interfaces interfaces = Interfaces::averaged;

  double particle_spacing() const { return spacing / particles_per_cell; } ///< m
};

/// `domain`, in m; its width is a whole number of cells. It is open above.
struct Extent
{
  double left = NAN, right = NAN;
  double bottom = NAN;

  double width() const { return right - left; }
};

/// One of `regions`: the ground between two surfaces, or between the domain's bottom and one.
struct Region
{
  int material = -1;        ///< index in Case::materials
  std::optional<int> above; ///< index in Case::surfaces; empty: the domain's bottom
  int below = -1;           ///< index in Case::surfaces
  double left = -std::numeric_limits<double>::infinity(); ///< m, to the nearest particle column
  double right = std::numeric_limits<double>::infinity(); ///< m, likewise
  std::string location = {};                              ///< in the case file, for messages
};

/// A stretch of a vertical line that one region has, in m.
struct Layer
{
  double bottom, top;
  int region; ///< index in Case::regions
};

/// When the static stage has converged; checked after the ramp.
struct Convergence
{
  double unbalanced = 1e-6; ///< sum of |nodal force| over sum of |internal| + |external|
  double kinetic = 1e-10;   ///< kinetic energy over the potential energy of gravity
  double at_most = 60;      ///< s of the model's time
};

/// `static`: gravity grows over `ramp` and the ground settles under local damping.
struct StaticSettings
{
  double gravity = usual_gravity;              ///< m/s2, downwards; 0: no gravity and nothing to settle
  double ramp = 10;                            ///< s
  double damping = 0.75;                       ///< fraction of the unbalanced force, in [0, 1)
  double courant_number = fast_courant_number; ///< no wave has to be carried, only stability counts
  bool mass_scaling = true; ///< inertia that gives every material the slowest one's wave speed
  Convergence until;
};

/// `seismic.base.kind`.
enum class BaseKind
{
  compliant, ///< dashpots: waves leave, the motion enters as an upgoing wave
  fixed,     ///< it does not move, and takes no motion
};
/// `seismic.sides.kind`.
enum class SideKind
{
  free_field, ///< columns of level ground move the sides; what the slope scatters leaves
  quiet,      ///< dashpots alone: waves leave, and the motion is damped beside them
  roller,     ///< no motion across the side; waves are reflected
};
/// `seismic.motion.end`: when the motion fades before its record is over.
enum class MotionEnd
{
  never,
  time,        ///< at a time of the case
  self_driven, ///< when the slide goes on by itself
};

/// Where one component of the ground motion comes from.
struct MotionSource
{
  RecordSource record; ///< an empty file: the program's own synthetic motion (`built_in`)
  double scale = 1;

  bool built_in() const { return record.file.empty(); }
};

/// `seismic.motion`.
struct MotionSettings
{
  bool given = false; ///< whether the case has this section
  std::optional<MotionSource> horizontal = MotionSource{};
  std::optional<MotionSource> vertical;
  MotionProcessing processing; ///< `scale` is each source's own
  MotionEnd end = MotionEnd::never;
  double end_time = std::numeric_limits<double>::infinity(); ///< s, where `end` is time
};

/// Time T (s) of the compliant base's spring, see BaseSpring; 0: no spring; empty: the ground's own, see
/// spring_time().
using SpringTime = std::optional<double>;

/// `seismic.transfer`: how particles take over the nodes' velocities.
enum class Transfer
{
  flip, ///< they take the change and keep the rest, see NullSpaceFilter for what of it
  apic  ///< they take the velocity: the paper's method
};

/// `seismic.filter`: what becomes of velocities and stresses that the grid cannot carry.
struct FilterSettings
{
  double time = 3;       ///< s, NullSpaceFilter::time
  double strain = 0.001; ///< NullSpaceFilter::strain
};

/// `seismic.inertia`: the mass in the equation of motion.
enum class Inertia
{
  lumped,
  consistent ///< see correct_inertia
};

/// `seismic.leaving`: what becomes of ground that passes a side or the base.
enum class GroundLeaving
{
  remove, ///< it is taken out, and the run goes on
  stop    ///< the run ends
};

/// `seismic`. The kinds of base and sides rule the free-field columns of the static stage too.
struct SeismicSettings
{
  double duration = 0;       ///< s; 0: the case has no seismic section; NaN: it goes with the record
  double after_record = NAN; ///< s that the run goes on after its record; NaN: `duration` is given
  BaseKind base = BaseKind::compliant; ///< for the domain and the columns
  SpringTime spring;
  SideKind sides = SideKind::free_field;
  Transfer transfer = Transfer::flip;
  FilterSettings filter;                 ///< with APIC none by default
  Inertia inertia = Inertia::consistent; ///< the mass matrix of the grid
  GroundLeaving leaving = GroundLeaving::remove;
  double rest_below = 0; ///< speed of ground that may be skipped after the motion, m/s; 0: none is, see Rest
  MotionSettings motion;
};

/// `output.frames`: pictures of all particles.
struct FrameSettings
{
  double every = 0.5;              ///< s
  std::vector<std::string> fields; ///< out of frame_fields()
};

/// One of `output.gauges.points`: where the gauge is at the start; it moves with the ground there.
struct GaugePoint
{
  std::string name;
  double x = NAN, y = NAN; ///< m
};

/// `output.gauges`.
struct GaugeSettings
{
  double every = 0.01; ///< s; of gauges and free field
  std::vector<GaugePoint> points;
};

/// `output.checkpoint`: how much work a crash may cost.
struct CheckpointSettings
{
  double every = 600; ///< s of wall time
  bool adapts = true; ///< longer where writing takes long: see Session::checkpoint_due
  int keep = 2;
};

/// `output.slide`: which ground counts as slid, relative to the base. It enters the measures of the run-out,
/// and with them what ends a motion (`seismic.motion.end: self_driven`).
struct SlideSettings
{
  double moved = 1; ///< m beyond which ground has slid
  double area = 10; ///< m2 of such ground that are a slide, when it is asked whether one is self-driven

  /// Distance beyond which ground is out of place, m: the first tenth of the way to a slide.
  double out_of_place() const { return 0.1 * moved; }
};

inline constexpr double slide_every = 0.1; ///< s between samples of the slide's measures and of the energy

/// `output`.
struct OutputSettings
{
  FrameSettings frames;
  GaugeSettings gauges;
  SlideSettings slide;
  CheckpointSettings checkpoint;
};

/// A case as it was read and checked: what the programs know of the world.
struct Case
{
  std::filesystem::path path;
  std::string text;                   ///< the file as it stands
  std::string profile;                ///< the profile that was applied; empty: none
  std::vector<std::string> chosen;    ///< what a profile of every case has set in this one, and why
  std::vector<std::string> overrides; ///< `key.path=value`, as given by --set
  /// Every key with the value that it has after all, given or default, profile and overrides applied.
  Settings::Entries settings;
  std::vector<std::string> warnings; ///< for the log

  std::string name; ///< for messages and pictures
  GridSettings grid;
  Extent domain;
  std::vector<Surface> surfaces; ///< in the order of the file; regions name them by index
  std::vector<Region> regions;   ///< the first that holds a point has it
  std::vector<Material> materials;
  StaticSettings static_stage;
  SeismicSettings seismic;
  double courant_number = usual_courant_number; ///< dt c_p / h
  OutputSettings output;

  /// The ground over [from, to] from the bottom upwards, the surfaces at their mean heights there.
  std::vector<Layer> layers(double from, double to) const;
  /// Height of the ground at x in m; the domain's bottom where there is none.
  double ground_height(double x) const;
  /// Longest period of level ground anywhere in the domain: four times the travel time of S waves from the
  /// bottom to the surface, s.
  double longest_period() const;
};

/// Fields that a frame can hold: those of every particle, and the laws' history variables.
std::vector<std::string> frame_fields();

/// Reads and checks a case. `profile` names one of its `profiles`, whose values win over the file's, or one
/// that every case has (profiles.hpp); `overrides` are `key.path=value` and win over both. `Error`:
/// input_missing when the file cannot be read; bad_input with every problem of the file, one a line, as
/// `FILE:LINE:COLUMN: key.path: what; what is allowed; did you mean ...?`.
Case load_case(const std::filesystem::path& path, const std::vector<std::string>& overrides = {},
               const std::string& profile = {});
} // namespace mpm
