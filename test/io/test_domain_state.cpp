#include "io/results/domain_state.hpp"
#include "solver/mpm/step.hpp"
#include "test/domains.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace domains;

TEST_CASE("Ground that rests goes on resting after a restart, to the last bit", "[io]")
{
  const Threads one(1);
  const double dt = 0.053;
  Domain domain = make_domain({{elastic(1.32e5), {0, 0, 64, 8}}});
  for (int k = 0; k < domain.particles.size(); ++k)
    domain.particles.velocity_x[k] = domain.particles.x[k] < 8 ? 0.1 : 0;
  allow_rest(domain, 1e-3);
  const auto asleep = [](const Domain& d)
  {
    return std::count_if(d.blocks.occupied.begin(), d.blocks.occupied.end(),
                         [](const OccupiedBlock& occupied) { return occupied.asleep; });
  };
  run(domain, 45, dt); // neither at a look nor before the first
  REQUIRE(asleep(domain) > 0);
  REQUIRE(asleep(domain) < static_cast<long>(domain.blocks.occupied.size()));

  h5::File file = h5::File::in_memory("checkpoint");
  save_domain(file, domain);
  Domain resumed = same_particles(domain);
  load_domain(file, resumed);
  resumed.time = domain.time;
  CHECK(asleep(resumed) == asleep(domain));
  run(domain, 60, dt);
  run(resumed, 60, dt);
  CHECK(identical(domain, resumed));
  CHECK(resumed.rest.skipped == domain.rest.skipped);
}
