#pragma once
// The one place for vectors: four neighbouring grid nodes of a row.

#include <cstring>

namespace mpm
{
typedef double Row __attribute__((vector_size(32)));

inline Row load_row(const double* from)
{
  Row row;
  std::memcpy(&row, from, sizeof row);
  return row;
}

inline void store_row(double* to, const Row& row)
{
  std::memcpy(to, &row, sizeof row);
}

/// The sums of the lanes of four rows, as the lanes of one.
inline Row sums(const Row& a, const Row& b, const Row& c, const Row& d)
{
  const Row ab = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Row cd = __builtin_shufflevector(c, d, 0, 4, 2, 6) + __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}
} // namespace mpm
