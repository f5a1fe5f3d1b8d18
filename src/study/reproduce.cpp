#include "study/reproduce.hpp"

#include <fmt/format.h>

#include <cmath>
#include <freestand/error.hpp>
#include <nlohmann/json.hpp>

#include "base/folder.hpp"
#include "io/csv_cell.hpp"
#include "io/output_folder.hpp"
#include "io/own_files.hpp"
#include "io/provenance.hpp"
#include "io/text_files.hpp"
#include "io/written_files.hpp"
#include "report/own_peaks.hpp"
#include "study/spread_jobs.hpp"

namespace freestand::study {
namespace {

using Json = nlohmann::ordered_json;
using report::Verdict;

constexpr const char* json_name = "reproduce.json";

Json or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json number_json(const report::Number& number) {
  Json json{{"id", number.id},
            {"kind", "number"},
            {"what", number.what},
            {"unit", number.unit},
            {"ours", or_null(number.ours)}};
  json["print"] = number.print ? Json(*number.print) : Json();
  json["print_unit"] = number.print ? Json(number.print_unit) : Json();
  json["reach"] = number.reach ? Json{number.reach->low, number.reach->high} : Json();
  json["difference"] = or_null(number.difference());
  json["verdict"] = name(number.verdict);
  json["why"] = number.why;
  return json;
}

Json statement_json(const report::Statement& statement) {
  return {{"id", statement.id},
          {"kind", "statement"},
          {"what", statement.what},
          {"ours", statement.ours},
          {"print", statement.print.empty() ? Json() : Json(statement.print)},
          {"difference", Json()},
          {"verdict", name(statement.verdict)},
          {"why", statement.why}};
}

std::string file_of(const report::Sheet& sheet) { return sheet.name + ".csv"; }

Json figure_json(const report::Entry& entry, const report::Item& item) {
  Json json{{"id", entry.name}, {"chapter", entry.chapter}, {"place", entry.place}, {"what", entry.what}};
  json["items"] = Json::array();
  for (const report::Number& number : item.numbers) json["items"].push_back(number_json(number));
  for (const report::Statement& statement : item.statements) json["items"].push_back(statement_json(statement));
  json["files"] = Json::array();
  for (const report::Sheet& sheet : item.sheets) json["files"].push_back(file_of(sheet));
  json["left_out"] = item.left_out;
  return json;
}

std::string csv_of(const report::Entry& entry, const report::Sheet& sheet) {
  std::string text = "figure,series";
  for (const std::string& column : sheet.columns) text += "," + column;
  text += "\n";
  for (const std::vector<report::Cell>& row : sheet.rows) {
    text += entry.name;
    for (const report::Cell& cell : row)
      text += "," + std::visit([](const auto& value) { return io::cell(value); }, cell);
    text += "\n";
  }
  return text;
}

}  // namespace

std::filesystem::path tables_of_the_source() { return FREESTAND_REPORT_TABLES; }

Agreement agreement(const Reproduced& found) {
  Agreement counts;
  for (const auto& [entry, item] : found.items)
    for (const report::Number& number : item.numbers) {
      counts.printed += number.verdict != Verdict::not_printed;
      counts.agree += number.verdict == Verdict::agrees;
      counts.disagree += number.verdict == Verdict::disagrees;
      counts.with_itself += number.verdict == Verdict::print_disagrees_with_itself;
    }
  return counts;
}

Reproduced reproduce(const parallel::Communicator& world, const ReproduceOptions& options) {
  report::Sources sources{options.tables, options.records, spread_jobs(world, options.quiet)};
  if (options.peaks) return {report::own_peaks(*options.peaks, sources.jobs), true};
  if (options.records && !is_folder(*options.records))
    throw Error(
        fmt::format("{} is no folder (the report's records lie in one): check --records", options.records->string()),
        Exit::data);
  Reproduced found;
  for (const report::Entry& entry : report::entries()) found.items.emplace_back(entry, entry.compute(sources));
  return found;
}

void prepare(const ReproduceOptions& options) {
  io::take_output_folder(options.output, io::existing(options.overwrite),
                         {.writes = {json_name}, .reads = {options.peaks.value_or("")}});
}

Json reproduce_json(const Reproduced& found, const ReproduceOptions& options, int ranks) {
  const Agreement counts = agreement(found);
  const io::Provenance from = io::provenance_here(options.command, ranks);
  Json json{{"format", reproduce_format},
            {"own_peaks", options.peaks ? Json(options.peaks->filename().string()) : Json()}};
  json["numbers_printed"] = counts.printed;
  json["numbers_that_agree"] = counts.agree;
  json["numbers_that_disagree"] = counts.disagree;
  json["numbers_in_which_the_print_disagrees_with_itself"] = counts.with_itself;
  json["records"] = options.records.has_value();
  json["figures"] = Json::array();
  for (const auto& [entry, item] : found.items) json["figures"].push_back(figure_json(entry, item));
  json["provenance"] = {
      {"version", from.version}, {"git_commit", from.git_commit},   {"compiler", from.compiler}, {"host", from.host},
      {"ranks", ranks},          {"created_utc", from.created_utc}, {"command", options.command}};
  return json;
}

void write(const Reproduced& found, const ReproduceOptions& options, int ranks) {
  std::vector<std::string> files;
  for (const auto& [entry, item] : found.items)
    for (const report::Sheet& sheet : item.sheets) files.push_back(file_of(sheet));
  io::refuse_others(options.output, files);
  for (const auto& [entry, item] : found.items)
    for (const report::Sheet& sheet : item.sheets)
      io::write_result(options.output / file_of(sheet), csv_of(entry, sheet));
  io::write_result(options.output / json_name, io::json_text(reproduce_json(found, options, ranks)));
}

}  // namespace freestand::study
