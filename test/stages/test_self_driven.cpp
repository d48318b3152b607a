#include "solver/stages/self_driven.hpp"

#include <catch2/catch.hpp>

using namespace mpm;

namespace
{
/// 20 m2 that have moved 2 m to the right and go on at `speed` m/s.
MovedGround moving(double speed, double area = 20)
{
  MovedGround moved;
  moved.area = area;
  moved.displacement = {2, 0};
  moved.velocity = {speed, 0};
  return moved;
}
} // namespace

TEST_CASE("a slide that advances for a second without a break is self-driven", "[stages]")
{
  SelfDriven end{SlideSettings{}};
  for (int k = 0; k < 10; ++k) CHECK_FALSE(end.decide(moving(0.3), 4 + 0.1 * k));
  CHECK(end.decide(moving(0.3), 5.0));
  CHECK(end.decided() == 5.0);
  CHECK_FALSE(end.decide(moving(0), 5.1)); // it stays decided
  CHECK(end.decided() == 5.0);
}

TEST_CASE("a mass that shaking moves to and fro, or that is small, is not self-driven", "[stages]")
{
  SelfDriven shaken{SlideSettings{}}, uphill{SlideSettings{}}, small{SlideSettings{}};
  for (int k = 0; k < 200; ++k)
  {
    const double t = 0.1 * k;
    // Above the threshold for 0.87 s of each period of 1.57 s.
    CHECK_FALSE(shaken.decide(moving(0.6 * std::sin(4 * t) + 0.2), t));
    CHECK_FALSE(uphill.decide(moving(-0.5), t));
    CHECK_FALSE(small.decide(moving(1, 5), t));
  }
}

TEST_CASE("what is self-driven goes with what counts as slid, but for the time", "[stages]")
{
  SelfDriven end{SlideSettings{.moved = 0.01, .area = 0.002}};
  CHECK(end.least_speed() == Approx(0.001));
  for (int k = 0; k < 10; ++k) CHECK_FALSE(end.decide(moving(0.002, 0.003), 0.1 * k));
  CHECK(end.decide(moving(0.002, 0.003), 1.0));
  SelfDriven slow{SlideSettings{.moved = 0.01, .area = 0.002}}, usual{SlideSettings{}};
  for (int k = 0; k < 30; ++k)
  {
    CHECK_FALSE(slow.decide(moving(0.0009, 0.003), 0.1 * k));
    CHECK_FALSE(usual.decide(moving(0.002, 0.003), 0.1 * k));
  }
}

TEST_CASE("the decision goes on across a restart", "[stages]")
{
  SelfDriven first{SlideSettings{}}, second{SlideSettings{}};
  first.decide(moving(1), 3.0);
  h5::File file = h5::File::in_memory("end");
  h5::Group group = file.create_group("motion");
  first.save(group);
  second.load(group, 3.5);
  CHECK(second.decide(moving(1), 4.0));
}
