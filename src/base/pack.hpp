// A pack of doubles: as many as the instruction set of the file that includes this works on at once (2, 4 or 8). The
// only header that sees xsimd.
//
// All operations act lane by lane and round as the scalar ones do; nothing here fuses or reorders, so that a lane has the
// same bits in a pack of any width.
#pragma once

#include <cstdint>
#include <xsimd/xsimd.hpp>

namespace freestand {

using Pack = xsimd::batch<double>;
using PackMask = Pack::batch_bool_type;
inline constexpr int pack_lanes = static_cast<int>(Pack::size);

static inline Pack load(const double* p) { return Pack::load_aligned(p); }
static inline Pack load_any(const double* p) { return Pack::load_unaligned(p); }
static inline void store(double* p, const Pack& x) { x.store_aligned(p); }

// Bit i: lane i holds.
static inline unsigned bits(const PackMask& mask) {
#if defined(__AVX512F__)
  return static_cast<unsigned>(mask.data);
#elif defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_pd(mask));
#elif defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd(mask));
#else
  unsigned all = 0;
  for (int i = 0; i < pack_lanes; ++i) all |= static_cast<unsigned>(mask.get(static_cast<std::size_t>(i))) << i;
  return all;
#endif
}

// A pack of short integers, for searches that something exact follows.
using Shorts = xsimd::batch<std::uint16_t>;
inline constexpr int short_lanes = static_cast<int>(Shorts::size);

// Bit i: a >= b in lane i.
static inline std::uint32_t bits_not_below(const Shorts& a, const Shorts& b) {
#if defined(__AVX512BW__)
  return _mm512_cmpge_epu16_mask(a, b);
#elif defined(__AVX2__)
  const __m256i all = _mm256_cmpeq_epi16(_mm256_max_epu16(a, b), a);
  const __m128i bytes = _mm_packs_epi16(_mm256_castsi256_si128(all), _mm256_extracti128_si256(all, 1));
  return static_cast<std::uint32_t>(_mm_movemask_epi8(bytes));
#elif defined(__SSE4_1__)
  const __m128i all = _mm_cmpeq_epi16(_mm_max_epu16(a, b), a);
  return static_cast<std::uint8_t>(_mm_movemask_epi8(_mm_packs_epi16(all, all)));
#else
  std::uint32_t all = 0;
  for (std::size_t i = 0; i < Shorts::size; ++i) all |= std::uint32_t{a.get(i) >= b.get(i)} << i;
  return all;
#endif
}

// Lane i: a b / 2^16, rounded down.
static inline Shorts high_product(const Shorts& a, const Shorts& b) {
#if defined(__AVX512BW__)
  return _mm512_mulhi_epu16(a, b);
#elif defined(__AVX2__)
  return _mm256_mulhi_epu16(a, b);
#elif defined(__SSE2__)
  return _mm_mulhi_epu16(a, b);
#else
  std::uint16_t values[Shorts::size];
  for (std::size_t i = 0; i < Shorts::size; ++i)
    values[i] = static_cast<std::uint16_t>(std::uint32_t{a.get(i)} * b.get(i) >> 16);
  return Shorts::load_unaligned(values);
#endif
}

// At least N of them in a row.
template <int N>
struct ShortRun {
  static constexpr int parts = N > short_lanes ? N / short_lanes : 1;
  Shorts part[parts];

  ShortRun() = default;
  explicit ShortRun(std::uint16_t all) {
    for (Shorts& one : part) one = Shorts(all);
  }
  explicit ShortRun(const std::uint16_t* p) {
    for (int i = 0; i < parts; ++i) part[i] = Shorts::load_unaligned(p + i * short_lanes);
  }
};

// Bit i: a >= b in place i.
template <int N>
static inline std::uint32_t bits_not_below(const ShortRun<N>& a, const ShortRun<N>& b) {
#if defined(__AVX2__) && !defined(__AVX512BW__)
  if constexpr (ShortRun<N>::parts == 2) {
    const __m256i low = _mm256_cmpeq_epi16(_mm256_max_epu16(a.part[0], b.part[0]), a.part[0]);
    const __m256i high = _mm256_cmpeq_epi16(_mm256_max_epu16(a.part[1], b.part[1]), a.part[1]);
    const __m256i bytes = _mm256_permute4x64_epi64(_mm256_packs_epi16(low, high), 0xd8);
    return static_cast<std::uint32_t>(_mm256_movemask_epi8(bytes));
  }
#endif
  std::uint32_t all = 0;
  for (int i = 0; i < ShortRun<N>::parts; ++i) all |= bits_not_below(a.part[i], b.part[i]) << (i * short_lanes);
  return all;
}

// Lane i: p[i][offset].
static inline Pack fetch(const double* const* p, int offset = 0) {
#if defined(__AVX512F__)
  const __m512i bytes = _mm512_set1_epi64(static_cast<long long>(sizeof(double)) * offset);
  return _mm512_i64gather_pd(_mm512_add_epi64(_mm512_load_si512(p), bytes), nullptr, 1);
#else
  alignas(64) double values[pack_lanes];
  for (int i = 0; i < pack_lanes; ++i) values[i] = p[i][offset];
  return load(values);
#endif
}

// Bit i: p[i] > q[i].
static inline unsigned bits_after(const double* const* p, const double* const* q) {
#if defined(__AVX512F__)
  return _mm512_cmpgt_epu64_mask(_mm512_loadu_si512(p), _mm512_loadu_si512(q));
#else
  unsigned all = 0;
  for (int i = 0; i < pack_lanes; ++i) all |= static_cast<unsigned>(p[i] > q[i]) << i;
  return all;
#endif
}

// Lane i: p[i][0], p[i][1], p[i][2], p[i][3]; p[i] is a multiple of 32 bytes.
static inline void fetch_columns(const double* const* p, Pack& first, Pack& second, Pack& third, Pack& fourth) {
#if defined(__AVX512F__)
  __m512d pair[4];
  for (int i = 0; i < 4; ++i)
    pair[i] = _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(p[i])), _mm256_load_pd(p[i + 4]), 1);
  const __m512d a = _mm512_unpacklo_pd(pair[0], pair[1]), b = _mm512_unpackhi_pd(pair[0], pair[1]);
  const __m512d c = _mm512_unpacklo_pd(pair[2], pair[3]), d = _mm512_unpackhi_pd(pair[2], pair[3]);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  first = _mm512_permutex2var_pd(a, low, c);
  second = _mm512_permutex2var_pd(b, low, d);
  third = _mm512_permutex2var_pd(a, high, c);
  fourth = _mm512_permutex2var_pd(b, high, d);
