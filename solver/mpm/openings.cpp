#include "solver/mpm/domain.hpp"

#include <cmath>

namespace mpm
{
namespace
{
void limit(std::vector<double>& opening, double* volume, double largest)
{
  for (std::size_t k = 0; k < opening.size(); ++k)
  {
    if (volume[k] <= largest) continue;
    const double less = std::min(opening[k], std::log(volume[k] / largest));
    opening[k] -= less;
    volume[k] *= std::exp(-less);
  }
}
} // namespace

void limit_openings(Domain& domain)
{
  const double reach = 4 * domain.grid.spacing;
  for (std::size_t m = 0; m < domain.materials.size(); ++m)
  {
    std::vector<double>* opening = domain.materials[m].field("opening");
    if (opening == nullptr) continue;
    limit(*opening, &domain.particles.volume[domain.material_begin[m]], reach * reach);
  }
}
} // namespace mpm
