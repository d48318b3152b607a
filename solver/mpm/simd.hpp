#pragma once
// All use of vector instructions: four neighbouring grid nodes of a row, as scalars (Row) or as (x, y) pairs
// (Pairs), and lanes of particles (Lanes). The types are those of the compiler's vector extension, so that +
// and * are the operators; what has none is a function here, once for AVX-512 and once for all else. The
// width decides how sums round: results agree to the last bit between builds for the same instructions only.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#ifdef __AVX__
#include <immintrin.h>
#endif

namespace mpm
{
/// One number at each of four neighbouring nodes of a row.
typedef double Row __attribute__((vector_size(32)));

/// The vector whose numbers stand one after the other from `from` on.
template <class Vector>
Vector load_as(const double* from)
{
  Vector vector;
  std::memcpy(&vector, from, sizeof vector);
  return vector;
}
template <class Vector>
void store(double* to, const Vector& vector)
{
  std::memcpy(to, &vector, sizeof vector);
}

/// The instructions that this build uses; results are bit-identical for any number of threads on one of them.
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

/// Whether one register holds the rows of nodes around two points.
inline constexpr bool two_rows_a_register =
#ifdef __AVX512F__
    true;
#else
    false;
#endif

#ifdef __AVX512F__

/// A vector (x, y) at each of four neighbouring nodes of a row.
typedef double Pairs __attribute__((vector_size(64)));

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

/// One number of each of several particles.
using Lanes = Pairs;
/// Some of the lanes.
using Selection = __mmask8;

/// The first `count` lanes, zeros in the others.
inline Lanes load_first(const double* from, int count)
{
  return _mm512_maskz_loadu_pd(_bzhi_u32(0xFF, count), from);
}
inline void store_first(double* to, const Lanes& values, int count)
{
  _mm512_mask_storeu_pd(to, _bzhi_u32(0xFF, count), values);
}
/// Lanes that are greater than those of another vector; none that are no number.
inline Selection above(const Lanes& values, const Lanes& than)
{
  return _mm512_cmp_pd_mask(values, than, _CMP_GT_OQ);
}
/// A bit for each of the lanes.
inline unsigned bits(Selection selected)
{
  return selected;
}
/// One vector's numbers in the selected lanes, another's in the others.
inline Lanes chosen(Selection where, const Lanes& these, const Lanes& others)
{
  return reinterpret_cast<Lanes>(_mm512_mask_blend_pd(where, others, these));
}
/// Lanes that take four numbers each, one after the other, of what one register holds.
struct LaneRun
{
  int begin; ///< index of the register's first number
  Selection who;
  __m512i place; ///< of each lane's first number in the register

  LaneRun() = default;
  /// `first` are the indices of each lane's first number; lane `one` has a place in the register, and so have
  /// those that begin up to three numbers after or one before.
  LaneRun(const int* first, int one) : begin(std::max(first[one] - 1, 0))
  {
    const __m256i places = _mm256_sub_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(first)),
                                            _mm256_set1_epi32(begin));
    who = _mm256_cmple_epu32_mask(places, _mm256_set1_epi32(4));
    place = _mm512_maskz_cvtepi32_epi64(0xFF, places);
  }
  /// Number i of those lanes, from numbers of which the first has index 0; what was there in the others.
  Lanes taken(const Lanes& so_far, const double* from, int i) const
  {
    return reinterpret_cast<Lanes>(_mm512_mask_permutexvar_pd(
        so_far, who, _mm512_add_epi64(place, _mm512_set1_epi64(i)), _mm512_loadu_pd(from + begin)));
  }
};
/// What follows each number of a row; after the last one comes the first of the vector `after`.
inline Lanes next_of(const Lanes& own, const Lanes& after)
{
  return __builtin_shufflevector(own, after, 1, 2, 3, 4, 5, 6, 7, 8);
}
/// The last two numbers of `before`, then the first of `own`.
inline Lanes two_before(const Lanes& before, const Lanes& own)
{
  return __builtin_shufflevector(before, own, 6, 7, 8, 9, 10, 11, 12, 13);
}
/// What precedes each number of a row; in front of the first one is the last of the vector `before`.
inline Lanes previous_of(const Lanes& before, const Lanes& own)
{
  return __builtin_shufflevector(before, own, 7, 8, 9, 10, 11, 12, 13, 14);
}

#else

