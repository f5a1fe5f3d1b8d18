// Work as a list of jobs, each of which answers with numbers: who runs them may be spread over processes.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace freestand {

// Runs job(0) ... job(n - 1), anywhere and in any order, and returns their answers in order. `what`: for progress.
using Job = std::function<std::vector<double>(std::size_t)>;
using Jobs = std::function<std::vector<std::vector<double>>(const std::string& what, std::size_t n, const Job&)>;

// One after the other, here.
inline std::vector<std::vector<double>> run_here(const std::string&, std::size_t n, const Job& job) {
  std::vector<std::vector<double>> answers;
  for (std::size_t i = 0; i < n; ++i) answers.push_back(job(i));
  return answers;
}

}  // namespace freestand
