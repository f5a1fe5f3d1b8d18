#include <fmt/format.h>

#include <algorithm>
#include <freestand/error.hpp>
#include <optional>

#include "exports/csv_rows.hpp"
#include "exports/exporter.hpp"

namespace freestand::exports::check_csv {
namespace {

struct Lines {
  std::vector<double> x, y;
};

// Whoever reads a table draws straight lines between its points.
double between(const Lines& lines, double at) {
  const auto above = std::upper_bound(lines.x.begin(), lines.x.end(), at);
  if (above == lines.x.begin()) return lines.y.front();
  if (above == lines.x.end()) return lines.y.back();
  const auto i = static_cast<std::size_t>(above - lines.x.begin());
  return lines.y[i - 1] + (at - lines.x[i - 1]) / (lines.x[i] - lines.x[i - 1]) * (lines.y[i] - lines.y[i - 1]);
}

// id: whose rows they are, of a table of many.
ReadBack read(const std::filesystem::path& file, const Intensity& im, const std::optional<std::string>& id) {
  const CsvTable table(file);
  ReadBack back;
  std::vector<Lines> states;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (id && table.text(row, "id") != *id) continue;
    const std::string name = im.period_s > 0 ? fmt::format("{} at {} s", im.name, im.period_s) : im.name;
    if (table.text(row, "im") != name || table.text(row, "im_unit") != im.unit)
      throw Error(
          fmt::format("{} names another intensity than {} (its row {}): export again", file.string(), im.name, row + 2),
          Exit::data);
    const std::string& state = table.text(row, "limit_state");
    if (back.states.empty() || back.states.back() != state) {
      back.states.push_back(state);
      states.emplace_back();
    }
    states.back().x.push_back(table.number(row, "im_value"));
    states.back().y.push_back(table.number(row, "probability"));
  }
  if (id && states.empty())
    throw Error(fmt::format("{} has no row of {}: export again", file.string(), *id), Exit::data);
  back.unit = im.unit;
  back.probability = [states](std::size_t s, double value) { return between(states[s], value); };
  return back;
}

ReadBack open(const std::filesystem::path& file, const Intensity& im) { return read(file, im, {}); }
ReadBack open_one(const std::filesystem::path& file, const Intensity& im, const std::string& id) {
  return read(file, im, id);
}

const RegisterCheck here{{.name = "csv", .open = open, .open_one = open_one}};

}  // namespace
}  // namespace freestand::exports::check_csv
