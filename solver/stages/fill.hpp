#pragma once

#include "io/case/case.hpp"

#include <vector>

namespace mpm
{
/// A particle to be.
struct Seed
{
  double x, y;   ///< m
  double volume; ///< m3 per m of width
  int material;  ///< index in Case::materials
};

/// A part of the domain, m.
struct Span
{
  double from = NAN, to = NAN, length = 0; ///< `length`: of what is meant between the ends

  void add(double left, double right)
  {
    if (length == 0) from = left;
    to = right;
    length += right - left;
  }
};

/// How particles fill one of Case::regions.
struct RegionFilling
{
  double area = 0;      ///< of its particles, m2
  double thickness = 0; ///< mean, across the layer of its material, other regions' included, m
  double middle = NAN;  ///< height of that layer's middle in the last column, m
  Span filled, lost;    ///< columns that it has particles in; those where it is too thin for one
};

/// The particles of a case, column by column from the left and upwards in each, and how well they fill it.
struct Filling
{
  std::vector<Seed> seeds;
  std::vector<RegionFilling> regions; ///< as Case::regions
  Span bare;                          ///< columns that have no ground on the domain's bottom
};

/// Puts one particle on every sub-cell whose centre lies in the ground. The first and the last of a layer
/// take what the layer has more or less than whole sub-cells and sit at its centroid, so that every column
/// has the mass of the geometry and not of a staircase. Surfaces enter by their mean height over a column. A
/// layer thinner than half a sub-cell gets no particle: it is lost.
Filling fill(const Case& case_file);

/// A region as the case draws it.
struct Drawn
{
  double area = 0, length = 0; ///< m2; m of x where it has any thickness
};

/// All of Case::regions as drawn, whatever the particles: integrals over pieces of columns between the ends
/// of regions and the corners of surfaces.
std::vector<Drawn> drawn_regions(const Case& case_file);
} // namespace mpm
