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

inline double sum(const Row& row)
{
  return (row[0] + row[2]) + (row[1] + row[3]);
}
} // namespace mpm
