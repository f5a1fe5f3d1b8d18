// Which effects may join a model, by the count of tests, and which pairs have been tried.
#pragma once

#include <set>
#include <string>
#include <utility>

#include "measurement/predict/model.hpp"

namespace freestand::measurement {

// With at least as many numbers as tests nothing could be left out.
bool fewer_numbers_than(std::size_t tests, const ModelSpec&, const dynamics::Effect& joining);

class Pairs {
 public:
  explicit Pairs(std::size_t tests) : tests_(tests) {}

  // May the other effect join the model that has the first? Where only the tests are too few, the pair is refused.
  bool may_be(const ModelSpec&, const std::string& first, const dynamics::Effect& other);
  void add(const std::string& a, const std::string& b) { tried_.insert(std::minmax(a, b)); }
  bool tried(const std::string& a, const std::string& b) const { return tried_.count(std::minmax(a, b)) > 0; }
  const std::set<std::pair<std::string, std::string>>& refused() const { return refused_; }

 private:
  std::size_t tests_;
  std::set<std::pair<std::string, std::string>> tried_, refused_;
};

}  // namespace freestand::measurement
