// One instruction set of the kernels that compute blocks (dynamics/batch.hpp), for as long as the object lives.
#pragma once

#include <cstdlib>
#include <cstring>

#include "dynamics/batch.hpp"

namespace freestand::test {

// All that there may be; a build for one machine alone has its own.
inline constexpr const char* instruction_sets[] = {"v2", "v3", "v4", "own"};

class Isa {
 public:
  explicit Isa(const char* name) : name_(name) { setenv("FREESTAND_ISA", name, 1); }
  ~Isa() { unsetenv("FREESTAND_ISA"); }
  Isa(const Isa&) = delete;
  Isa& operator=(const Isa&) = delete;

  // This machine and this build have it: else another one is taken in its place.
  bool there() const {
    const dynamics::BatchKernels* kernels = dynamics::batch_kernels();
    return kernels && !std::strcmp(kernels->name, name_);
  }

 private:
  const char* name_;
};

}  // namespace freestand::test
