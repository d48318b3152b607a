// The greatest values of a free-field column with depth, against a standing wave.

#include "solver/stages/column_envelope.hpp"
#include "test/stages/ground.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::test;

namespace
{
constexpr double height = 20, spacing = 0.5, density = 2200, speed = 213.2007; // of S waves: G = 100 MPa
constexpr double frequency = 5, amplitude = 0.01;                              // Hz; of the upgoing wave, m/s
constexpr double omega = 2 * std::numbers::pi * frequency;

/// A sine that grows for 2 s and goes on to 4 s.
GroundMotion sine()
{
  GroundMotion motion;
  motion.dt = 0.0005;
  for (double t = 0; t < 4; t += motion.dt)
  {
    const double s = std::min(1.0, t / 2), grown = amplitude * s * s * (3 - 2 * s);
    const double growth = s < 1 ? amplitude * 6 * s * (1 - s) / 2 : 0;
    motion.velocity.push_back(grown * std::sin(omega * t));
    motion.acceleration.push_back(growth * std::sin(omega * t) + grown * omega * std::cos(omega * t));
  }
  return motion;
}

/// Column of rock, shaken until its waves stand, and looked at from then on, every 5 ms for five periods.
struct Column
{
  Model model;
  std::unique_ptr<ColumnEnvelope> envelope;
  double time = 0; ///< of the last look, s
  Column()
  {
    std::string text = level_ground(spacing, 2, 6, height / 2, height, 0);
    text.replace(text.find("material: soil"), 14, "material: rock");
    const Case case_file = case_from(text);
    model = make_model(case_file);
    IncomingWave wave;
    wave.horizontal = sine();
    add_seismic_boundaries(model, case_file, std::make_shared<IncomingWave>(wave), false);
    envelope = std::make_unique<ColumnEnvelope>(*model.column(Edge::left), spacing / 2);
    const double dt = 0.005 / std::ceil(0.005 / stable_step(case_file, model));
    const long each = std::lround(0.005 / dt), last = std::lround(3.6 / dt);
    for (long k = 0; k <= last; ++k)
    {
      if (k * dt > 2.6 && k % each == 0) envelope->sample(time = k * dt);
      advance(model, k * dt, dt);
    }
  }
  h5::File written() const
  {
    h5::File file = h5::File::in_memory("envelope.h5");
    h5::Group group = file.create_group("left");
    envelope->write(group);
    return file;
  }
};
} // namespace

// Up- and downgoing waves of amplitude v make 2 v cos(kd) cos(wt) at the depth d below a free surface.
// Allowed is 1.5 % of the greatest value: means and samples 5 ms apart lose 0.1 and 0.3 %, the grid delays
// waves by up to (kh)^2 / 6 of H / c, 0.3 %, and the base gives back up to half a per cent.
TEST_CASE("the greatest values in a uniform column are those of a standing wave", "[stages]")
{
  const Column column;
  const h5::File file = column.written();
  const auto read = [&](const std::string& name) { return file.read_doubles("left/" + name); };
  const std::vector<double> y = read("height"), middle = read("middle_height");
  REQUIRE(y.size() == 80);
  REQUIRE(middle.size() == 79);
  const auto check = [](const std::vector<double>& values, const std::vector<double>& heights, double peak,
                        double (*shape)(double))
  {
    double worst = 0;
    for (std::size_t k = 0; k < values.size(); ++k)
    {
      const double exact = std::fabs(shape(omega * (height - heights[k]) / speed));
      worst = std::max(worst, std::fabs(values[k] / peak - exact));
    }
    INFO("greatest error " << worst << " of " << peak);
    CHECK(values.size() == heights.size());
    CHECK(worst < 0.015);
  };
  const auto cosine = [](double phase) { return std::cos(phase); };
  const auto sine = [](double phase) { return std::sin(phase); };
  check(read("greatest_acceleration"), y, 2 * amplitude * omega, cosine);
  check(read("greatest_shear_strain"), middle, 2 * amplitude / speed, sine);
  check(read("greatest_shear_stress"), middle, 2 * amplitude * density * speed, sine);
}

TEST_CASE("greatest values that were saved and loaded go on as if they had not been", "[stages]")
{
  Column column;
  h5::File file = h5::File::in_memory("state.h5");
  h5::Group saved = file.create_group("saved"), whole = file.create_group("whole"),
            resumed = file.create_group("resumed");
  column.envelope->save(saved);
  ColumnEnvelope again(*column.model.left, spacing / 2);
  again.load(saved, column.time);
  // Fewer than what the wave has made: the loaded ones have to stay. A jump: means since the last look.
  column.model.left->domain->particles.velocity_x[40] += 10;
  for (ColumnEnvelope* each : {column.envelope.get(), &again}) each->sample(column.time + 0.005);
  column.envelope->save(whole);
  again.save(resumed);
  REQUIRE(whole.children().size() == 4);
  for (const std::string& name : whole.children())
  {
    INFO(name);
    CHECK(resumed.read_doubles(name) == whole.read_doubles(name));
  }
  CHECK(whole.read_doubles("greatest_acceleration") != saved.read_doubles("greatest_acceleration"));
}

TEST_CASE("a state that no column leaves is refused", "[stages]")
{
  const Column column;
  const auto load = [&](const std::string& name, const std::vector<double>& values)
  {
    h5::File file = h5::File::in_memory("state.h5");
    h5::Group saved = file.create_group("saved"), changed = file.create_group("changed");
    column.envelope->save(saved);
    for (const std::string& each : saved.children())
      changed.write(each, each == name ? values : saved.read_doubles(each), {}, "1");
    ColumnEnvelope(*column.model.left, spacing / 2).load(changed, 1);
  };
  CHECK_NOTHROW(load("", {}));
  const auto code = [&](const char* name, const std::vector<double>& values)
  { return code_of([&] { load(name, values); }); };
  CHECK(code("greatest_shear_strain", std::vector<double>(80, 0.0)) == exit_code::bad_input);
  CHECK(code("greatest_acceleration", std::vector<double>(80, -1.0)) == exit_code::bad_input);
  CHECK(code("row_velocity", std::vector<double>(80, NAN)) == exit_code::bad_input);
  CHECK(code("row_velocity", std::vector<double>(80, -1.0)) == 0);
}
