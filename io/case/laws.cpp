#include "io/case/sections.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mpm
{
namespace
{
/// Greatest mean in-plane pressure in Pa of each material under the ground's own weight at rest, the
/// horizontal stress being nu / (1 - nu) of the vertical one.
std::vector<double> pressures_at_rest(const Case& case_file)
{
  std::vector<double> greatest(case_file.materials.size(), 0.0);
  const double h = case_file.grid.spacing;
  for (double x = case_file.domain.left; x < case_file.domain.right - 0.5 * h; x += h)
  {
    const std::vector<Layer> layers = case_file.layers(x, x + h);
    double weight = 0;
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) // from the top
    {
      const int m = case_file.regions[layer->region].material;
      const Elastic& law = case_file.materials[m].elastic();
      weight += law.density * case_file.static_stage.gravity * (layer->top - layer->bottom);
      const double at_rest = law.poisson / (1 - law.poisson);
      greatest[m] = std::max(greatest[m], 0.5 * (1 + at_rest) * weight);
    }
  }
  return greatest;
}
} // namespace

void warn_of_laws(Case& case_file)
{
  const std::vector<double> pressures = pressures_at_rest(case_file);
  for (std::size_t m = 0; m < case_file.materials.size(); ++m)
  {
    const Material& material = case_file.materials[m];
    const std::string key = "materials." + material.name;
    const auto texts =
        std::visit([&](const auto& law) { return law.warnings(case_file.grid.spacing); }, material.law);
    for (const std::string& text : texts) case_file.warnings.push_back(key + "." + text);
    const double limit = std::visit([](const auto& law) { return law.snap_back_pressure(); }, material.law);
    if (pressures[m] > limit)
      case_file.warnings.push_back(fmt::format(
          "{}: weakens so fast that its stress snaps back, to the end of its softening at once, where the "
          "pressure is above {:.4g} kPa, and the ground at rest reaches {:.4g} kPa; soften over a longer "
          "displacement, or a smaller width or thickness",
          key, 1e-3 * limit, 1e-3 * pressures[m]));
  }
}
} // namespace mpm