#elif defined(__AVX__)
  const __m256d p0 = _mm256_load_pd(p[0]), p1 = _mm256_load_pd(p[1]);
  const __m256d p2 = _mm256_load_pd(p[2]), p3 = _mm256_load_pd(p[3]);
  const __m256d a = _mm256_unpacklo_pd(p0, p1), b = _mm256_unpackhi_pd(p0, p1);
  const __m256d c = _mm256_unpacklo_pd(p2, p3), d = _mm256_unpackhi_pd(p2, p3);
  first = _mm256_permute2f128_pd(a, c, 0x20);
  second = _mm256_permute2f128_pd(b, d, 0x20);
  third = _mm256_permute2f128_pd(a, c, 0x31);
  fourth = _mm256_permute2f128_pd(b, d, 0x31);
#else
  first = fetch(p, 0);
  second = fetch(p, 1);
  third = fetch(p, 2);
  fourth = fetch(p, 3);
#endif
}

// Whole numbers, from and to their short form.
static inline Pack load_whole(const int* p) {
#if defined(__AVX512F__)
  return _mm512_cvtepi32_pd(_mm256_load_si256(reinterpret_cast<const __m256i*>(p)));
#elif defined(__AVX__)
  return _mm256_cvtepi32_pd(_mm_load_si128(reinterpret_cast<const __m128i*>(p)));
#elif defined(__SSE2__)
  return _mm_cvtepi32_pd(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
#else
  alignas(64) double values[pack_lanes];
  for (int i = 0; i < pack_lanes; ++i) values[i] = p[i];
  return load(values);
#endif
}
static inline void store_whole(int* p, const Pack& x) {
#if defined(__AVX512F__)
  _mm256_store_si256(reinterpret_cast<__m256i*>(p), _mm512_cvttpd_epi32(x));
#elif defined(__AVX__)
  _mm_store_si128(reinterpret_cast<__m128i*>(p), _mm256_cvttpd_epi32(x));
#elif defined(__SSE2__)
  _mm_storel_epi64(reinterpret_cast<__m128i*>(p), _mm_cvttpd_epi32(x));
#else
  alignas(64) double values[pack_lanes];
  store(values, x);
  for (int i = 0; i < pack_lanes; ++i) p[i] = static_cast<int>(values[i]);
#endif
}

// p[i] += by, where bit i of `lanes` is set.
static inline void advance(const double** p, unsigned lanes, int by = 1) {
#if defined(__AVX512F__)
  const __m512i at = _mm512_load_si512(p), bytes = _mm512_set1_epi64(static_cast<long long>(sizeof(double)) * by);
  _mm512_store_si512(p, _mm512_mask_add_epi64(at, static_cast<__mmask8>(lanes), at, bytes));
#else
  for (int i = 0; i < pack_lanes; ++i) p[i] += (lanes >> i & 1U) ? by : 0;
#endif
}

// After packs and before scalar code that was compiled for older machines, which is slow while the upper parts of registers
// are in use; the compiler does not see it where packs are in a function of their own.
static inline void clear_upper_parts() {
#if defined(__AVX__)
  _mm256_zeroupper();
#endif
}

static inline Pack choose(const PackMask& mask, const Pack& yes, const Pack& no) {
  return xsimd::select(mask, yes, no);
}

// p[i] = x[i], where lane i holds.
static inline void store_where(const PackMask& mask, double* p, const Pack& x) {
#if defined(__AVX512F__)
  _mm512_mask_store_pd(p, mask.data, x);
#else
  store(p, choose(mask, x, load(p)));
#endif
}

}  // namespace freestand
