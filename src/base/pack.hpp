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

// A pack of floats, for searches that something exact follows.
using Floats = xsimd::batch<float>;
inline constexpr int float_lanes = static_cast<int>(Floats::size);

// Bit i: lane i holds.
static inline std::uint64_t bits(const Floats::batch_bool_type& mask) {
#if defined(__AVX512F__)
  return static_cast<std::uint64_t>(mask.data);
#elif defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_ps(mask));
#elif defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_ps(mask));
#else
  std::uint64_t all = 0;
  for (int i = 0; i < float_lanes; ++i) all |= std::uint64_t{mask.get(static_cast<std::size_t>(i))} << i;
  return all;
#endif
}

// A pack of short integers, for the same.
using Shorts = xsimd::batch<std::int16_t>;
inline constexpr int short_lanes = static_cast<int>(Shorts::size);

// Bit i: a >= b in lane i.
static inline std::uint64_t bits_not_below(const Shorts& a, const Shorts& b) {
#if defined(__AVX512BW__)
  return _mm512_cmpge_epi16_mask(a, b);
#elif defined(__AVX2__)
  const __m256i below = _mm256_cmpgt_epi16(b, a);
  const __m128i bytes = _mm_packs_epi16(_mm256_castsi256_si128(below), _mm256_extracti128_si256(below, 1));
  return static_cast<std::uint16_t>(~_mm_movemask_epi8(bytes));
#elif defined(__SSE2__)
  const __m128i below = _mm_cmpgt_epi16(b, a);
  return static_cast<std::uint8_t>(~_mm_movemask_epi8(_mm_packs_epi16(below, below)));
#else
  std::uint64_t all = 0;
  for (int i = 0; i < short_lanes; ++i)
    all |= std::uint64_t{a.get(static_cast<std::size_t>(i)) >= b.get(static_cast<std::size_t>(i))} << i;
  return all;
#endif
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
