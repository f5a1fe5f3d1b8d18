// Reads fragility.csv and fragility.json as pelicun does: intensities in its own units (m, s), the numbers of a
// multilinear_CDF written again with %g.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <freestand/error.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/durable_file.hpp"
#include "exports/csv_rows.hpp"
#include "exports/exporter.hpp"

namespace freestand::exports::check_pelicun {
namespace {

void require(bool holds, const std::filesystem::path& file, const std::string& rule) {
  if (!holds)
    throw Error(fmt::format("{} is not what pelicun reads ({}): export again, and tell the makers of freestand",
                            file.string(), rule),
                Exit::data);
}

double again_with_six_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return std::strtod(text, nullptr);
}

std::vector<double> list(const std::string& text) {
  std::vector<double> values;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) values.push_back(std::strtod(word.c_str(), nullptr));
  return values;
}

// pelicun's units of acceleration, velocity and length.
double in_si(const std::string& unit) {
  return unit == "g" ? 9.80665 : unit == "mps2" || unit == "mps" || unit == "m" ? 1 : 0;
}

// The demand that an intensity of freestand is, and its unit in SI.
void require_demand(const CsvTable& table, std::size_t row, const Intensity& im, const std::filesystem::path& file) {
  const std::string type = table.text(row, "Demand-Type"), unit = table.text(row, "Demand-Unit");
  const bool fits = im.unit == "g"
                        ? (type == "Peak Floor Acceleration" || type.starts_with("Spectral Acceleration|")) &&
                              (unit == "g" || unit == "mps2")
                    : im.unit == "m/s" ? type == "Peak Floor Velocity" && unit == "mps"
                    : im.unit == "m"   ? type == "Peak Floor Displacement" && unit == "m"
                                       : false;
  require(fits, file, type + " in " + unit + " is the demand that was fitted");
  if (const std::size_t bar = type.find('|'); bar != std::string::npos)
    require(std::stod(type.substr(bar + 1)) == im.period_s, file, "the period is the one that was fitted");
  require(table.text(row, "Incomplete") == "0" && table.text(row, "Demand-Offset") == "0" &&
              table.text(row, "Demand-Directional") == "1",
          file, "it is complete, at its own floor, in its own direction");
}

struct Capacity {
  bool lognormal = true;
  double median = 0, dispersion = 0;
  std::vector<double> x, y;

  double at(double demand) const {
    if (lognormal) return 0.5 * std::erfc(-std::log(demand / median) / dispersion / std::sqrt(2.0));
    if (demand <= x.front()) return 0;
    if (demand >= x.back()) return 1;
    const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), demand) - x.begin());
    return y[i - 1] + (demand - x[i - 1]) * (y[i] - y[i - 1]) / (x[i] - x[i - 1]);
  }

  // Rounding x to six digits moves it by at most 5e-6 of itself, y by 5e-7, and the numbers of a plateau were set one step
  // of the sixth digit apart.
  double rounds_by() const {
    double steepest = 0;
    for (std::size_t i = 1; i < x.size(); ++i)
      steepest = std::max(steepest, (y[i] - y[i - 1]) / (x[i] - x[i - 1]) * x[i]);
    return lognormal ? 0 : 5e-6 * steepest + 2.5e-6;
  }
};

Capacity multilinear(const std::string& cell, double unit, const std::filesystem::path& file) {
  const std::size_t bar = cell.find('|');
  require(bar != std::string::npos, file, "a multilinear_CDF is x,x,x|y,y,y");
  Capacity capacity{false, 0, 0, list(cell.substr(0, bar)), list(cell.substr(bar + 1))};
  for (double& x : capacity.x) x = again_with_six_digits(x * unit);
  for (double& y : capacity.y) y = again_with_six_digits(y);
  require(capacity.x.size() == capacity.y.size() && capacity.x.size() > 1, file, "there are as many x as y");
  require(capacity.y.front() == 0 && capacity.y.back() == 1, file, "y begins at exactly 0 and ends at exactly 1");
  // numpy.isclose takes differences up to 1e-8 for none.
  for (std::size_t i = 1; i < capacity.x.size(); ++i)
    require(capacity.x[i] - capacity.x[i - 1] > 1e-8 && capacity.y[i] - capacity.y[i - 1] > 1e-8, file,
            "x and y rise strictly, in six digits");
  return capacity;
}

