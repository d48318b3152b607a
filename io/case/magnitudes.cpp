// Values that no ground has, or hardly any: mostly a unit that went wrong.

#include "io/case/sections.hpp"

#include <fmt/format.h>

#include <numbers>

namespace mpm
{
namespace
{
/// What a quantity usually is, in SI units times `unit`.
struct Usual
{
  std::string_view key; ///< of a material
  double low, high;
  double unit;
  std::string_view name; ///< of the unit
  std::string_view cause;
};

constexpr double unbalanced_of_one =
    0.05; // share of the forces that one particle a cell may leave so, in low ground
constexpr double kilopascal = 1e3, megapascal = 1e6, degree = std::numbers::pi / 180;
// Wide enough for anything from soft clay to fresh rock, and from the laboratory to a mountain side.
constexpr std::array usual{
    Usual{"density", 800, 4000, 1, "kg/m3", "is it in t/m3 or g/cm3?"},
    Usual{"young_modulus", 0.1, 2e5, megapascal, "MPa", "is it in kPa, MPa or GPa?"},
    Usual{"poisson_ratio", 0, 0.5, 1, "", "is the sign right?"},
    Usual{"strength.peak", 0.5, 1e6, kilopascal, "kPa", "is it in Pa, kPa or MPa?"},
    Usual{"cohesion.peak", 0, 1e6, kilopascal, "kPa", "is it in Pa, kPa or MPa?"},
    Usual{"friction_angle.peak", 3, 60, degree, "deg", "is it in deg or rad?"},
    Usual{"friction.peak", 0.05, 2, 1, "", "it is a coefficient, tan(phi), not an angle"},
    Usual{"softening.displacement", 1e-4, 10, 1, "m", "is it in mm, cm or m?"},
    Usual{"softening.strain", 1e-5, 10, 1, "", "it is a strain, not in percent"},
    Usual{"critical_slip", 1e-6, 10, 1, "m", "is it in mm, cm or m?"},
};

void warn(Case& case_file, const std::string& key, double value, double low, double high,
          std::string_view unit, std::string_view cause)
{
  const std::string of = unit.empty() ? "" : " " + std::string(unit);
  case_file.warnings.push_back(fmt::format("{}: {:.4g}{}, where {:.4g} to {:.4g}{} is usual: {}", key, value,
                                           of, low, high, of, cause));
}

void warn_outside(Case& case_file, const std::string& key, double value, double low, double high,
                  std::string_view unit, std::string_view cause)
{
  if (!(value >= low && value <= high)) warn(case_file, key, value, low, high, unit, cause);
}

/// The parameters of a material that its law has in the table.
void warn_of_parameters(Case& case_file, const Material& material)
{
  std::visit(
      [&]<class L>(const L& law)
      {
        for (const auto& parameter : L::parameters())
          for (const Usual& u : usual)
            if (const double value = law.*parameter.value; parameter.key == u.key && std::isfinite(value))
              warn_outside(case_file, "materials." + material.name + "." + std::string(u.key), value / u.unit,
                           u.low, u.high, u.name, u.cause);
      },
      material.law);
}

/// Stress at first yield over Young's modulus: no ground yields at strains of ten percent.
void warn_of_strength(Case& case_file, const Material& material)
{
  std::visit(
      [&]<class L>(const L& law)
      {
        for (const auto& parameter : L::parameters())
          if ((parameter.key == "strength.peak" || parameter.key == "cohesion.peak") &&
              law.*parameter.value > 0.1 * law.young)
            case_file.warnings.push_back(
                fmt::format("materials.{}.{}: {:.4g} kPa is {:.2g} of young_modulus, "
                            "where less than 0.01 is usual: the ground "
                            "would bend instead of yield; are both units right?",
                            material.name, parameter.key, law.*parameter.value / kilopascal,
                            law.*parameter.value / law.young));
      },
      material.law);
}

/// v_s = sqrt(G / rho): 20 m/s is the softest mud, 6000 m/s faster than any rock.
void warn_of_speeds(Case& case_file, const Material& material)
{
  warn_outside(case_file, "materials." + material.name + ": S waves", material.elastic().shear_speed(), 20,
               6000, "m/s", "look at young_modulus, poisson_ratio and density");
}

/// Waves so fast or slow, or masses so small, that numbers do not hold what follows from them.
void refuse_beyond_numbers(const Case& case_file, const YamlNode& tree, Problems& problems)
{
  for (const Material& material : case_file.materials)
  {
    const Elastic& law = material.elastic();
    const double speed = law.pressure_speed();
    if (law.density > 1e-6 && law.density < 1e9 && speed > 1e-4 && speed < 1e7) continue;
    const YamlNode& node = *tree.child("materials")->child(material.name);
    problems.add(node.location, node.path,
                 fmt::format("a density of {:.3g} kg/m3 and P waves of {:.3g} m/s are beyond what can be "
                             "computed; correct density, young_modulus or poisson_ratio",
                             law.density, speed));
  }
}

void warn_of_settings(Case& case_file)
{
  if (const double g = case_file.static_stage.gravity; g != 0)
    warn_outside(case_file, "static.gravity", g, 1, 20, "m/s2", "is it in m/s2, cm/s2 or g?");
  // A load that grows within a period of the ground overshoots, by a factor of up to two.
  if (const double period = case_file.longest_period();
      case_file.static_stage.gravity != 0 && case_file.static_stage.ramp < period)
    case_file.warnings.push_back(
        fmt::format("static.ramp: {:.4g} s is shorter than the ground's longest period, "
                    "{:.3g} s: gravity comes as a blow, under "
                    "which ground yields that would stand; is it in s?",
                    case_file.static_stage.ramp, period));
  if (const StaticSettings& s = case_file.static_stage;
      s.gravity != 0 && case_file.grid.particles_per_cell == 1 && s.until.unbalanced < unbalanced_of_one)
    case_file.warnings.push_back(fmt::format(
        "grid.particles_per_cell: with 1 there are fewer stresses than nodes to balance: 0.3 to 2 % of the "
        "forces stay unbalanced in ground of 40 to 10 cells, and static.until.unbalanced, {:g}, is not "
        "reached; give 2 (map particles of cases/verification/ATLAS.md)",
        s.until.unbalanced));
  const double t = case_file.seismic.duration;
  if (!(t > 0)) return; // it has none, or goes with its record, which is judged itself
  warn_outside(case_file, "seismic.duration", t, 0.1, 3600, "s", "is it in s, min or h?");
  warn_outside(case_file, "seismic.rest_below", case_file.seismic.rest_below, 0, 0.01, "m/s",
               "a slide that is slower comes to rest; is it in mm/s, cm/s or m/s?");
  // Each frame is a file of its own.
  const double frames = t / case_file.output.frames.every;
  if (frames > 10000)
    case_file.warnings.push_back(fmt::format(
        "output.frames.every: makes {:.3g} frames in {:.4g} s, where less than 1000 are usual; is it in s?",
        frames, t));
}

/// Greatest weight upon a material in level columns anywhere (its own included), Pa; height of the ground, m.
struct Overburden
{
  std::vector<double> stress; ///< by material, at its lowest point
  double strain = 0;          ///< greatest vertical strain under the own weight
  double height = 0;
  int softest = -1; ///< material of the greatest strain
};

Overburden overburden(const Case& case_file)
{
  // Fine enough for a warning, and independent of the cells.
  constexpr int strips = 200;
  Overburden most;
  most.stress.assign(case_file.materials.size(), 0);
  const double step = case_file.domain.width() / strips;
  for (int k = 0; k < strips; ++k)
  {
    const double x = case_file.domain.left + (k + 0.5) * step;
    std::vector<Layer> column = case_file.layers(x, x);
    double weight = 0, height = 0;
    for (auto layer = column.rbegin(); layer != column.rend(); ++layer)
    {
      const int material = case_file.regions[layer->region].material;
      const Elastic& law = case_file.materials[material].elastic();
      weight += law.density * case_file.static_stage.gravity * (layer->top - layer->bottom);
      height += layer->top - layer->bottom;
      most.stress[material] = std::max(most.stress[material], weight);
      if (const double strain = weight / law.p_modulus(); strain > most.strain)
      {
        most.strain = strain;
        most.softest = material;
      }
    }
    most.height = std::max(most.height, height);
  }
  return most;
}

void warn_of_weight(Case& case_file, const Overburden& most)
{
  if (most.strain > 0.1)
    case_file.warnings.push_back(fmt::format(
        "materials.{}: {} under the weight upon it is strained by {:.2g}, "
        "where less than 0.01 is usual: elastic "
        "laws hold for small strains; look at young_modulus, density, "
        "static.gravity and the size of the domain",
        case_file.materials[most.softest].name, case_file.materials[most.softest].name, most.strain));
  if (const double cells = most.height / case_file.grid.spacing; cells < 4)
    case_file.warnings.push_back(
        fmt::format("grid.spacing: the ground is {:.2g} cells high where it is highest, "
                    "and four are the least for any answer; "
                    "is it in m, cm or mm?",
                    cells));
}

/// Least ratio of horizontal to vertical stress with which level ground of a law with friction does not yield
/// under a weight (Pa).
double least_ratio(const Elastic&, double)
{
  return -INFINITY;
}

/// s_v - N K0 s_v = 2 c sqrt(N), N = (1 + sin phi) / (1 - sin phi).
double least_ratio(const MohrCoulomb& law, double weight)
{
  const double s = std::sin(law.friction_peak), N = (1 + s) / (1 - s);
  return (1 - 2 * law.cohesion_peak * std::sqrt(N) / weight) / N;
}

/// sqrt(J2) = (1 - K0) s_v / sqrt 3 and p = (1 + 2 K0) s_v / 3.
double least_ratio(const SlipWeakening& law, double)
{
  const double s = law.mobilised(law.friction_peak);
  return (std::sqrt(3.0) - s) / (std::sqrt(3.0) + 2 * s);
}

void warn_of_yield_at_rest(Case& case_file, const Overburden& most)
{
  for (std::size_t m = 0; m < case_file.materials.size(); ++m)
  {
    const double weight = most.stress[m];
    if (!(weight > 0)) continue;
    const Elastic& law = case_file.materials[m].elastic();
    const double least =
        std::visit([&](const auto& l) { return least_ratio(l, weight); }, case_file.materials[m].law);
    // Elastic ground that settles between rollers: s_h = nu / (1 - nu) s_v.
    const double ratio = law.poisson / (1 - law.poisson);
    if (ratio >= least * (1 - 1e-9)) continue;
    case_file.warnings.push_back(fmt::format(
        "materials.{}.poisson_ratio: {:.3g} gives a horizontal stress at "
        "rest of K0 = nu/(1 - nu) = {:.3g} of the "
        "vertical one, and under {:.3g} kPa the law allows no less than K0 "
        "= {:.3g} (poisson_ratio {:.3g}): level "
        "ground yields under its own weight, and softens if the law does",
        case_file.materials[m].name, law.poisson, ratio, weight / kilopascal, least, least / (1 + least)));
  }
}
} // namespace

void check_magnitudes(Case& case_file, const YamlNode& tree, Problems& problems)
{
  const std::size_t before = problems.count();
  refuse_beyond_numbers(case_file, tree, problems);
  if (problems.count() > before) return;
  for (const Material& material : case_file.materials)
  {
    warn_of_parameters(case_file, material);
    warn_of_strength(case_file, material);
    warn_of_speeds(case_file, material);
  }
  warn_of_settings(case_file);
  const Overburden most = overburden(case_file);
  warn_of_weight(case_file, most);
  if (case_file.static_stage.gravity > 0) warn_of_yield_at_rest(case_file, most);
}
} // namespace mpm
