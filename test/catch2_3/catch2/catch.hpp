#pragma once
// Catch2 3 under the names that Catch2 2 has for it; on the include path only where Catch2 is of version 3.

#include <catch2/catch_all.hpp>

#include <concepts>
#include <string>
#include <utility>

using Catch::Approx;

namespace Catch::Matchers
{
// Of a text, a part of it: before the Contains of version 3, which is for elements of any range.
template <class Part>
requires std::convertible_to<Part, std::string> StringContainsMatcher Contains(Part&& part)
{
  return ContainsSubstring(std::string(std::forward<Part>(part)));
}
} // namespace Catch::Matchers

namespace Catch
{
using Matchers::Contains;
using Matchers::EndsWith;
using Matchers::Equals;
using Matchers::StartsWith;
} // namespace Catch
