// One plain table: a row for each limit state and bin, the fragility function behind it on every row.
#include <fmt/format.h>

#include <cmath>

#include "exports/exporter.hpp"

namespace freestand::exports::csv {
namespace {

std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  quoted += '"';
  return quoted;
}

std::string cell(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

// "sa_g at 1 s"
std::string name_of(const Intensity& im) {
  return im.period_s > 0 ? fmt::format("{} at {} s", im.name, im.period_s) : im.name;
}

// start: what stands before each row
std::string rows(const Model& model, const LimitState& state, const std::string& start) {
  const Fitted& f = state.fitted;
  const std::string head = start + fmt::format("{},{},{},{},{},{}", state.name, cell(state.demand),
                                               cell(state.capacity), state.unit, name_of(model.im), model.im.unit);
  const std::string tail = fmt::format("{},{},{},{},{},{}", cell(f.median), cell(f.median_se), cell(f.dispersion),
                                       cell(f.dispersion_se), cell(f.off_by),
                                       f.adequate      ? "yes"
                                       : f.not_refuted ? "not refuted"
                                                       : "no");
  std::string text;
  for (const Bin& bin : state.bins)
    text += fmt::format("{},{},{},{},{},{},{},{}\n", head, cell(bin.im), cell(bin.probability), cell(bin.lower),
                        cell(bin.upper), cell(bin.counted), bin.n, tail);
  return text;
}

constexpr const char* columns =
    "limit_state,demand,capacity,capacity_unit,im,im_unit,im_value,probability,lower,upper,counted,n,median,median_se,"
    "dispersion,dispersion_se,off_by,adequate\n";

std::vector<File> write(const Model& model, const std::string& name) {
  std::string text = columns;
  for (const LimitState& state : model.states) text += rows(model, state, "");
  return {{name, text}};
}

std::vector<File> write_all(const Collection& all, const std::string& name) {
  std::string text = std::string("id,") + columns;
  for (const Model& model : all.models)
    for (const LimitState& state : model.states) text += rows(model, state, cell(model.id) + ",");
  return {{name, text}};
}

const Register here{{.name = "csv",
                     .summary = "one plain table: bins with their bands, and the fitted functions with their errors",
                     .file = "fragility.csv",
                     .forms = {Form::discrete},
                     .table = true,
                     .bands = true,
                     .write = write,
                     .write_all = write_all}};

}  // namespace
}  // namespace freestand::exports::csv