/// A vector (x, y) at each of four neighbouring nodes of a row.
struct Pairs
{
  Row left, right;

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

template <>
inline Pairs load_as<Pairs>(const double* from)
{
  return {load_as<Row>(from), load_as<Row>(from + 4)};
}
inline void store(double* to, const Pairs& pairs)
{
  store(to, pairs.left);
  store(to + 4, pairs.right);
}
inline Pairs twice(const Row& row)
{
  return {__builtin_shufflevector(row, row, 0, 0, 1, 1), __builtin_shufflevector(row, row, 2, 2, 3, 3)};
}
inline Pairs both(const double* row)
{
  return {load_as<Row>(row), load_as<Row>(row)};
}
inline Pairs both(double first, double second)
{
  return {first - Row{}, second - Row{}};
}
inline Pairs everywhere(const double* vector)
{
  const Row row{vector[0], vector[1], vector[0], vector[1]};
  return {row, row};
}

using Lanes = Row;
typedef long long Selection __attribute__((vector_size(32)));

inline Lanes load_first(const double* from, int count)
{
  if (count >= 4) return load_as<Lanes>(from);
#ifdef __AVX__
  return _mm256_maskload_pd(from, reinterpret_cast<__m256i>(Selection{0, 1, 2, 3} < count));
#endif
  Lanes values{};
  for (int k = 0; k < count; ++k) values[k] = from[k];
  return values;
}
inline void store_first(double* to, const Lanes& values, int count)
{
  if (count >= 4) return store(to, values);
#ifdef __AVX__
  return _mm256_maskstore_pd(to, reinterpret_cast<__m256i>(Selection{0, 1, 2, 3} < count), values);
#endif
  for (int k = 0; k < count; ++k) to[k] = values[k];
}
inline Selection above(const Lanes& values, const Lanes& than)
{
  return values > than;
}
inline Lanes chosen(const Selection& where, const Lanes& these, const Lanes& others)
{
  return where ? these : others;
}
inline unsigned bits(const Selection& selected)
{
#ifdef __AVX__
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(selected)));
#endif
  unsigned all = 0;
  for (int k = 0; k < 4; ++k) all |= selected[k] ? 1u << k : 0;
  return all;
}
struct LaneRun
{
  int begin;
  Selection who;

  LaneRun() = default;
  LaneRun(const int* first, int one)
      : begin(first[one]), who(Selection{first[0], first[1], first[2], first[3]} == begin)
  {
  }
  Lanes taken(const Lanes& so_far, const double* from, int i) const
  {
    return who ? from[begin + i] - Lanes{} : so_far;
  }
};
inline Lanes next_of(const Lanes& own, const Lanes& after)
{
  return __builtin_shufflevector(own, after, 1, 2, 3, 4);
}
inline Lanes previous_of(const Lanes& before, const Lanes& own)
{
  return __builtin_shufflevector(before, own, 3, 4, 5, 6);
}
inline Lanes two_before(const Lanes& before, const Lanes& own)
{
  return __builtin_shufflevector(before, own, 2, 3, 4, 5);
}
inline Lanes greatest_of(const Lanes& so_far, const Lanes& value)
{
  const auto greater = [](const Lanes& a, const Lanes& b) { return a > b ? a : b; };
  return greater(-value, greater(value, so_far));
}

#endif

inline constexpr int lanes = sizeof(Lanes) / sizeof(double);

/// The greatest whole numbers that are not above.
inline Lanes floor_of(const Lanes& values)
{
#if defined(__AVX512F__)
  return _mm512_floor_pd(values);
#elif defined(__AVX__)
  return _mm256_floor_pd(values);
#endif
  Lanes result;
  for (int k = 0; k < lanes; ++k) result[k] = std::floor(values[k]);
  return result;
}
/// Stores whole numbers as integers.
inline void store_integers(int* to, const Lanes& values)
{
  typedef int Integers __attribute__((vector_size(lanes * sizeof(int))));
  const Integers integers = __builtin_convertvector(values, Integers);
  std::memcpy(to, &integers, sizeof integers);
}
/// Whether all lanes are zero; one that is no number is not.
inline bool all_zero(const Lanes& values)
{
  bool zero = true;
  for (int k = 0; k < lanes; ++k) zero &= values[k] == 0;
  return zero;
}
/// The greatest lane that is above zero.
inline double greatest_of(const Lanes& of)
{
  double greatest = 0;
  for (int k = 0; k < lanes; ++k) greatest = std::max(greatest, of[k]);
  return greatest;
}
} // namespace mpm
