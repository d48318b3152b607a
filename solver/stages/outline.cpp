#include "solver/stages/outline.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
/// Closes gaps between bins that hold ground by straight lines: torn ground leaves bins empty that are no
/// holes. Left of the first such bin and right of the last there is no ground.
void close_gaps(std::vector<double>& height)
{
  std::size_t last = height.size();
  for (std::size_t k = 0; k < height.size(); ++k)
  {
    if (std::isnan(height[k])) continue;
    for (std::size_t g = last + 1; last < k && g < k; ++g)
      height[g] = height[last] + (height[k] - height[last]) * double(g - last) / double(k - last);
    last = k;
  }
}
} // namespace

Outline::Change Outline::greatest_rise() const
{
  Change greatest{0, NAN};
  for (std::size_t k = 0; k < x.size(); ++k)
    if (end[k] - start[k] > greatest.height) greatest = {end[k] - start[k], x[k]};
  return greatest;
}

Outline::Change Outline::greatest_fall() const
{
  Change greatest{0, NAN};
  for (std::size_t k = 0; k < x.size(); ++k)
    if (start[k] - end[k] > greatest.height) greatest = {start[k] - end[k], x[k]};
  return greatest;
}

Outline outline_of(const Domain& domain, const Case& case_file)
{
  const Particles& p = domain.particles;
  const double size = case_file.grid.particle_spacing(), left = case_file.domain.left;
  const int count = static_cast<int>(std::lround(case_file.domain.width() / size));
  Outline line;
  for (int k = 0; k < count; ++k) line.x.push_back(left + (k + 0.5) * size);
  line.start.assign(count, NAN);
  line.end.assign(count, NAN);
  const auto raise = [&](std::vector<double>& height, double x, double y)
  {
    const double bin = std::floor((x - left) / size);
    if (!(bin >= 0 && bin < count && std::isfinite(y))) return; // nor what has diverged
    double& top = height[static_cast<std::size_t>(bin)];
    top = std::isnan(top) ? y + size / 2 : std::max(top, y + size / 2);
  };
  for (int k = 0; k < p.size(); ++k)
  {
    raise(line.start, p.reference_x[k], p.reference_y[k]);
    raise(line.end, p.x[k], p.y[k]);
  }
  for (const Departed& one : domain.departed) raise(line.start, one.reference_x, one.reference_y);
  close_gaps(line.start);
  close_gaps(line.end);
  return line;
}
} // namespace mpm
