#include "test/verification/shear_band.hpp"

#include "test/domains.hpp"
#include "test/verification/cases.hpp"
#include "test/verification/infinite_slope.hpp"

#include <numbers>
#include <stdexcept>

namespace mpm::verification
{
namespace
{
constexpr int rim = 3;         // cells, held by the grip
constexpr double speed = 0.05; // m/s per m of cell, of one half past the other: slow against waves of 100 m/s
constexpr double slip = 0.5;   // m, two and a half times what softens

/// Cells across the box: 24, and 12 m. Where the grip's halves meet the rim, the slip turns the ground over
/// three times as far as it goes.
int cells_across(double spacing)
{
  return std::max(24, static_cast<int>(std::lround(12 / spacing)));
}

/// Moves every node within the rim as one of two rigid halves.
class Grip final : public Boundary
{
public:
  Grip(double cosine, double sine, double width, double speed)
      : cosine_(cosine), sine_(sine), width_(width), speed_(speed)
  {
  }

  void constrain(Grid& grid) override
  {
    const double inside = 0.5 * width_ - rim * grid.spacing;
    for (std::size_t b = 0; b < grid.blocks.size(); ++b)
      for (int k = 0; k < block_nodes; ++k)
      {
        const double x = grid.spacing * (grid.blocks[b].x * block_cells + k % block_cells) - 0.5 * width_;
        const double y = grid.spacing * (grid.blocks[b].y * block_cells + k / block_cells) - 0.5 * width_;
        if (std::max(std::fabs(x), std::fabs(y)) < inside) continue;
        const int node = static_cast<int>(b) * block_nodes + k;
        const double across = y * cosine_ - x * sine_;
        const double v = 0.5 * speed_ * ((across > 0) - (across < 0));
        grid.momentum_x[node] = grid.mass[node] * v * cosine_;
        grid.momentum_y[node] = grid.mass[node] * v * sine_;
        grid.force_x[node] = grid.force_y[node] = 0;
      }
  }

private:
  double cosine_, sine_, width_, speed_;
};
/// Part of the slip that becomes shear strain at the distance y (cells) from a band, times the cell.
double band_shape(BandPosition position, double y)
{
  const auto spline = [](double z)
  {
    const double a = std::fabs(z);
    return a < 0.5 ? 0.75 - a * a : a < 1.5 ? 0.5 * (1.5 - a) * (1.5 - a) : 0;
  };
  return position == BandPosition::within_cells ? spline(y) : 0.5 * (spline(y - 0.5) + spline(y + 0.5));
}

void check(VonMises& law, double spacing)
{
  if (const std::string problem = law.resolve(spacing); !problem.empty()) throw std::runtime_error(problem);
}

/// Table 1's soil, which softens over 0.2 m.
VonMises soil()
{
  VonMises law = domains::von_mises(70e3, 39e3, NAN, 40e6, 0.35);
  law.softening_displacement = 0.2;
  return law;
}
} // namespace

BandEnergy shear_band(VonMises law, double degrees, BandPosition position, double spacing, double slip,
                      Softening softening)
{
  check(law, spacing);
  const double angle = degrees * std::numbers::pi / 180, cosine = std::cos(angle), sine = std::sin(angle);
  const int cells = cells_across(spacing);
  const double width = spacing * (cells + (position == BandPosition::within_cells ? 1 : 0));
  Domain domain = domains::make_domain({{law, {0, 0, width, width}, spacing / 2}}, spacing);
  domain.settings.flip = softening == Softening::averaged;
  if (domain.settings.flip) domain.settings.filter = usual_filter;
  domain.settings.average_flow = softening == Softening::averaged;
  domain.boundaries.push_back(std::make_unique<Grip>(cosine, sine, width, speed * spacing));
  sort_particles(domain);
  const double dt = 0.5 * spacing / law.pressure_speed();
  open_energy_balance(domain);
  domains::run(domain, static_cast<int>(std::lround(slip / (speed * spacing) / dt)), dt);

  const double length = 0.25 * cells * spacing;
  BandEnergy result{};
  double everywhere = 0, residual = 0; // slip times length of the whole band, and what it dissipates at least
  const Particles& p = domain.particles;
  for (int k = 0; k < p.size(); ++k)
  {
    const double x = p.reference_x[k] - 0.5 * width, y = p.reference_y[k] - 0.5 * width;
    const double strain = domain.materials[0].state[0][k], volume = p.mass[k] / law.density;
    everywhere += volume * std::sqrt(3.0) * strain;
    residual += volume * law.residual * strain;
    if (std::fabs(x * cosine + y * sine) > 0.5 * length) continue;
    result.slip += volume / length * std::sqrt(3.0) * strain;
    result.dilation = std::max(result.dilation, std::fabs(p.volume[k] / volume - 1));
    result.softening += volume / length * (domain.materials[0].dissipated(k) - law.residual * strain);
  }
  // An averaged strain does not tell what a particle has dissipated; the energy balance does.
  if (softening == Softening::averaged)
    result.softening = (energies_of(domain)[Energy::plastic] - residual) * result.slip / everywhere;
  return result;
}

double softening_energy(const VonMises& law)
{
  return 0.5 * (law.peak - law.residual) / std::sqrt(3.0) * law.softening_displacement;
}

double spline_band_energy(VonMises law, BandPosition position, double spacing, double slip)
{
  check(law, spacing);
  double sum = 0;
  for (double y = -1.75; y < 2; y += 0.5)
  {
    const double strain = slip / (std::sqrt(3.0) * spacing) * band_shape(position, y);
    const double left = 1 - std::min(1.0, strain / law.softening_strain); // of the softening
    sum += 0.5 * spacing * 0.5 * (law.peak - law.residual) * law.softening_strain * (1 - left * left);
  }
  return sum;
}

Findings run_shear_band(const std::filesystem::path&, double h)
{
  constexpr auto within = BandPosition::within_cells, on = BandPosition::on_nodes;
  const VonMises law = soil();
  const auto band = [&](double degrees, BandPosition position, Softening softening)
  { return shear_band(law, degrees, position, h, slip, softening); };
  const auto error = [&](const BandEnergy& found)
  { return std::fabs(found.softening / softening_energy(law) - 1); };
  Findings found;
  for (const Softening softening : {Softening::local, Softening::averaged})
  {
    const BandEnergy in_cells = band(0, within, softening), on_nodes = band(0, on, softening);
    const std::string name = softening == Softening::averaged ? " degrees" : " degrees, local";
    found.errors["0" + name] = std::max(error(in_cells), error(on_nodes));
    for (const auto& [degrees, text] : {std::pair{22.5, "22.5"}, {45.0, "45"}})
      found.errors[text + name] = error(band(degrees, on, softening));
    if (softening == Softening::averaged) continue;
    found.errors["within cells"] =
        std::fabs(in_cells.softening / spline_band_energy(law, within, h, in_cells.slip) - 1);
    found.errors["on nodes"] =
        std::fabs(on_nodes.softening / spline_band_energy(law, on, h, on_nodes.slip) - 1);
  }
  return found;
}
} // namespace mpm::verification
