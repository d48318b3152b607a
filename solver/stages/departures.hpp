#pragma once

#include "solver/stages/model.hpp"
#include "solver/stages/session.hpp"

namespace mpm
{
/// Takes ground that has passed a side or the base out of the model, and tells of it.
///
/// Beyond the model nothing carries ground: debris that runs over a side falls without end, and takes forces
/// from what stands for the ground beyond, at nodes that hardly have mass. So it has left as soon as it has
/// passed. Ground from within four cells of an edge is the edge's own: it deforms with it, and images (and
/// ghosts), which fill four cells beyond, balance the nodes up to two cells out, which it reaches from no
/// more than one cell out. That far it may go. A side moves: it is where its own faces are, from the base
/// upwards, as far as each is within a particle spacing of the one below; what lies above has been sheared
/// off, and the side stands where the last of them is. Mirrored walls (roller sides, a fixed base) let
/// nothing pass.
class Departures
{
public:
  static constexpr int every = 10; ///< steps between looks

  Departures(Session& session, Model& model) : session_(session), model_(model) {}
  /// Looks for ground that has left, at time t (s), takes it out and warns when it is the first at its edge.
  /// Returns whether any has.
  bool take_out(double time);
  /// Warns of all that has left.
  void report() const;

private:
  std::vector<Leaving> find_leaving() const;
  void lose_gauges(double time);
  void announce(std::size_t before) const;

  Session& session_;
  Model& model_;
};

/// Area of the undeformed ground that has left (m2) and its mass (kg per m), by an edge or by all.
struct Departure
{
  double area = 0, mass = 0, first = NAN; ///< `first`: when the first of it left, s
};
Departure departure(const Model& model, std::optional<Edge> edge = {});
} // namespace mpm
