#include "solver/stages/departures.hpp"

#include "solver/mpm/health.hpp"

#include <algorithm>
#include <cmath>

namespace mpm
{
namespace
{
constexpr double margin = 1; // cells beyond its own edge at which ground has left

/// A side as it stands now: x over y, from the base upwards; the last point holds above.
struct SideLine
{
  Edge edge;
  std::vector<double> y, x; ///< m

  int outward() const { return edge == Edge::right ? 1 : -1; }
  double at(double height) const
  {
    const auto next = std::upper_bound(y.begin(), y.end(), height) - y.begin();
    return x[std::max<std::ptrdiff_t>(0, next - 1)];
  }
  /// The point furthest in.
  double innermost() const
  {
    return edge == Edge::right ? *std::min_element(x.begin(), x.end())
                               : *std::max_element(x.begin(), x.end());
  }
};

/// Follows the faces of a side upwards as long as they hang together: a slide may shear the upper ones off,
/// and they are then no side any more.
SideLine line_of(const FreeFieldSide& side, const Domain& domain, double size)
{
  const Particles& p = domain.particles;
  SideLine line{side.edge(), {}, {}};
  double last = NAN; // displacement of the face below
  for (const Face& face : side.faces())
  {
    const int k = domain.particles.index_of[face.particle];
    const double u = p.x[k] - p.reference_x[k];
    if (std::fabs(u - last) > size) break;
    last = u;
    line.x.push_back(p.x[k] + face.offset_x);
    line.y.push_back(p.y[k] + face.offset_y);
  }
  return line;
}

/// Where a point is and was in the undeformed ground, m.
struct Path
{
  double x, y, reference_x, reference_y;
};

/// The edges of the model as they stand now.
struct Edges
{
  const Case& case_file;
  std::vector<SideLine> sides;
  double base = -INFINITY; ///< y, m

  Edges(const Model& model, const Case& of) : case_file(of)
  {
    const Domain& main = *model.main;
    const Particles& p = main.particles;
    std::vector<std::array<double, 2>> moved; // of the base's faces, from the left to the right
    if (model.base)
      for (const Face& face : model.base->faces())
      {
        const int k = main.particles.index_of[face.particle];
        moved.push_back({p.x[k] - p.reference_x[k], p.y[k] - p.reference_y[k]});
      }
    if (model.base) base = case_file.domain.bottom;
    // The base is as low as its lowest face: ground above it has not passed it.
    double sunk = INFINITY;
    for (const auto& [x, y] : moved) sunk = std::min(sunk, y);
    if (!moved.empty()) base += sunk;
    for (const FreeFieldSide* side : model.sides)
    {
      SideLine line = line_of(*side, main, case_file.grid.particle_spacing());
      if (line.x.empty()) // no ground there
      {
        const bool left = side->edge() == Edge::left;
        line.y.push_back(case_file.domain.bottom);
        line.x.push_back(position(side->edge()) +
                         (moved.empty() ? 0 : (left ? moved.front() : moved.back())[0]));
      }
      sides.push_back(std::move(line));
    }
  }

  double position(Edge edge) const
  {
    return edge == Edge::left ? case_file.domain.left : case_file.domain.right;
  }

