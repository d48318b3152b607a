#define CATCH_CONFIG_RUNNER
#include "solver/mpm/parallel.hpp"

#include <catch2/catch.hpp>

int main(int argc, char** argv)
{
  mpm::parallel::use_threads(1); // tests run side by side; those about threads ask for more
  return Catch::Session().run(argc, argv);
}
