#include "solver/stages/flip_blend.hpp"

#include <catch2/catch.hpp>

using namespace mpm;

TEST_CASE("the share of FLIP fades within a second once ground has slid", "[stages]")
{
  FlipBlend flip(0.8, FlipEnds::on_slide);
  flip.note(false, 2);
  CHECK(flip.at(3) == 0.8);
  flip.note(true, 4);
  flip.note(true, 4.5); // it began to fade at 4 s
  CHECK(flip.at(4) == 0.8);
  CHECK(flip.at(4.5) == Approx(0.4));
  CHECK(flip.at(4 + FlipBlend::fade) == 0);
  CHECK(flip.at(90) == 0);
}

TEST_CASE("a share of FLIP that never ends is kept through the run-out", "[stages]")
{
  FlipBlend flip(0.8, FlipEnds::never);
  flip.note(true, 4);
  CHECK(flip.at(90) == 0.8);
}

TEST_CASE("the share of FLIP goes on fading across a restart", "[stages]")
{
  for (const FlipEnds ends : {FlipEnds::on_slide, FlipEnds::never})
  {
    FlipBlend first(0.8, ends), second(0.8, ends);
    first.note(true, 4);
    h5::File file = h5::File::in_memory("flip");
    h5::Group group = file.create_group("motion");
    first.save(group);
    second.load(group, 5);
    CHECK(second.at(4.25) == first.at(4.25));
  }
}
