#pragma once
// The one place for vectors: four neighbouring grid nodes of a row, as scalars or as (x, y) pairs.

#include <algorithm>
#include <cstring>
#include <string_view>
#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace mpm
{
/// One number at each of four neighbouring nodes of a row.
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

/// The instructions that this build uses; results are bit-identical for any number of threads on one path.
inline constexpr std::string_view vector_path =
#if defined(__AVX512F__)
    "avx512";
#elif defined(__AVX2__) && defined(__FMA__)
    "avx2";
#elif defined(__AVX__)
    "avx";
#elif defined(__SSE2__)
    "sse2";
#else
    "scalar";
#endif

/// Whether a register holds the rows around two points.
inline constexpr bool two_rows_a_register =
#ifdef __AVX512F__
    true;
#else
    false;
#endif

#ifdef __AVX512F__

/// A vector (x, y) at each of four neighbouring nodes of a row.
typedef double Pairs __attribute__((vector_size(64)));

inline Pairs load_pairs(const double* from)
{
  Pairs pairs;
  std::memcpy(&pairs, from, sizeof pairs);
  return pairs;
}
inline void store_pairs(double* to, const Pairs& pairs)
{
  std::memcpy(to, &pairs, sizeof pairs);
}
/// Each of the four numbers of a row for both components.
inline Pairs twice(const Row& row)
{
  return reinterpret_cast<Pairs>(
      _mm512_maskz_permutexvar_pd(0xFF, _mm512_set_epi64(3, 3, 2, 2, 1, 1, 0, 0),
                                  _mm512_castpd256_pd512(reinterpret_cast<__m256d>(row))));
}
/// A row of nodes around each of two points: the same four numbers for both, or one number for each.
inline Pairs both(const double* row)
{
  return Pairs{row[0], row[1], row[2], row[3], row[0], row[1], row[2], row[3]};
}
inline Pairs both(double first, double second)
{
  return reinterpret_cast<Pairs>(_mm512_maskz_permutexvar_pd(
      0xFF, _mm512_set_epi64(1, 1, 1, 1, 0, 0, 0, 0), _mm512_castpd128_pd512(_mm_set_pd(second, first))));
}
/// One vector (x, y) at all nodes.
inline Pairs everywhere(const double* vector)
{
  // The masked form, since g++ 12 warns of uninitialised values within the plain one.
  return reinterpret_cast<Pairs>(_mm512_maskz_broadcast_f64x2(0xFF, _mm_loadu_pd(vector)));
}
/// The greater of what is there and the magnitude of a new value, number by number; skips what is no number.
inline Pairs greatest_of(const Pairs& so_far, const Pairs& value)
{
  constexpr int greatest_magnitude = 0b1011;
  return reinterpret_cast<Pairs>(_mm512_maskz_range_pd(0xFF, so_far, value, greatest_magnitude));
}
/// The greatest of all numbers.
inline double greatest_of(const Pairs& of)
{
  double greatest = 0;
  for (int k = 0; k < 8; ++k) greatest = std::max(greatest, of[k]);
  return greatest;
}
/// The vectors of four arguments, each summed over its nodes, side by side.
inline Pairs sums(const Pairs& a, const Pairs& b, const Pairs& c, const Pairs& d)
{
  const auto half = [](const Pairs& p, const Pairs& q)
  {
    return __builtin_shufflevector(p, q, 0, 1, 2, 3, 8, 9, 10, 11) +
           __builtin_shufflevector(p, q, 4, 5, 6, 7, 12, 13, 14, 15);
  };
  const Pairs ab = half(a, b), cd = half(c, d);
  return __builtin_shufflevector(ab, cd, 0, 1, 4, 5, 8, 9, 12, 13) +
         __builtin_shufflevector(ab, cd, 2, 3, 6, 7, 10, 11, 14, 15);
}
/// The vectors of two arguments, each summed over its nodes, side by side.
inline Row sums(const Pairs& a, const Pairs& b)
{
  const auto half = [](const Pairs& p)
  { return __builtin_shufflevector(p, p, 0, 1, 2, 3) + __builtin_shufflevector(p, p, 4, 5, 6, 7); };
  const Row u = half(a), v = half(b);
  return __builtin_shufflevector(u, v, 0, 1, 4, 5) + __builtin_shufflevector(u, v, 2, 3, 6, 7);
}

#else

/// A vector (x, y) at each of four neighbouring nodes of a row.
struct Pairs
{
  Row left{}, right{};

  Pairs& operator+=(const Pairs& other)
  {
    left += other.left;
    right += other.right;
    return *this;
  }
  friend Pairs operator+(Pairs a, const Pairs& b) { return a += b; }
  friend Pairs operator-(const Pairs& a, const Pairs& b) { return {a.left - b.left, a.right - b.right}; }
  friend Pairs operator*(const Pairs& a, const Pairs& b) { return {a.left * b.left, a.right * b.right}; }
  friend Pairs operator*(double factor, const Pairs& a) { return {factor * a.left, factor * a.right}; }
};

inline Pairs load_pairs(const double* from)
{
  return {load_row(from), load_row(from + 4)};
}
inline void store_pairs(double* to, const Pairs& pairs)
{
  store_row(to, pairs.left);
  store_row(to + 4, pairs.right);
}
inline Pairs twice(const Row& row)
{
  return {__builtin_shufflevector(row, row, 0, 0, 1, 1), __builtin_shufflevector(row, row, 2, 2, 3, 3)};
}
inline Pairs both(const double* row)
{
  return {load_row(row), load_row(row)};
}
inline Pairs both(double first, double second)
{
  return {first + Row{}, second + Row{}};
}
inline Pairs everywhere(const double* vector)
{
  const Row row{vector[0], vector[1], vector[0], vector[1]};
  return {row, row};
}
inline Pairs greatest_of(const Pairs& so_far, const Pairs& value)
{
  const auto greater = [](const Row& a, const Row& b) { return a > b ? a : b; };
  const auto greatest = [&](const Row& a, const Row& b) { return greater(-b, greater(b, a)); };
  return {greatest(so_far.left, value.left), greatest(so_far.right, value.right)};
}
inline double greatest_of(const Pairs& of)
{
  double greatest = 0;
  for (int k = 0; k < 4; ++k) greatest = std::max({greatest, of.left[k], of.right[k]});
  return greatest;
}
inline Row sums(const Pairs& a, const Pairs& b)
{
  const Row u = a.left + a.right, v = b.left + b.right;
  return __builtin_shufflevector(u, v, 0, 1, 4, 5) + __builtin_shufflevector(u, v, 2, 3, 6, 7);
}
inline Pairs sums(const Pairs& a, const Pairs& b, const Pairs& c, const Pairs& d)
{
  return {sums(a, b), sums(c, d)};
}

#endif
} // namespace mpm
