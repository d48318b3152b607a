#pragma once

#include "test/domains.hpp"
#include "test/materials/point.hpp"

#include <catch2/catch.hpp>

#include <numbers>

namespace point
{
inline constexpr double degree = std::numbers::pi / 180;

/// The landslide mass of the paper's Table 2.
inline MohrCoulomb rock()
{
  MohrCoulomb law = domains::mohr_coulomb(38.5, 980e3);
  law.young = 3.6e9;
  law.density = 2450;
  law.friction_residual = 18.9 * degree;
  law.cohesion_residual = 0;
  law.softening_strain = 0.01;
  REQUIRE(law.resolve(1).empty());
  return law;
}
} // namespace point
