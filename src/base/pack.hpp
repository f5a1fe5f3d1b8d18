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

// Lane i: *p[i].
static inline Pack fetch(const double* const* p) {
#if defined(__AVX512F__)
  return _mm512_i64gather_pd(_mm512_load_si512(p), nullptr, 1);
#else
  alignas(64) double values[pack_lanes];
  for (int i = 0; i < pack_lanes; ++i) values[i] = *p[i];
  return load(values);
#endif
}

// ++p[i], where bit i of `lanes` is set.
static inline void advance(const double** p, unsigned lanes) {
#if defined(__AVX512F__)
  const __m512i at = _mm512_load_si512(p);
  _mm512_store_si512(p, _mm512_mask_add_epi64(at, static_cast<__mmask8>(lanes), at, _mm512_set1_epi64(sizeof(double))));
#else
  for (int i = 0; i < pack_lanes; ++i) p[i] += lanes >> i & 1U;
#endif
}

static inline Pack choose(const PackMask& mask, const Pack& yes, const Pack& no) {
  return xsimd::select(mask, yes, no);
}

}  // namespace freestand
