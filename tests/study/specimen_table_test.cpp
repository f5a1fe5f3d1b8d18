// Tables of specimens.
#include "study/specimen_table.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <fstream>

#include "support/scratch.hpp"

namespace freestand::study {
namespace {

// Seconds of the processor to read a table of so many rows.
double seconds(const freestand::test::Scratch& scratch, int rows, const std::string& mu) {
  const std::filesystem::path file = scratch / "table.csv";
  std::ofstream out(file);
  out << "id,class,width_m,height_m,mu\n";
  for (int row = 0; row < rows; ++row) out << "rack-" << row << ",rack,0.6,1.9," << mu << '\n';
  out.close();
  Problems problems(file.string());
  const std::clock_t start = std::clock();
  EXPECT_EQ(read_specimen_table(file, problems).size() + problems.count(), static_cast<std::size_t>(rows));
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// Sixteen times the rows take sixteen times as long, right ones and such as no number is in; where each row reads all lines before it they
// take 256 times as long.
TEST(SpecimenTable, TakesAsLongAsItHasRows) {
  const freestand::test::Scratch scratch("specimens");
  for (const char* mu : {"0.3", "{uniform: [0.2"})
    EXPECT_LT(seconds(scratch, 16000, mu), 48 * seconds(scratch, 1000, mu)) << mu;
}

}  // namespace
}  // namespace freestand::study
