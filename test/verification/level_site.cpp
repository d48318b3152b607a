#include "test/verification/cases.hpp"
#include "test/verification/column.hpp"

#include "test/stages/ground.hpp"

namespace mpm::verification
{
namespace
{
struct Difference
{
  double velocity = 0; ///< greatest |v - v_column|, m/s
  double greatest = 0; ///< greatest |v_column|, m/s
};

/// Greatest difference between any particle of the model and its row of the left column, over a run; surface
/// velocities of both in `curve`.
Difference compare(const Case& case_file, Curve& curve)
{
  Model model = make_model(case_file);
  if (case_file.static_stage.gravity > 0)
  {
    test::settle_at_once(model, case_file);
    test::relax(model, case_file, 2, false);
  }
  add_seismic_boundaries(model, case_file, wave_of(case_file), false);
  const double dt = test::stable_step(case_file, model);
  const Particles &p = model.main->particles, &q = model.left->domain->particles;
  std::vector<int> row(p.size());
  for (int id = 0; id < p.size(); ++id)
    row[id] = model.left->row_near(p.reference_y[model.main->particles.index_of[id]]);
  const int top = model.left->rows() - 1;
  int middle = 0; // the surface particle at the middle of the model
  for (int id = 0; id < p.size(); ++id)
  {
    const auto off = [&](int i)
    { return std::fabs(p.reference_x[model.main->particles.index_of[i]] - 0.5 * case_file.domain.width()); };
    if (row[id] == top && (row[middle] != top || off(id) < off(middle))) middle = id;
  }
  Difference worst;
  for (int k = 0; k * dt < case_file.seismic.duration; ++k)
  {
    advance(model, k * dt, dt);
    if (k % 20 != 0) continue;
    for (int i = 0; i < p.size(); ++i)
    {
      const int c = model.left->particle_of_row(row[p.id[i]]);
      worst.velocity = std::max(
          worst.velocity, std::hypot(p.velocity_x[i] - q.velocity_x[c], p.velocity_y[i] - q.velocity_y[c]));
      worst.greatest = std::max(worst.greatest, std::hypot(q.velocity_x[c], q.velocity_y[c]));
    }
    curve.x.push_back((k + 1) * dt);
    curve.model.push_back(p.velocity_x[model.main->particles.index_of[middle]]);
    curve.reference.push_back(q.velocity_x[model.left->particle_of_row(top)]);
  }
  return worst;
}
} // namespace

Findings run_level_site(const std::filesystem::path& folder, double spacing)
{
  Findings found;
  for (const bool gravity : {false, true})
  {
    const Case case_file =
        load_case(folder / "case.yaml", {"grid.spacing=" + std::to_string(spacing) + " m",
                                         gravity ? "static.gravity=9.81 m/s2" : "static.gravity=0 m/s2"});
    Curve curve{gravity ? "surface, with gravity" : "surface", "time (s)", "velocity (m/s)", {}, {}, {}};
    const Difference d = compare(case_file, curve);
    if (d.greatest < 0.3) throw std::runtime_error("level_site: the ground was not shaken");
    found.errors[gravity ? "with gravity" : "without gravity"] = d.velocity / d.greatest;
    found.curves.push_back(curve);
  }
  return found;
}
} // namespace mpm::verification
