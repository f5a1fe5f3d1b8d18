// A measurement set as text, from what was read of a laboratory: dataset.yaml, and the csv file of each test.
#pragma once

#include <string>
#include <vector>

#include "study/read_laboratory.hpp"

namespace freestand::study {

// A test on one clock and in equal steps.
struct TestOfLab {
  measurement::Test test;
  double start_s = 0;  // of the floor's file
  std::vector<double> floor, vertical;
};

std::string dataset_text(const Laboratory&, const measurement::Noise&, const std::vector<TestOfLab>&);
std::string csv_text(const TestOfLab&);

}  // namespace freestand::study
