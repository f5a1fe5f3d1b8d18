// The report [KM05] computed again: what comes out of one of its tables or figures, ours beside the print.
//
// D. Konstantinidis and N. Makris, PEER report 2005/07. One file of this folder is one table or figure: it registers itself
// by name, as pulses and demands do.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/jobs.hpp"
#include "base/registry.hpp"

namespace freestand::report {

enum class Verdict {
  agrees,                       // within rounding
  disagrees,                    // the program's physics gives another number
  print_disagrees_with_itself,  // the print's own tables and equations give another one
  not_printed                   // nothing to compare with: ours stands alone
};
const char* name(Verdict);

struct Range {
  double low = 0, high = 0;
};

// One number. `print` is what the report says, rounded to `print_unit` (0.01: two decimals). `reach`: from where to where our
// number goes while the inputs, which the report prints rounded too, go through all that they may have been.
struct Number {
  std::string id, what, unit = "1";
  double ours = std::numeric_limits<double>::quiet_NaN();
  std::optional<double> print = {};
  double print_unit = 0;
  std::optional<Range> reach = {};
  Verdict verdict = Verdict::not_printed;
  std::string why = {};

  double difference() const;  // ours - print; nan where nothing is printed
};

// A finding in words, on both sides.
struct Statement {
  std::string id, what, ours, print;
  Verdict verdict = Verdict::not_printed;
  std::string why = {};
};

// A table behind a picture. Becomes FILE.csv; its first columns are `figure` and `series`.
using Cell = std::variant<double, std::string>;
struct Sheet {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;  // the first cell is the series
};

struct Item {
  std::vector<Number> numbers = {};
  std::vector<Statement> statements = {};
  std::vector<Sheet> sheets = {};
  std::vector<std::string> left_out = {};  // what of this table or figure is not computed, and why
};

// What the items are computed from.
struct Sources {
  std::filesystem::path tables;                  // the printed tables, configs/report
  std::optional<std::filesystem::path> records;  // the report's records, where there are any
  Jobs jobs = run_here;                          // the long ones
};

struct Entry {
  std::string name;  // "table_5_1"
  int order = 0;     // in the report
  int chapter = 0;
  std::string place;  // "Table 5.1"
  std::string what;   // one line
  Item (*compute)(const Sources&) = nullptr;
};
using RegisteredItem = Registered<Entry>;

// In the order of the report.
std::vector<Entry> entries();

// Sets the verdict: `agrees` where the print's own rounding reaches our number or its reach; else `otherwise`, with `why`.
Number compared(Number, Verdict otherwise, std::string why);

// Does the rounded print reach the range?
bool reaches(double print, double print_unit, Range);

}  // namespace freestand::report
