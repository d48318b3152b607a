#include "test/verification/shear_band.hpp"

#include "test/scenes.hpp"

#include <numbers>
#include <stdexcept>

namespace mpm::verification
{
namespace
{
constexpr double width = 12;  // m, of the box
constexpr double speed = 0.2; // m/s, of one half past the other: slow against waves of 100 m/s
constexpr int rim = 3;        // cells, held by the grip

/// Moves every node within the rim as one of two rigid halves.
class Grip final : public Boundary
{
public:
  Grip(double cosine, double sine) : cosine_(cosine), sine_(sine) {}

  void constrain(Domain& domain) override
  {
    Grid& grid = domain.grid;
    const double inside = 0.5 * width - rim * grid.spacing;
    for (std::size_t b = 0; b < grid.blocks.size(); ++b)
      for (int k = 0; k < block_nodes; ++k)
      {
        const double x = grid.spacing * (grid.blocks[b].x * block_cells + k % block_cells) - 0.5 * width;
        const double y = grid.spacing * (grid.blocks[b].y * block_cells + k / block_cells) - 0.5 * width;
        if (std::max(std::fabs(x), std::fabs(y)) < inside) continue;
        const int node = static_cast<int>(b) * block_nodes + k;
        const double across = y * cosine_ - x * sine_;
        const double v = 0.5 * speed * ((across > 0) - (across < 0));
        grid.momentum_x[node] = grid.mass[node] * v * cosine_;
        grid.momentum_y[node] = grid.mass[node] * v * sine_;
        grid.force_x[node] = grid.force_y[node] = 0;
      }
  }

private:
  double cosine_, sine_;
};
} // namespace

BandEnergy shear_band(VonMises law, double degrees, double spacing, double slip)
{
  if (const std::string problem = law.resolve(spacing); !problem.empty()) throw std::runtime_error(problem);
  const double angle = degrees * std::numbers::pi / 180, cosine = std::cos(angle), sine = std::sin(angle);
  Domain domain = scenes::make_domain({{law, {0, 0, width, width}, spacing / 2}}, spacing);
  domain.boundaries.push_back(std::make_unique<Grip>(cosine, sine));
  sort_particles(domain);
  const double dt = 0.5 * spacing / law.pressure_speed();
  const int steps = static_cast<int>(std::lround(slip / speed / dt));
  scenes::run(domain, steps, dt);

  const double length = 0.5 * width;
  double dissipated = 0;
  const Particles& p = domain.particles;
  for (int k = 0; k < p.size(); ++k)
  {
    const double x = p.reference_x[k] - 0.5 * width, y = p.reference_y[k] - 0.5 * width;
    if (std::fabs(x * cosine + y * sine) > 0.5 * length) continue;
    dissipated += domain.materials[0].dissipated(k) * p.mass[k] / law.density;
  }
  BandEnergy result{steps * dt * speed, dissipated / length, 0, 0};
  const double root = std::sqrt(3.0), top = law.peak / root, bottom = law.residual / root;
  // The elastic shear left in the box, across its width.
  const double elastic = bottom / law.shear_modulus() * (width - 2 * rim * spacing);
  result.softening = result.dissipated - bottom * (result.slip - elastic);
  result.expected = 0.5 * (top - bottom) * law.softening_displacement;
  return result;
}
} // namespace mpm::verification
