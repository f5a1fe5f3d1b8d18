#include "measurement/verdict/pairs.hpp"

namespace freestand::measurement {

bool fewer_numbers_than(std::size_t tests, const ModelSpec& model, const dynamics::Effect& joining) {
  return model.free.size() + fitted_numbers(joining) < tests;
}

bool Pairs::may_be(const ModelSpec& model, const std::string& first, const dynamics::Effect& other) {
  if (!goes_with(model, other)) return false;
  if (fewer_numbers_than(tests_, model, other)) return true;
  refused_.insert(std::minmax(first, other.name));
  return false;
}

}  // namespace freestand::measurement
