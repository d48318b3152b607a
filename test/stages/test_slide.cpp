// Measures of the run-out, on ground that is moved by hand.

#include "solver/stages/outline.hpp"
#include "solver/stages/slide.hpp"
#include "test/stages/ground.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// Level ground, 20 m wide and 6 m high, two particles a cell of 1 m; its soil of the top 2 m slides from x
/// in (4, 8).
struct SlidingBlock
{
  Case case_file = case_from(level_ground(1, 2, 20, 4, 6, 9.81));
  Model model = make_model(case_file);
  Slide slide{model, case_file};
  History history;
  History::Clock clock = history.add_clock();

  explicit SlidingBlock(const SlideSettings& settings = {})
  {
    case_file.output.slide = settings;
    slide.add_series(history, clock);
  }

  static bool slides(double x, double y) { return x > 4 && x < 8 && y > 4; }

  /// Everything moves with the base by `base` m, the block by (ux, uy) m on top of it; likewise the
  /// velocities.
  void move(double base, double ux, double uy, double base_speed, double vx, double vy)
  {
    for (const auto& [part, domain] : model.domains())
    {
      Particles& p = domain->particles;
      for (int k = 0; k < p.size(); ++k)
      {
        const bool block = part == Part::ground && slides(p.reference_x[k], p.reference_y[k]);
        p.x[k] = p.reference_x[k] + base + (block ? ux : 0);
        p.y[k] = p.reference_y[k] + (block ? uy : 0);
        p.velocity_x[k] = base_speed + (block ? vx : 0);
        p.velocity_y[k] = block ? vy : 0;
      }
    }
  }

  void sample(double time)
  {
    history.start_row(time, clock);
    slide.sample(history, time);
  }
};
} // namespace

TEST_CASE("the moved ground is measured relative to the base", "[stages]")
{
  SlidingBlock block;
  block.move(0.7, 3, -1, 0.2, 2, -1.5);
  block.sample(1);
  const MovedGround& moved = block.slide.now();
  CHECK(moved.area == Approx(4 * 2));
  CHECK(moved.mass == Approx(4 * 2 * 1800));
  CHECK(moved.displacement[0] == Approx(3));
  CHECK(moved.displacement[1] == Approx(-1));
  CHECK(moved.velocity[0] == Approx(2));
  CHECK(moved.advance() == Approx((3 * 2 + 1 * 1.5) / std::hypot(3, 1)));
  CHECK(moved.velocity_99 == Approx(2.5));
  CHECK(moved.velocity_point == Approx(2.5));
  CHECK(moved.toe == Approx(7.75 + 0.7 + 3));
  CHECK(moved.toe_advance == Approx(3.7));
}

TEST_CASE("a slide to the left has its toe on the left", "[stages]")
{
  SlidingBlock block;
  block.move(0, -2, 0, 0, 0, 0);
  block.sample(1);
  CHECK(block.slide.now().toe == Approx(4.25 - 2));
  CHECK(block.slide.now().toe_advance == Approx(2));
}

TEST_CASE("particles that have flown on alone are not the toe of a slide", "[stages]")
{
  SlidingBlock block;
  block.move(0, 3, 0, 0, 0, 0);
  Particles& p = block.model.main->particles;
  int flown = 0;
  for (int k = 0; k < p.size() && flown < 3; ++k)
    if (SlidingBlock::slides(p.reference_x[k], p.reference_y[k])) p.x[k] = 30 + 0.1 * ++flown;
  REQUIRE(flown == 3); // of four in a cell
  block.sample(1);
  CHECK(block.slide.now().toe == Approx(7.75 + 3));
}

TEST_CASE("a model of laboratory size has a slide where centimetres count", "[stages]")
{
  SlidingBlock usual, small({.moved = 0.01, .area = 0.01});
  for (SlidingBlock* block : {&usual, &small})
  {
    block->sample(0);
    block->move(0, 0.012, 0, 0, 0.01, 0); // at 1 cm/s it passed 1 mm 1.1 s ago
    block->sample(2);
  }
  CHECK(usual.slide.now().area == 0);
  CHECK(std::isnan(usual.slide.trigger_time()));
  CHECK(small.slide.now().area == Approx(4 * 2));
  CHECK(small.slide.trigger_time() == Approx(2 - 1.1));
}

TEST_CASE("shaking of the whole ground moves none of it", "[stages]")
{
  SlidingBlock block;
  block.move(5, 0, 0, 3, 0, 0);
  block.sample(1);
  CHECK(block.slide.now().area == 0);
  CHECK(std::isnan(block.slide.trigger_time()));
  CHECK(block.slide.summary()["trigger_time"].is_null());
}

TEST_CASE("the trigger is when the ground that slid had left its place for good", "[stages]")
{
  SlidingBlock block;
  block.sample(0);
  block.move(0, 0.3, 0, 0, 1, 0); // out of place for a while, and back
  block.sample(1);
  block.move(0, 0.02, 0, 0, -1, 0);
  block.sample(2);
  CHECK(std::isnan(block.slide.trigger_time()));
  block.move(0, 0.5, 0, 0, 0.8, 0); // at 0.8 m/s it passed 0.1 m half a second ago
  block.sample(3);
  block.move(0, 1.3, 0, 0, 0.8, 0);
  block.sample(4);
  CHECK(block.slide.trigger_time() == Approx(3 - (0.5 - 0.1) / 0.8));
}

TEST_CASE("the greatest velocities are kept with time and position, also across a restart", "[stages]")
{
  SlidingBlock block;
  block.move(0, 2, 0, 0, 4, 3);
  block.sample(1);
  const std::array<double, 2> position = block.slide.now().point;
  block.move(0, 3, 0, 0, 1, 0);
  block.sample(2);
  const nlohmann::json summary = block.slide.summary();
  CHECK(summary["peak_velocity"]["value"] == Approx(5));
  CHECK(summary["point_velocity"]["value"] == Approx(5));
  CHECK(summary["point_velocity"]["time"] == 1);
  CHECK(summary["point_velocity"]["position"] == nlohmann::json(position));

  h5::File file = h5::File::in_memory("slide");
  h5::Group group = file.create_group("slide");
  block.slide.save(group);
  Slide again(block.model, block.case_file);
  again.load(group, 2);
  CHECK(again.summary() == summary);
  CHECK(again.trigger_time() == block.slide.trigger_time());
}

TEST_CASE("the outline holds the surface before and after, level ground and the hollow", "[stages]")
{
  SlidingBlock block;
  block.move(0, 4, 2, 0, 0, 0); // onto the ground beside it
  const Outline line = outline_of(*block.model.main, block.case_file);
  REQUIRE(line.x.size() == 40);
  for (std::size_t k = 0; k < line.x.size(); ++k)
  {
    const double x = line.x[k];
    CHECK(line.start[k] == Approx(6));
    CHECK(line.end[k] == Approx(x > 4 && x < 8 ? 4 : x > 8 && x < 12 ? 8 : 6));
  }
  CHECK(line.greatest_fall().height == Approx(2));
  CHECK(line.greatest_fall().x == Approx(4.25));
  CHECK(line.greatest_rise().height == Approx(2));
  CHECK(line.greatest_rise().x == Approx(8.25));
}
