#pragma once
// Completion in the shell. What scripts/install gives bash, zsh and fish knows nothing of the programs: it
// asks
//
//   mpm-static --complete WORD...
//
// what may stand in the last word's place, those before it being given already. The answer is a candidate a
// line, with what it means behind a tab; `:files` and `:folders` stand for those of the disk. So options,
// profiles and keys are those of the program that is there, and of the case that is named.

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace mpm
{
/// A word that may be given, and what it means.
struct Candidate
{
  std::string word, meaning;
};

/// What may be given to an option, or as argument without one: what has been typed of it, the words before.
using ValuesOf = std::function<std::vector<Candidate>(const CLI::Option&, const std::string& typed,
                                                      const std::vector<std::string>& before)>;

/// The answer to `--complete`, for the options of `app`; `words` follow it.
std::string completion(const CLI::App& app, const std::vector<std::string>& words, const ValuesOf& values_of);

/// `ValuesOf` of the two programs: a profile or a key of the case that was named, keys with its own names.
std::vector<Candidate> case_values(const CLI::Option& option, const std::string& typed,
                                   const std::vector<std::string>& before);
} // namespace mpm
