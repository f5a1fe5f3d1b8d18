#include "study/posterior_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <freestand/error.hpp>
#include <fstream>
#include <map>
#include <optional>

#include "base/csv_table.hpp"
#include "base/shown_text.hpp"
#include "measurement/predict/placements.hpp"
#include "study/section.hpp"

namespace freestand::study {
namespace {

// What stands in a table that is to be doubted, and what is said where a study takes it.
struct Mark {
  const char *line, *doubt;
};
constexpr Mark lacks{"# Their model leaves more of the tests than noise does.",
                     "a model that leaves more of its tests than noise does (by how much its numbers are off, they do "
                     "not tell): let diagnose look for what it lacks"},
    wrong{"# Their measurements look wrong in a sign, a clock, a unit or an offset.",
          "measurements that look wrong in a sign, a clock, a unit or an offset (compare says in which): settle that, "
          "and "
          "compare again"};

bool bears(const Mark& mark, const std::filesystem::path& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line) && line.starts_with('#');)
    if (line.starts_with(mark.line)) return true;
  return false;
}

class Tables {
 public:
  Tables(std::filesystem::path folder, Problems& problems) : folder_(std::move(folder)), problems_(problems) {}

  const std::vector<std::string>& doubtful() const { return doubtful_; }

  void fill(YAML::Node node, int line) {
    if (node.IsSequence()) {
      for (std::size_t i = 0; i < node.size(); ++i) fill(node[i], line_of(node[i]) ? line_of(node[i]) : line);
    } else if (node.IsMap() && node["posterior"] && node["posterior"].IsScalar()) {
      if (!node["values"]) take(node, line);
    } else if (node.IsMap()) {
      std::vector<std::string> keys;
      for (const auto& pair : node) keys.push_back(pair.first.Scalar());
      for (const std::string& key : keys) fill(node[key], line_of(node[key]) ? line_of(node[key]) : line);
    }
  }

 private:
  void take(YAML::Node node, int line) {
    const std::string name = node["posterior"].Scalar();
    const std::string column = node["column"] && node["column"].IsScalar() ? node["column"].Scalar() : "";
    const CsvTable* table = read(name, line);
    if (!table) return;
    const std::size_t at = table->column(column);
    if (at == table->columns.size()) {
      problems_.add(line, fmt::format("{} has no column {} (a number takes its draws from one): use one of {}",
                                      table->file.string(), column.empty() ? "(none is named)" : shown(column),
                                      joined(table->columns)));
      return;
    }
    YAML::Node values(YAML::NodeType::Sequence);
    for (const CsvTable::Row& row : table->rows) {
      if (!number_of(row.cells[at])) {
        problems_.add(line, fmt::format("{}{} is \"{}\" (a draw is a finite number): correct it", table->at(row),
                                        shown(column), shown(row.cells[at])));
        return;
      }
      values.push_back(row.cells[at]);
    }
    node["values"] = values;
  }

  // Once; null where it cannot be used, which is told once.
  const CsvTable* read(const std::string& name, int line) {
    const auto known = tables_.find(name);
    if (known != tables_.end()) return known->second ? &*known->second : nullptr;
    std::optional<CsvTable>& table = tables_[name];
    try {
      table = read_csv_table(folder_ / name);
      if (table->column("weight") < table->columns.size())
        doubtful_.push_back(
            fmt::format("{} has a column `weight`, which counts for nothing (rows are drawn alike): repeat rows, as "
                        "often as each weighs",
                        (folder_ / name).string()));
      for (const Mark& mark : {lacks, wrong})
        if (bears(mark, folder_ / name))
          doubtful_.push_back(fmt::format("{} holds draws of {}", (folder_ / name).string(), mark.doubt));
    } catch (const Error& error) {
      problems_.add(line, fmt::format("the table of joint draws cannot be read ({}): give its path from the study's "
                                      "folder, or take the best values with --best",
                                      error.what()));
    }
    return table ? &*table : nullptr;
  }

  std::filesystem::path folder_;
  Problems& problems_;
  std::map<std::string, std::optional<CsvTable>> tables_;
  std::vector<std::string> doubtful_;
};

}  // namespace

std::vector<std::string> read_posterior_tables(YAML::Node root, const std::filesystem::path& folder,
                                               Problems& problems) {
  Tables tables(folder, problems);
  tables.fill(root, line_of(root));
  return tables.doubtful();
}

std::string posterior_text(const measurement::ModelSpec& model, const measurement::Posterior& posterior,
                           bool measurements_look_wrong, const std::optional<KnownMiddle>& middle) {
  if (posterior.draws.empty()) return "";
  std::string text =
      fmt::format("# Joint draws of the numbers that the calibration tests leave open{}.\n",
                  measurement::draws_friction(model, posterior)
                      ? fmt::format("; friction is that of another test (it differs by {:.2g} % from test to test)",
                                    100 * posterior.friction_scatter)
                      : "");
  if (posterior.leaves_too_much) text += fmt::format("{}\n", lacks.line);
  if (measurements_look_wrong) text += fmt::format("{}\n", wrong.line);
  for (std::size_t k = 0; k < model.free.size(); ++k) text += (k ? "," : "") + model.free[k].name;
  if (middle) text += "," + middle->column();
  for (std::size_t s = 0; s < posterior.draws.size(); ++s) {
    const measurement::Values& row = posterior.draws[s];
    text += "\n";
    for (std::size_t k = 0; k < row.size(); ++k) text += fmt::format("{}{}", k ? "," : "", row[k]);
    if (middle)
      text += fmt::format(",{}", measurement::placed_at(model, std::log(middle->value) + posterior.placements[s]));
  }
  return text + "\n";
}

}  // namespace freestand::study
