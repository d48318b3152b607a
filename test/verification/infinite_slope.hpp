#pragma once

#include "io/case/case.hpp"
#include "materials/slip_weakening.hpp"
#include "solver/mpm/filters.hpp"

namespace mpm::verification
{
/// The filter of a case that sets none (FilterSettings).
inline constexpr NullSpaceFilter usual_filter{FilterSettings{}.time, FilterSettings{}.strain};

/// A block on a weak zone on rock, an infinite slope at 14 degrees, shaken along it: one pulse of
/// the rock's acceleration, down-slope end first.
struct InfiniteSlope
{
  SlipWeakening law;         ///< of the zone
  double spacing = 1;        ///< m
  double block = 20;         ///< its thickness, m
  double rock_cells = 4;     ///< thickness of the rock below; a whole number ends it on nodes
  int zone_cells = 3;        ///< thickness of the zone
  double pulse = 0.5 * 9.81; ///< peak acceleration of the rock, m/s2
  double duration = 3;       ///< s
  double courant = 0.5;      ///< Courant number
  bool flip = false;         ///< else affine transfers alone
  NullSpaceFilter filter;    ///< with FLIP
};

struct Slide
{
  double trigger = 0; ///< time when the slip passes 0.1 m, s
  double slip = 0;    ///< at the end, m
};

/// The slope by the material point method, a column of one cell's width.
Slide slide(const InfiniteSlope& slope);

/// A block of the slope, 60 m long and 10 m thick, on the zone, which goes on beyond it; as a model of two
/// dimensions. The slip is its mean.
Slide slide_finite(const InfiniteSlope& slope);

/// The same slope as an elastic column on a zone that weakens by its mean plastic strain, by finite
/// differences of an eighth of the zone: rock that gives slides some percent further than a rigid block.
Slide elastic_block(const InfiniteSlope& slope);

/// The same block, rigid, on a plane: d'' = g sin - tau/sigma_n(d) g cos - a(t), by Runge-Kutta steps of 1e-4
/// s (Newmark 1965, with friction that weakens).
Slide rigid_block(const InfiniteSlope& slope);
} // namespace mpm::verification
