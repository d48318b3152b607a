#pragma once
// What may have been meant by a word that is not known.

#include <string>
#include <string_view>
#include <vector>

namespace mpm
{
/// The name most like `wrong`, empty if none is: one that begins like it, or that differs in no more than a
/// third of its letters.
std::string nearest(std::string_view wrong, const std::vector<std::string>& names);
/// "; did you mean 'x'?" or nothing.
std::string suggestion(std::string_view wrong, const std::vector<std::string>& names);
} // namespace mpm
