#pragma once

#include "io/case/case.hpp"
#include "solver/mpm/domain.hpp"

namespace mpm
{
/// Height of the free surface over x, in bins of one particle spacing over the width of the domain (m).
struct Outline
{
  std::vector<double> x, start,
      end; ///< `start`: when the shaking began; `end`: now. NaN where there is no ground

  struct Change
  {
    double height, x; ///< m; NaN where the ground has not changed its outline
  };
  Change greatest_rise() const;
  Change greatest_fall() const;
};

/// The top of the highest particle in each bin, that is its centre and half a particle spacing.
Outline outline_of(const Domain& domain, const Case& case_file);
} // namespace mpm
