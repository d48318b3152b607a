#pragma once
// Text from inputs in messages: names and paths may hold what a terminal would obey.

#include <string>
#include <string_view>

namespace mpm
{
/// The text with everything in it that does not print shown as \x1b, byte by byte: control characters but
/// those of `kept`, marks that turn the direction of writing, and what is no UTF-8.
std::string printable(std::string_view text, std::string_view kept = "\n\t");
} // namespace mpm
