#pragma once
// How much memory there is for a run. Asked before it begins: a process that takes too much is killed without
// a word.

#include <string>

namespace mpm
{
/// Memory that this process may still take, and what limits it.
struct FreeMemory
{
  double bytes;      ///< infinite when nothing is known
  std::string limit; ///< for messages, as "this machine has free"
};

/// The least of what the machine has free (/proc/meminfo), what the control groups around the process allow
/// (both versions), and its own limits of address space and data.
FreeMemory free_memory();

/// "1.5 GB", for people.
std::string bytes_text(double bytes);
} // namespace mpm
