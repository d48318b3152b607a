#pragma once
// The keys of the case file as a JSON Schema, for editors that complete and check YAML.

#include <string>

namespace mpm
{
/// A schema of draft 7, made from what the readers describe (case_keys). It knows keys, words and units, and
/// neither what a value may be of its range nor what fits together: that the programs check.
std::string case_schema();
} // namespace mpm
