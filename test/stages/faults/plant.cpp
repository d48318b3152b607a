// Plants a fault in the state of a running stage. Linked into mpm-static-faulty and mpm-seismic-faulty, whose
// calls of mpm::advance and mpm::solve_grid come here first (the linker's --wrap):
//   PLANT       what: see `faults` below, or "step", which makes steps PLANT_BY times as long as the clock
//   says PLANT_AT    after so many steps of this process; 0 by default PLANT_BY    factor of "step", "volume"
//   and "speed" PLANT_IN    "ground" (by default), "left" or "right": the domain
// The particle is the one in the middle of the domain's list.

#include "solver/mpm/step.hpp"
#include "solver/stages/model.hpp"

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>

using mpm::Domain;
using mpm::Model;

extern "C"
{
  void __real__ZN3mpm7advanceERNS_5ModelEdd(Model& model, double time, double dt);
  void __real__ZN3mpm10solve_gridERNS_6DomainEd(Domain& domain, double dt);
}

namespace
{
std::string setting(const char* name, const std::string& otherwise = "")
{
  const char* value = std::getenv(name);
  return value ? value : otherwise;
}

const double by = std::atof(setting("PLANT_BY", "2").c_str());
long steps = 0;       // until now
bool in_node = false; // whether a node is to be hurt in this step
const Domain* hurt = nullptr;

/// What can be done to particle k of a domain.
const std::map<std::string, std::function<void(Domain&, int)>> faults{
    {"stress", [](Domain& d, int k) { d.particles.stress_xy[k] = NAN; }},
    {"velocity", [](Domain& d, int k) { d.particles.velocity_x[k] = NAN; }},
    {"position", [](Domain& d, int k) { d.particles.y[k] = NAN; }},
    {"affine", [](Domain& d, int k) { d.particles.affine_yx[k] = INFINITY; }},
    {"far", [](Domain& d, int k) { d.particles.x[k] = 1e30; }},
    {"away", [](Domain& d, int k) { d.particles.x[k] += 20 * d.grid.spacing; }},
    {"mass", [](Domain& d, int k) { d.particles.mass[k] = INFINITY; }},
    {"volume", [](Domain& d, int k) { d.particles.volume[k] *= by; }},
    {"speed", [](Domain& d, int k) { d.particles.velocity_y[k] = by; }},
    {"history",
     [](Domain& d, int)
     {
       for (mpm::Material& material : d.materials)
         if (!material.state.empty() && !material.state[0].empty()) material.state[0][0] = NAN;
     }},
    // The sign of the stress: ground that is pushed the more the further it gives way.
    {"sign",
     [](Domain& d, int)
     {
       for (mpm::Material& material : d.materials)
         std::visit([](auto& law) { law.young *= -1; }, material.law);
     }},
    {"node", [](Domain&, int) { in_node = true; }},
    // No fault: asks the run to end after this very step.
    {"stop", [](Domain&, int) { std::raise(SIGTERM); }},
};
} // namespace

extern "C"
{
  void __wrap__ZN3mpm7advanceERNS_5ModelEdd(Model& model, double time, double dt)
  {
    const std::string what = setting("PLANT"), where = setting("PLANT_IN", "ground");
    const bool now = steps++ == std::atol(setting("PLANT_AT", "0").c_str());
    const bool longer = what == "step" && (now || hurt);
    if (now)
    {
      Domain& domain = where == "ground" ? *model.main
                       : where == "left" ? *model.left->domain
                                         : *model.right->domain;
      hurt = &domain;
      if (what != "step" && !what.empty()) faults.at(what)(domain, domain.particles.size() / 2);
    }
    __real__ZN3mpm7advanceERNS_5ModelEdd(model, time, longer ? by * dt : dt);
  }

  void __wrap__ZN3mpm10solve_gridERNS_6DomainEd(Domain& domain, double dt)
  {
    if (in_node && hurt == &domain)
    {
      in_node = false;
      const auto& mass = domain.grid.mass;
      domain.grid.momentum_x[std::max_element(mass.begin(), mass.end()) - mass.begin()] = NAN;
    }
    __real__ZN3mpm10solve_gridERNS_6DomainEd(domain, dt);
  }
}
