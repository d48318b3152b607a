#pragma once
// Every key of the case file, as the programs print them with --keys.

#include "io/case/key.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace mpm
{
/// All keys in the order in which they are read. What people name is NAME in a path, an element of a list N;
/// a parameter that not every law has begins its meaning with the laws that have it.
std::vector<KeyDescription> case_keys();

/// The keys at and below a path, all for an empty one; "materials.soil" and "regions[0]" are understood.
/// `Error` usage, with the path that may be meant, where there is none.
std::vector<KeyDescription> case_keys(std::string_view path);

/// The words that a key's form, "a, b or c", lets be given; none where it lets anything else be given.
std::vector<std::string> words_of(const std::string& form);

/// As text for a terminal, 100 columns wide: two lines or more for each key.
std::string text_of(const std::vector<KeyDescription>& keys);

/// The units that numbers may carry, one dimension a line: "length: m, mm, cm or km".
std::string units_text();
} // namespace mpm
