// Which errors --check expects of a case.

#include "boundaries/ground_motion/ground_motion.hpp"
#include "solver/stages/expected_error.hpp"
#include "test/stages/ground.hpp"
#include "test/stages/programs.hpp"

using namespace mpm;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
ExpectedError run_out_of(std::string text, const std::string& old = "", const std::string& now = "")
{
  if (!old.empty()) text.replace(text.find(old), old.size(), now);
  const TemporaryFolder folder;
  put(folder.path() / "case.yaml", text);
  put(folder.path() / "shake.txt", sine(12, 2));
  return expected_run_out_error(load_case(folder.path() / "case.yaml"));
}

/// Of level ground under a pulse of 0.2 s.
double wave_error(double spacing, const std::string& more = "")
{
  Case case_file = case_from(level_ground(spacing, 2, 12, 8, 20, 0) + more);
  const IncomingWave wave{.horizontal = pulse(1, 0.2, 3), .vertical = {}, .fade = {}};
  const double dt = 0.5 * spacing / 369; // of the rock
  const ExpectedError error = expected_wave_error(case_file, dt, wave);
  CHECK(error.unknown.empty());
  return error.share;
}
} // namespace

TEST_CASE("classes of error are bounded from above, and what is not known has none", "[stages]")
{
  CHECK(ExpectedError{0, {}}.letter() == 'A');
  CHECK(ExpectedError{0.0199, {}}.letter() == 'A');
  CHECK(ExpectedError{0.02, {}}.letter() == 'B');
  CHECK(ExpectedError{0.1, {}}.letter() == 'C');
  CHECK(ExpectedError{0.2, {}}.letter() == 'D');
  CHECK(ExpectedError{NAN, "why"}.letter() == '?');
}

TEST_CASE("the error of waves in level ground vanishes as the cells do, with the order of the scheme",
          "[stages]")
{
  // Symplectic Euler's lead is of order 2 in the step, which goes with the cells; consistent inertia is of
  // order 4, and of order 2 where it is lumped.
  double before = wave_error(1);
  CHECK(before < 0.5);
  for (double h = 0.5; h > 0.1; h /= 2)
  {
    const double now = wave_error(h);
    CHECK(now < before / 3.5);
    before = now;
  }
  CHECK(before < error_classes[0] / 10);
}

TEST_CASE("the expected run-out gets better with finer cells, and worse with the paper's transfer",
          "[stages]")
{
  const ExpectedError coarse = run_out_of(cut), fine = run_out_of(cut, "spacing: 1 m", "spacing: 0.2 m");
  CHECK(coarse.unknown.empty());
  CHECK(fine.share < coarse.share);
  CHECK(run_out_of(cut, "  motion:", "  transfer: apic\n  motion:").share > 2 * coarse.share);
}

TEST_CASE("where run-out was not measured, its error is not known, and it is said why", "[stages]")
{
  CHECK_THAT(run_out_of(level_ground(1, 2, 12, 8, 20, 9.81)).unknown, Contains("nothing that can yield"));
  CHECK_THAT(run_out_of(cut, "{peak: 80 kPa, residual: 40 kPa}\n    softening: {displacement: 0.2 m}",
                        "{peak: 80 kPa}")
                 .unknown,
             Contains("softens by a displacement"));
  CHECK_THAT(run_out_of(cut, "displacement: 0.2 m", "strain: 0.2").unknown,
             Contains("softens by a displacement"));
}
