// A program that builds on the library: lets the ground of a case fall against its base for a while, and
// tells what energy it then has.
//
//   consumer cases/first/case.yaml

#include "io/case/case.hpp"
#include "solver/stages/model.hpp"
#include "solver/stages/time_step.hpp"

#include <iostream>

int main(int argc, char** argv)
try
{
  if (argc != 2) throw std::runtime_error("consumer: give a case");
  const mpm::Case ground = mpm::load_case(argv[1]);
  mpm::Model model = mpm::make_model(ground);
  mpm::add_static_boundaries(model, ground);
  mpm::Domain& domain = *model.main;
  domain.settings.gravity_y = -ground.static_stage.gravity;
  const double dt = mpm::step_of(ground.static_stage.courant_number, domain);
  for (int k = 0; k < 50; ++k) mpm::advance(model, k * dt, dt);
  std::cout << domain.particles.size() << " particles, " << mpm::kinetic_energy(domain) << " J/m\n";
}
catch (const std::exception& error)
{
  std::cerr << error.what() << '\n';
  return 1;
}
