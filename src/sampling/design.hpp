// Designs: how the uniforms of a sweep are spread. Each parameter has its own stream, keyed by its NAME, so that one
// more parameter changes no draw of the others.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace freestand::sampling {

enum class Design { monte_carlo, latin_hypercube, sobol };
const char* name(Design);

// What all streams of a sweep share. `samples` is read by latin_hypercube only (its strata depend on it).
struct Plan {
  Design design = Design::sobol;
  std::uint64_t seed = 1;
  std::uint64_t samples = 0;
  int scrambles = 1;  // designs of their own, which the samples take in turn
  std::vector<std::string> redrawn =
      {};  // parameters that take other draws, independent of all of the design: what does
           // the answer owe them?
};

// The uniforms of one parameter: stream(sample) in the open interval (0, 1), a pure function of (plan, name, sample).
//
// monte_carlo      Philox4x32-10 at (seed; sample, hash of the name).
// latin_hypercube  one point in each of `samples` strata: sample -> stratum by a keyed permutation (Feistel network
// with
//                  cycle walking, O(1) memory), jittered inside the stratum. 0 <= sample < samples.
// sobol            Sobol points of Joe & Kuo (2008) with nested uniform (Owen) scrambling keyed by (seed, name): over
// any
//                  block of 2^m samples that starts at a multiple of 2^m each dyadic interval of length 2^-m is hit
//                  once. Known parameter names have fixed dimensions (sobol_dimension). Any other name takes the first
//                  dimension with its samples in an order of its own (nested uniform shuffle of the index, [Owen 2003;
//                  Burley 2020], and within blocks of 64 any order): as even by itself over blocks of 64 and more, and
//                  paired at random with the others.
//
// With Plan::scrambles = R, sample i is point i/R of the design numbered i mod R. The R designs are scrambled (permuted)
// independently, so that how answers differ between them shows how well the design knows them (A. Owen, J. of
// Complexity 14, 1998). The design numbered 0 is the one of a single scramble.
//
// Of a parameter of Plan::redrawn: as monte_carlo, at a stream of its own.
class Stream {
 public:
  // Throws Error for latin_hypercube without samples.
  Stream(const Plan&, std::string_view parameter);
  double operator()(std::uint64_t sample) const;

 private:
  double latin_hypercube(std::uint64_t sample) const;
  double sobol(std::uint64_t sample) const;
  std::uint64_t replicate(std::uint64_t sample) const { return sample % static_cast<std::uint64_t>(plan_.scrambles); }
  std::uint64_t point(std::uint64_t sample) const { return sample / static_cast<std::uint64_t>(plan_.scrambles); }

  Plan plan_;
  bool redrawn_;
  std::uint64_t stream_;     // hash of the name
  std::uint64_t key_;        // of the permutation or scrambling, from (seed, name)
  std::uint64_t order_key_;  // of the shuffle of the index; 0: none
  int dimension_;
};

// Fixed dimension of a known parameter, 0-based; -1 for other names. Parameters that exclude each other (width or
// slenderness, peak acceleration or scale) share one.
int sobol_dimension(std::string_view parameter);

}  // namespace freestand::sampling
