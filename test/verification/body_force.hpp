#pragma once

#include "solver/mpm/domain.hpp"
#include "solver/mpm/spline.hpp"

#include <array>
#include <functional>

namespace mpm::verification
{
/// Body acceleration b(particle, t) in m/s2, evaluated at the particles as gravity would be: f_i += m_p w_ip
/// b_p. Taken at the middle of the step, where positions and stresses stand (velocities are half a step
/// behind).
class BodyForce final : public Boundary
{
public:
  using Field = std::function<std::array<double, 2>(const Particles&, int particle, double time)>;
  explicit BodyForce(Field field) : field_(std::move(field)) {}

  void add_forces(Domain& domain, double dt) override
  {
    Grid& g = domain.grid;
    const Particles& p = domain.particles;
    NodeFinder find(g);
    for (int k = 0; k < p.size(); ++k)
    {
      const auto [bx, by] = field_(p, k, domain.time + 0.5 * dt);
      const Stencil sx = cubic_stencil(p.x[k] - g.origin_x, g.spacing);
      const Stencil sy = cubic_stencil(p.y[k] - g.origin_y, g.spacing);
      find.move_to(sx.first, sy.first);
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
        {
          const int node = find(sx.first + i, sy.first + j);
          const double m = p.mass[k] * sx.weight[i] * sy.weight[j];
          g.force_x[node] += m * bx;
          g.force_y[node] += m * by;
        }
    }
  }

private:
  Field field_;
};
} // namespace mpm::verification