// The keys of the library, and no others.
void require_words(const std::filesystem::path& file, const std::string& id, std::size_t states,
                   std::size_t components) {
  const auto all = nlohmann::json::parse(read_whole(file), nullptr, false);
  require(all.is_object() && all.size() == 1 + components && all.contains(id) && all.contains("_GeneralInformation"),
          file, "it holds _GeneralInformation and the words of this component");
  for (const char* key : {"ShortName", "Description", "Version", "ComponentGroups"})
    require(all["_GeneralInformation"].contains(key), file, std::string("_GeneralInformation has ") + key);
  const auto& words = all[id];
  const std::vector<std::string> known = {"Comments", "Description", "LimitStates", "RoundUpToIntegerQuantity",
                                          "SuggestedComponentBlockSize"};
  std::vector<std::string> keys;
  for (const auto& [key, value] : words.items()) keys.push_back(key);
  require(keys == known, file, "a component has these keys only: Comments, Description, LimitStates, ...");
  const auto& rounds = words["RoundUpToIntegerQuantity"];
  require(rounds == "True" || rounds == "False", file, "RoundUpToIntegerQuantity is a text, True or False");
  require(words["LimitStates"].size() == states, file, "each limit state has its words");
}

// The component of that id, or the only one: "".
ReadBack open_one(const std::filesystem::path& file, const Intensity& im, const std::string& wanted) {
  const CsvTable table(file);
  require(!wanted.empty() || table.rows() == 1, file, "it holds one component");
  std::size_t row = wanted.empty() ? 0 : table.rows();
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (!wanted.empty() && table.text(i, "ID") == wanted) {
      require(row == table.rows(), file, "the component " + wanted + " stands there once");
      row = i;
    }
  require(row < table.rows(), file, "it holds the component " + wanted);
  require_demand(table, row, im, file);
  const std::string id = table.text(row, "ID");
  require(!id.empty() && id.find('-') == std::string::npos, file, "the id holds no -");
  const double unit = in_si(table.text(row, "Demand-Unit"));
  std::vector<Capacity> capacities;
  for (int s = 1; table.has(fmt::format("LS{}-Family", s)); ++s) {
    const auto column = [&](const char* name) { return fmt::format("LS{}-{}", s, name); };
    const std::string family = table.text(row, column("Family"));
    if (family.empty() && !capacities.empty()) break;  // others have more
    require(table.text(row, column("DamageStateWeights")).empty(), file, "a limit state has one damage state");
    if (family == "lognormal")
      capacities.push_back(
          {true, table.number(row, column("Theta_0")) * unit, table.number(row, column("Theta_1")), {}, {}});
    else if (family == "multilinear_CDF")
      capacities.push_back(multilinear(table.text(row, column("Theta_0")), unit, file));
    else
      require(false, file, family + " is a family");
  }
  require_words(file.parent_path() / "fragility.json", id, capacities.size(), table.rows());
  const double own = im.unit == "g" ? 9.80665 : 1;
  ReadBack back{{}, {}, table.text(row, "Demand-Unit"), "", 0};
  for (const Capacity& capacity : capacities) {
    back.rounds_by = std::max(back.rounds_by, capacity.rounds_by());
    if (!capacity.lognormal) back.rounding = "pelicun writes the numbers of a multilinear_CDF again with six digits";
  }
  back.probability = [capacities, own](std::size_t s, double value) { return capacities[s].at(value * own); };
  return back;
}

ReadBack open(const std::filesystem::path& file, const Intensity& im) { return open_one(file, im, ""); }

const RegisterCheck here{{.name = "pelicun", .open = open, .open_one = open_one}};

}  // namespace
}  // namespace freestand::exports::check_pelicun
