#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/folder.hpp"
#include "io/own_files.hpp"
#include "io/text_files.hpp"
#include "io/written_files.hpp"
#include "study/sensitivity.hpp"

namespace freestand::study {
namespace {

using Json = nlohmann::ordered_json;

std::string number_cell(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

Json estimate_json(const fragility::Estimate& estimate) {
  return {{"value", estimate.value}, {"se", estimate.se}, {"lower", estimate.lower}, {"upper", estimate.upper}};
}

std::string estimate_cells(const fragility::Estimate& estimate) {
  return fmt::format("{},{},{},{}", number_cell(estimate.value), number_cell(estimate.se), number_cell(estimate.lower),
                     number_cell(estimate.upper));
}

// What the answer is, as one word: for readers of the files.
const char* kind(const decision::Answer& answer) {
  return !answer.yes_or_no ? "ln_demand" : std::isnan(answer.capacity) ? "happens" : "exceeds";
}

}  // namespace

Json sensitivity_json(const Sensitivity& found) {
  Json json{
      {"format", sensitivity_format},
      {"confidence", found.confidence},
      {"estimator",
       {{"share", "Var(E[Y|X])/Var(Y), from classes of X of equal probability (Kelley 1935), motions left out in turn"},
        {"total", "E[(Y-Y')^2]/(2 Var(Y)), Y' with X drawn again (Jansen 1999), motions left out in turn"}}},
      {"pairs", found.pairs},
      {"note", found.note},
      {"parameters", Json::array()},
      {"answers", Json::array()}};
  for (const auto& parameter : found.parameters)
    json["parameters"].push_back({{"name", parameter.name}, {"unit", parameter.unit}});
  for (std::size_t a = 0; a < found.answers.size(); ++a) {
    const decision::ShareRow& row = found.rows[a];
    Json one{{"edp", found.answers[a].edp}, {"unit", found.answers[a].unit}, {"kind", kind(found.answers[a])}};
    one["capacity"] = found.answers[a].capacity;
    one["title"] = title(found.answers[a]);
    one["samples"] = row.samples;
    one["motions"] = row.motions;
    one["mean"] = row.mean;
    one["variance"] = row.variance;
    one["why_empty"] = found.why_empty[a];
    if (found.pairs > 0) one["why_no_total"] = found.why_no_total[a];
    one["shares"] = Json::object();
    for (std::size_t p = 0; p < row.share.size(); ++p) {
      one["shares"][found.parameters[p].name] = {{"share", estimate_json(row.share[p])}};
      if (!found.totals[a].empty()) {
        one["shares"][found.parameters[p].name]["total"] = estimate_json(found.totals[a][p].share);
        one["shares"][found.parameters[p].name]["pairs"] = found.totals[a][p].pairs;
      }
    }
    if (!row.share.empty()) one["together"] = estimate_json(row.together);
    json["answers"].push_back(one);
  }
  return json;
}

std::string sensitivity_csv(const Sensitivity& found) {
  std::string text =
      "edp,kind,capacity,unit,parameter,share,share_se,share_lower,share_upper,total,total_se,total_lower,total_upper,"
      "samples,motions,pairs\n";
  for (std::size_t a = 0; a < found.answers.size(); ++a)
    for (std::size_t p = 0; p < found.rows[a].share.size(); ++p) {
      const decision::Answer& answer = found.answers[a];
      const bool total = !found.totals[a].empty();
      text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", answer.edp, kind(answer), number_cell(answer.capacity),
                          answer.unit, found.parameters[p].name, estimate_cells(found.rows[a].share[p]),
                          total ? estimate_cells(found.totals[a][p].share) : ",,,", found.rows[a].samples,
                          found.rows[a].motions, total ? fmt::format("{}", found.totals[a][p].pairs) : "");
    }
  return text;
}

void write_sensitivity(const Sensitivity& found, const SensitivityOptions& options) {
  const std::filesystem::path folder = options.output.empty() ? options.folder : options.output;
  io::refuse_others(folder, {"sensitivity.json", "sensitivity.csv"});
  make_folder(folder);
  io::write_result(folder / "sensitivity.csv", sensitivity_csv(found));
  io::write_result(folder / "sensitivity.json", io::json_text(sensitivity_json(found)));
}

}  // namespace freestand::study
