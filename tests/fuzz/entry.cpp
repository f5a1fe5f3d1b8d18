// What libFuzzer calls: FREESTAND_FUZZ_TARGET says which target its bytes go to.
#include <cstdint>
#include <cstdlib>

#include "spoilt_files/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* name = std::getenv("FREESTAND_FUZZ_TARGET");
  static const freestand::spoilt_files::Target& target = freestand::spoilt_files::target(name ? name : "");
  target.take({reinterpret_cast<const char*>(data), size});
  return 0;
}
