#pragma once

#include "io/case.hpp"

#include <vector>

namespace mpm
{
/// A particle to be: place in m, volume in m3 per m of width, and the place of its material in
/// Case::materials.
struct Seed
{
  double x, y, volume;
  int material;
};

/// The particles of a case, column by column from the left and upwards in each, and how well they fill it.
struct Filling
{
  std::vector<Seed> seeds;
  std::vector<double> material_area;      ///< m2 of each material by the case's geometry
  std::vector<double> material_area_lost; ///< m2 of it in layers too thin for a particle
};

/// Puts one particle on every sub-cell whose centre lies in the ground. The first and the last of a layer
/// take what the layer has more or less than whole sub-cells and sit at its centroid, so that every column
/// has the mass of the geometry and not of a staircase. Surfaces enter by their mean height over a column. A
/// layer thinner than half a sub-cell gets no particle; its area is reported.
Filling fill(const Case& scene);
} // namespace mpm
