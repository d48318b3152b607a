// What libFuzzer calls. One executable for each target: TARGET is its function.

#include "test/fuzz/targets.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  mpm::fuzz::TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
