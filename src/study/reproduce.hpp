// The report's tables and figures computed again, or a user's own table of peaks treated alike: reproduce.json, and a csv for
// each picture.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "parallel/communicator.hpp"
#include "report/item.hpp"

namespace freestand::study {

inline constexpr const char* reproduce_format = "freestand-reproduce/1";

struct ReproduceOptions {
  std::filesystem::path output;
  std::filesystem::path tables;                  // configs/report of the source where it is not given
  std::optional<std::filesystem::path> records;  // folder of the report's records
  std::optional<std::filesystem::path> peaks;    // a table of the user's: the report is then not computed
  bool overwrite = false, quiet = false;
  std::string command;
};

// Where this program was built from.
std::filesystem::path tables_of_the_source();

struct Reproduced {
  std::vector<std::pair<report::Entry, report::Item>> items;  // in the report's order
  bool own_peaks = false;
};

// Numbers that are printed, and how many of them agree within rounding.
struct Agreement {
  int printed = 0, agree = 0, disagree = 0, with_itself = 0;
};
Agreement agreement(const Reproduced&);

// Collective: every rank gets all of it, the same on any number of ranks. Throws Error (Exit::data): a table or record that cannot be used.
Reproduced reproduce(const parallel::Communicator&, const ReproduceOptions&);

// The folder, before anything is computed, and the files into it. One rank does either.
void prepare(const ReproduceOptions&);
void write(const Reproduced&, const ReproduceOptions&, int ranks);

nlohmann::ordered_json reproduce_json(const Reproduced&, const ReproduceOptions&, int ranks);

}  // namespace freestand::study
