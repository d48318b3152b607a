#include "boundaries/base_spring.hpp"

#include <cmath>

namespace mpm
{
namespace
{
constexpr double lag = 0.5;      // of the spring behind the base, in T
constexpr double take_over = 10; // time in which the reaction takes over a lasting load, in T

void visit_vectors(StateVisitor& visitor, std::string prefix, std::vector<std::array<double, 2>>& vectors)
{
  RecordVisitor<std::array<double, 2>> list(visitor, std::move(prefix), vectors);
  list.each("x", "m", [](auto& vector) -> double& { return vector[0]; });
  list.each("y", "m", [](auto& vector) -> double& { return vector[1]; });
}
} // namespace

std::array<double, 2> free_field_displacement(const std::vector<FreeFieldBase>& sides, double x,
                                              const std::array<double, 2>& otherwise)
{
  if (sides.empty()) return otherwise;
  const FreeFieldBase &a = sides.front(), &b = sides.back();
  if (sides.size() == 1 || a.x == b.x) return a.displacement;
  const double share = (x - a.x) / (b.x - a.x);
  return {a.displacement[0] + share * (b.displacement[0] - a.displacement[0]),
          a.displacement[1] + share * (b.displacement[1] - a.displacement[1])};
}

std::vector<std::array<double, 2>> BaseSpring::follow(const std::vector<std::array<double, 2>>& distance,
                                                      double dt)
{
  std::vector<std::array<double, 2>> far_end(distance.size());
  stretch_.resize(distance.size(), {});
  reaction_.resize(distance.size(), {});
  const double share = -std::expm1(-dt / (lag * time_)); // exact for a distance that stays over the step
  const double learnt = dt / (take_over * time_), inverse = 1 / time_;
  for (std::size_t k = 0; k < distance.size(); ++k)
    for (int c = 0; c < 2; ++c)
    {
      stretch_[k][c] += share * (distance[k][c] - stretch_[k][c]);
      reaction_[k][c] += learnt * stretch_[k][c];
      far_end[k][c] = inverse * (stretch_[k][c] + reaction_[k][c]);
    }
  return far_end;
}

void BaseSpring::drop(std::size_t face)
{
  for (auto* list : {&stretch_, &reaction_})
    if (face < list->size()) list->erase(list->begin() + static_cast<std::ptrdiff_t>(face));
}

void BaseSpring::visit_state(StateVisitor& visitor)
{
  visit_vectors(visitor, "spring_stretch_", stretch_);
  visit_vectors(visitor, "spring_reaction_", reaction_);
}
} // namespace mpm
