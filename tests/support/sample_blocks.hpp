// A made-up sweep: columns of every kind, each value a plain function of the sample's number.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "io/samples_file.hpp"

namespace freestand::test {

inline io::SamplesHeader small_header() {
  io::SamplesHeader header;
  header.provenance.version = "0.0.0";
  header.provenance.git_commit = "abc";
  header.provenance.libraries = "{}";
  header.provenance.created_utc = "2000-01-01T00:00:00Z";
  header.provenance.study = "seed: 7\n# études\n";
  header.provenance.study_name = "small";
  header.provenance.seed = 7;
  header.columns = {{"block_width_m", "m", "width", ColumnKind::real},
                    {"edp_delta", "m", "", ColumnKind::real},
                    {"impacts", "1", "impacts", ColumnKind::integer},
                    {"motion", "1", "index into /motions/name", ColumnKind::integer},
                    {"outcome", "1", "how it ended", ColumnKind::integer},
                    {"overturned", "1", "", ColumnKind::flag}};
  header.motions.names = {"A", "records/x y.AT2", "é"};
  header.motions.group = {-1, 1, 2};
  header.motions.table = {{{"pga_mps2", "m/s2", "peak", ColumnKind::real}, {"pulse_type", "1", "", ColumnKind::integer}},
                          {1, -1, 3.7, 2, 1.0 / 3, 0}};
  header.motions.sa_period_s = {0.1, 0.5};
  header.motions.sa_mps2 = {1, 2, 0.1, 0.7, 5, 6};
  return header;
}

inline double small_value(std::int64_t sample, std::size_t column) {
  const auto i = static_cast<double>(sample);
  switch (column) {
    case 0:
      return 0.1 * i + 0.3;
    case 1:
      return sample % 10 == 0 ? std::numeric_limits<double>::quiet_NaN() : i * i;
    case 2:
      return 0.0 - i;
    case 3:
      return static_cast<double>(sample % 3);
    case 4:
      return static_cast<double>(sample % 6);
    default:
      return static_cast<double>(sample % 2);
  }
}

inline std::vector<double> small_rows(std::int64_t first, std::int64_t count) {
  std::vector<double> values;
  for (std::int64_t sample = first; sample < first + count; ++sample)
    for (std::size_t column = 0; column < 6; ++column) values.push_back(small_value(sample, column));
  return values;
}

inline io::ReadBlock small_blocks(const io::BlockLayout& layout) {
  return [layout](std::int64_t block) { return small_rows(block * layout.block_size, layout.rows(block)); };
}

}  // namespace freestand::test
