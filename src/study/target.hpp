// Other distributions of what was sampled than those of the sweep: `target` of the fragility block.
//
// A sample stays with probability r/max r, where r is how much likelier its draw is in the target than in the sweep
// (rejection: J. von Neumann, Applied Math Series 12, 1951). Those that stay are samples of the target, each counted once,
// so that every count, error and test after it holds as it stands.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sampling/design.hpp"
#include "study/problems.hpp"
#include "study/study.hpp"

namespace freestand::study {

class Target {
 public:
  // r of each cell of the draws' uniforms, which are many. Within one the samples lie as they were swept: the target is
  // followed but for a share of max r / 2^16.
  static constexpr std::size_t cells = 1 << 16;

  explicit Target(const Study&);

  bool empty() const { return parts_.empty(); }
  bool keeps(std::uint64_t sample) const;  // a pure function of the sample's number
  double kept_share() const;               // of many samples

  // "target: a quarter of the samples stays ..."; empty without one.
  std::string told() const;

 private:
  struct Part {
    sampling::Stream stream;
    sampling::Distribution swept;
    std::vector<double> stays;  // by cell of the uniform, r/max r
    std::string wanted;         // "friction.mu_k is {lognormal: ...}"
    double share = 0;           // 1/max r
    double outside = 0;         // of the target, where nothing was swept
  };
  std::vector<Part> parts_;
  std::uint64_t seed_;
};

// Targets of numbers that the study does not sample, or that reach to where nothing was swept.
void check_target(const Study&, Problems&);

// "curves are those of the target (friction.mu_k {...}), not of what was swept"; empty without one. For what is made of curves.
std::string target_told(const Study&);

}  // namespace freestand::study
