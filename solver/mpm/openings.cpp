#include "solver/mpm/domain.hpp"

#include <cmath>

namespace mpm
{
namespace
{
void limit(Material& material, double* volume, double largest)
{
  std::vector<double>& opening = *material.field("opening");
  for (std::size_t k = 0; k < opening.size(); ++k)
  {
    if (volume[k] <= largest) continue;
    const double less = std::min(opening[k], std::log(volume[k] / largest));
    if (less > 0)
      for (const char* tensor : {"opening_xx", "opening_yy", "opening_xy"})
        if (std::vector<double>* field = material.field(tensor)) (*field)[k] *= 1 - less / opening[k];
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
    if (domain.materials[m].field("opening") == nullptr) continue;
    limit(domain.materials[m], &domain.particles.volume[domain.material_begin[m]], reach * reach);
  }
}
} // namespace mpm
