#pragma once
// Catch2 3 under the names that Catch2 2 has for it; on the include path only where Catch2 is of version 3.

#include <catch2/catch_all.hpp>

#include <string>

using Catch::Approx;

namespace Catch::Matchers
{
// Of a text, a part of it; version 3 has its own Contains for elements of any range, which these go before.
inline StringContainsMatcher Contains(const char* part)
{
  return ContainsSubstring(part);
}
inline StringContainsMatcher Contains(const std::string& part)
{
  return ContainsSubstring(part);
}
inline StringContainsMatcher Contains(std::string& part)
{
  return ContainsSubstring(part);
}
inline StringContainsMatcher Contains(std::string&& part)
{
  return ContainsSubstring(part);
}
} // namespace Catch::Matchers

namespace Catch
{
using Matchers::Contains;
using Matchers::EndsWith;
using Matchers::Equals;
using Matchers::StartsWith;
} // namespace Catch