  /// The edge that a point has passed.
  std::optional<Edge> passed(const Path& p) const
  {
    const double h = case_file.grid.spacing;
    const auto grace = [h](double from_edge)
    { return std::fabs(from_edge) <= image_cells * h ? margin * h : 0; };
    for (const SideLine& side : sides)
      if (side.outward() * (p.x - side.at(p.y)) > grace(p.reference_x - position(side.edge)))
        return side.edge;
    if (p.y < base - grace(p.reference_y - case_file.domain.bottom)) return Edge::bottom;
    return {};
  }
};

/// Whether particles of a block may have passed an edge: they stand within a cell of it.
bool may_have_passed(const Edges& edges, const Grid& grid, BlockIndex block)
{
  const double h = grid.spacing, size = (block_cells + 1) * h;
  const double x = grid.origin_x + h * (block_cells * block.x),
               y = grid.origin_y + h * (block_cells * block.y);
  for (const SideLine& side : edges.sides)
    if (side.edge == Edge::right ? x + size > side.innermost() : x - h < side.innermost()) return true;
  return y - h < edges.base;
}
/// Name of an edge for people.
std::string edge_name(Edge edge)
{
  return edge == Edge::left ? "left side" : edge == Edge::right ? "right side" : "base";
}

} // namespace

Departure departure(const Model& model, std::optional<Edge> edge)
{
  Departure sum;
  for (const Departed& one : model.main->departed)
  {
    if (edge && one.edge != *edge) continue;
    if (std::isnan(sum.first)) sum.first = one.time;
    sum.area += model.reference_volume[one.particle];
    sum.mass += one.mass;
  }
  return sum;
}

/// Particles that have passed an edge, by index. Only blocks near an edge are looked at, since this is done
/// every few steps.
std::vector<Leaving> Departures::find_leaving() const
{
  const Domain& main = *model_.main;
  const Edges edges(model_, session_.case_file);
  const Particles& p = main.particles;
  std::vector<Leaving> leaving;
  for (const OccupiedBlock& occupied : main.blocks.occupied)
  {
    if (!may_have_passed(edges, main.grid, occupied.block)) continue;
    for (const ParticleRange& range : occupied.ranges)
      for (int k = range.begin; k < range.end; ++k)
        if (const auto edge = edges.passed({p.x[k], p.y[k], p.reference_x[k], p.reference_y[k]}))
          leaving.push_back({k, *edge});
  }
  std::sort(leaving.begin(), leaving.end(),
            [](const Leaving& a, const Leaving& b) { return a.index < b.index; });
  return leaving;
}

bool Departures::take_out(double time)
{
  lose_gauges(time);
  const std::vector<Leaving> leaving = find_leaving();
  if (leaving.empty()) return false;
  check_places(*model_.main); // what has jumped has not left
  const std::size_t before = model_.main->departed.size();
  model_.main->time = time;
  remove_particles(*model_.main, leaving);
  announce(before);
  return true;
}

/// A gauge leaves with its ground.
void Departures::lose_gauges(double time)
{
  Domain& main = *model_.main;
  if (main.gauges.empty()) return;
  const Edges edges(model_, session_.case_file);
  for (std::size_t k = 0; k < main.gauges.size(); ++k)
  {
    Gauge& gauge = main.gauges[k];
    const auto edge = edges.passed({gauge.x, gauge.y, gauge.reference_x, gauge.reference_y});
    if (!edge) continue;
    gauge.x = gauge.y = gauge.velocity_x = gauge.velocity_y = NAN;
    session_.log.warn("gauge {}: its ground passed the {} at t = {:.2f} s; from then on it has no values",
                      session_.case_file.output.gauges.points[k].name, edge_name(*edge), time);
  }
}

/// Warns when the first ground of the run leaves by an edge; `before`: how many had left until now.
void Departures::announce(std::size_t before) const
{
  const std::vector<Departed>& all = model_.main->departed;
  for (const Edge edge : {Edge::left, Edge::right, Edge::bottom})
  {
    const auto passed = [edge](const Departed& one) { return one.edge == edge; };
    const auto first = std::find_if(all.begin(), all.end(), passed);
    if (first == all.end() || first - all.begin() < static_cast<std::ptrdiff_t>(before)) continue;
    session_.log.warn(
        "t = {:.2f} s: ground passes the {} and leaves the model, where nothing carries it: it is "
        "taken out of the computation and of all measures",
        first->time, edge_name(edge));
  }
}

void Departures::report() const
{
  for (const Edge edge : {Edge::left, Edge::right, Edge::bottom})
  {
    const Departure left = departure(model_, edge);
    if (left.mass == 0) continue;
    session_.log.warn("{:.2f} m2 of ground ({:.4g} kg/m) have passed the {}, the first at t = {:.2f} s: "
                      "run-out, moved area "
                      "and velocities are those of the ground that is still in the model; {}",
                      left.area, left.mass, edge_name(edge), left.first,
                      edge == Edge::bottom
                          ? "let ground cover the whole base, or take seismic.base.kind fixed"
                          : "widen the domain there");
  }
}
} // namespace mpm
