#pragma once
// What comes of reading an input that people write.

#include "io/case/key.hpp"
#include "io/case/settings.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace mpm
{
/// Where a key or value stands.
struct Location
{
  std::string source; ///< the file, or "--set key.path=value"
  int line = 0;       ///< from 1; 0: the source has no lines
  int column = 0;

  std::string text() const; ///< FILE:LINE:COLUMN
};

/// All that is wrong with an input, collected so that its user sees everything at once, and all that it says,
/// defaults written out.
class Problems
{
public:
  Settings settings;
  /// Takes the description of every key that is asked for, given or not; null: nobody wants them.
  std::vector<KeyDescription>* keys = nullptr;

  /// `path` is the key path; empty for the file as a whole.
  void add(const Location& location, const std::string& path, const std::string& what);
  /// A file named by the input that cannot be read.
  void add_missing(const Location& location, const std::string& path, const std::string& what);
  std::size_t count() const { return entries_.size(); }
  /// Throws `Error` with all messages in the file's order, if there are any: input_missing when nothing is
  /// wrong but missing files, else bad_input.
  void throw_if_any() const;

private:
  struct Entry
  {
    Location location;
    std::string message;
  };
  std::vector<Entry> entries_;
  bool only_missing_ = true;
};
} // namespace mpm
