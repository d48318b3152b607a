#include "solver/stages/self_driven.hpp"

namespace mpm
{
bool SelfDriven::decide(const MovedGround& moved, double time)
{
  constexpr double rounding = 1e-9; // of times that are multiples of a step
  if (!std::isnan(decided_)) return false;
  if (moved.area < slide_.area || moved.advance() < least_speed())
  {
    since_ = NAN;
    return false;
  }
  if (std::isnan(since_)) since_ = time;
  if (time - since_ < hold - rounding) return false;
  decided_ = time;
  return true;
}

void SelfDriven::save(h5::Group& group) const
{
  group.attribute("since", since_);
  group.attribute("decided", decided_);
}

void SelfDriven::load(const h5::Group& group, double now)
{
  since_ = group.attribute_double("since");
  decided_ = group.attribute_double("decided");
  for (const double time : {since_, decided_})
    if (time < 0 || time > now)
      throw Error(exit_code::bad_input,
                  group.where() + ": the slide is self-driven at a time that has not come");
}
} // namespace mpm
