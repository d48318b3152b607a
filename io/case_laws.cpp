#include "io/case_sections.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mpm
{
namespace
{
/// Greatest mean in-plane pressure in Pa of each material under the ground's own weight at rest, the
/// horizontal stress being nu / (1 - nu) of the vertical one.
std::vector<double> pressures_at_rest(const Case& scene)
{
  std::vector<double> greatest(scene.materials.size(), 0.0);
  const double h = scene.grid.spacing;
  for (double x = scene.domain.left; x < scene.domain.right - 0.5 * h; x += h)
  {
    const std::vector<Layer> layers = scene.layers(x, x + h);
    double weight = 0;
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) // from the top
    {
      const int m = scene.regions[layer->region].material;
      const Elastic& law = scene.materials[m].elastic();
      weight += law.density * scene.statics.gravity * (layer->top - layer->bottom);
      const double at_rest = law.poisson / (1 - law.poisson);
      greatest[m] = std::max(greatest[m], 0.5 * (1 + at_rest) * weight);
    }
  }
  return greatest;
}
} // namespace

void warn_of_laws(Case& scene)
{
  const std::vector<double> pressures = pressures_at_rest(scene);
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
  {
    const Material& material = scene.materials[m];
    const std::string key = "materials." + material.name;
    const auto texts =
        std::visit([&](const auto& law) { return law.warnings(scene.grid.spacing); }, material.law);
    for (const std::string& text : texts) scene.warnings.push_back(key + "." + text);
    const double limit = std::visit([](const auto& law) { return law.snap_back_pressure(); }, material.law);
    if (pressures[m] > limit)
      scene.warnings.push_back(fmt::format(
          "{}: weakens so fast that its stress snaps back, to the end of its softening at once, where the "
          "pressure is above {:.4g} kPa, and the ground at rest reaches {:.4g} kPa; soften over a longer "
          "displacement, or a smaller width or thickness",
          key, 1e-3 * limit, 1e-3 * pressures[m]));
  }
}
} // namespace mpm
