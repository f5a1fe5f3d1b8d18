#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <freestand/error.hpp>

#include "base/folder.hpp"
#include "base/shown_text.hpp"
#include "io/database_file.hpp"
#include "io/fragility_file.hpp"
#include "study/build_catalogue.hpp"
#include "study/catalogue_rows.hpp"
#include "study/export_parts.hpp"

namespace freestand::study {
namespace {

namespace fs = std::filesystem;
using database::Database;
using export_parts::put_files;
using export_parts::ready_model;
using export_parts::ReadyModel;
using export_parts::usual_id;

// The intensity that is meant, by its text in the database; the others go with it.
void choose_intensity(const Database& db, const ExportRequest& request, DatabaseExport& done) {
  for (const database::Word& word : db.intensities) done.other_ims.push_back(word.name);
  if (done.other_ims.empty())
    throw Error(request.folder.string() + " holds no curve: run the catalogue again", Exit::data);
  done.im = request.im.empty() ? done.other_ims.front() : request.im;
  const auto at = std::find(done.other_ims.begin(), done.other_ims.end(), done.im);
  if (at == done.other_ims.end())
    throw Error(
        fmt::format("intensity {} is not in the database (it has {}): name one of these, or add it to `intensities` of "
                    "the catalogue and run that again",
                    shown(done.im), fmt::join(done.other_ims, ", ")));
  done.other_ims.erase(at);
}

// Where the fit of an entry over that intensity lies: over its first one in its own folder.
fs::path fit_folder(const fs::path& folder, const Database& db, std::size_t entry, const std::string& im) {
  const fs::path own = entry_folder(folder, db.entries[entry].id);
  const auto first =
      std::find_if(db.curves.begin(), db.curves.end(), [&](const auto& curve) { return curve.entry == entry; });
  return first != db.curves.end() && first->im == im ? own : intensity_folder(own, im);
}

// To the bit; what is not known is the same as itself.
bool same_curve(const database::Curve& a, const database::Curve& b) {
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  using Point = database::Point;
  return a.demand == b.demand && same(a.capacity, b.capacity) && same(a.median, b.median) &&
         same(a.dispersion, b.dispersion) &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                    [&](const Point& p, const Point& q) {
                      return same(p.im, q.im) && same(p.probability, q.probability) && same(p.lower, q.lower) &&
                             same(p.upper, q.upper);
                    });
}

ExportRequest request_of(const ExportRequest& request, const Database& db, std::size_t entry, const std::string& im) {
  ExportRequest one = request;
  one.im.clear();
  one.what.straight = true;
  one.folder = fit_folder(request.folder, db, entry, im);
  if (!fs::exists(one.folder / "fragility.h5"))
    throw Error(
        fmt::format("it has no curves over {} (the catalogue did not ask for them): run the catalogue with it", im));
  const std::vector<database::Curve> found =
      curves_of(io::read_fragility(one.folder / "fragility.h5").result, entry, im);
  for (const database::Curve& curve : db.curves)
    if (curve.entry == entry && curve.im == im &&
        std::none_of(found.begin(), found.end(), [&](const auto& other) { return same_curve(curve, other); }))
      throw Error(fmt::format(
          "{0} holds another fit than the database ({1} over {2} differs): freestand fit {0} gives it back; "
          "and give fits of your own another folder (-o)",
          one.folder.string(), curve.demand, im));
  return one;
}

// Limit states that one list of names is to hold: those of every entry, in the order in which they are met.
// `left_out`: what each of them tells of what it leaves out.
std::vector<std::string> states_of_all(const std::vector<ExportRequest>& requests, const exports::Format& format,
                                       std::vector<std::vector<std::string>>& left_out) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < requests.size(); ++i) try {
      const exports::Model model = ready_model(requests[i], format).model;
      for (const std::string& note : model.notes)
        if (note.starts_with("left out:")) left_out[i].push_back(note);
      for (const exports::LimitState& state : model.states) {
        const std::string word =
            std::isnan(state.capacity) ? state.demand : fmt::format("{}:{}", state.demand, state.capacity);
        if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
      }
    } catch (const Error&) {  // told when it is exported
    }
  // What happens or not is last, as in each of them.
  std::stable_partition(words.begin(), words.end(),
                        [](const std::string& w) { return w.find(':') != std::string::npos; });
  return words;
}

void export_each(const ExportRequest& request, const exports::Format& format, const Database& db,
                 DatabaseExport& done) {
  if (export_parts::names_a_file(request.output))
    throw Error(
        fmt::format("{} cannot hold the entries of a database (each is a file of its own): name a folder, as {}",
                    request.output.string(), request.output.stem().string()));
  for (std::size_t e = 0; e < db.entries.size(); ++e) try {
      ExportRequest one = request_of(request, db, e, done.im);
      const std::string& id = db.entries[e].id;
      one.output = request.output / id;
      if (!format.folder) one.output += fs::path(format.file).extension();
      if (one.what.id.empty()) one.what.id = usual_id(id);
      done.entries.emplace_back(id, export_fragility(one));
    } catch (const Error& error) {
      done.refused.push_back({db.entries[e].id, fmt::format("{}: {}", db.entries[e].id, error.what())});
    }
}

void export_all(const ExportRequest& request, const exports::Format& format, const Database& db, DatabaseExport& done) {
  std::vector<ExportRequest> requests;
  std::vector<std::string> ids;
  for (std::size_t e = 0; e < db.entries.size(); ++e) try {
      requests.push_back(request_of(request, db, e, done.im));
      ids.push_back(db.entries[e].id);
      requests.back().what.id = format.name == "pelicun" ? usual_id(ids.back()) : ids.back();
    } catch (const Error& error) {
      done.refused.push_back({db.entries[e].id, fmt::format("{}: {}", db.entries[e].id, error.what())});
    }
  std::vector<std::vector<std::string>> left_out(requests.size());
  if (format.one_list_of_states && request.what.states.empty()) {
    const std::vector<std::string> states = states_of_all(requests, format, left_out);
    for (ExportRequest& one : requests) one.what.states = states;
  }
  exports::Collection all{request.what.id.empty() ? usual_id(db.name) : request.what.id,
                          fmt::format("{}, revision {}, over {}", db.name, db.revision, done.im),
                          {}};
  nlohmann::ordered_json origin{{"results", request.folder.filename().string()},
                                {"confidence_of_bands", db.confidence},
                                {"entries", nlohmann::ordered_json::object()}};
  for (std::size_t i = 0; i < requests.size(); ++i) try {
      ReadyModel one = ready_model(requests[i], format);
      const auto same =
          std::find_if(all.models.begin(), all.models.end(), [&](const auto& m) { return m.id == one.model.id; });
      if (same != all.models.end())
        throw Error(
            fmt::format("its id would be {}, as that of another entry: add --each for a file of each", one.model.id));
      origin["entries"][ids[i]] = one.origin;
      for (const std::string& note : left_out[i]) {
        const bool taken = std::any_of(one.model.states.begin(), one.model.states.end(),
                                       [&](const auto& state) { return note.find(state.name) != std::string::npos; });
        if (!taken) one.model.notes.push_back(note);
      }
      ExportSummary summary;
      summary.model = one.model;
      done.entries.emplace_back(ids[i], std::move(summary));
      all.models.push_back(std::move(one.model));
    } catch (const Error& error) {
      done.refused.push_back({ids[i], fmt::format("{}: {}", ids[i], error.what())});
    }
  if (all.models.empty()) return;
  const export_parts::ExportPlace to = export_parts::place(request, format);
  const exports::Certified certified = put_files(
      request, format, to, format.write_all(all, to.name), origin,
      [&](const fs::path& file) { return exports::certify(all, format, file); }, done.files);
  for (auto& [id, summary] : done.entries) {
    summary.files = done.files;
    summary.difference = certified.difference;
    summary.rounding = certified.json["rounding"];
  }
}

}  // namespace

bool is_database(const fs::path& folder) { return fs::exists(folder / io::database_name); }

DatabaseExport export_database(const ExportRequest& request) {
  const exports::Format& format = exports::find(request.format);
  const Database db = io::read_database(request.folder / io::database_name);
  DatabaseExport done;
  done.output = request.output;
  done.format = request.format;
  choose_intensity(db, request, done);
  if (format.write_all && !request.each)
    export_all(request, format, db, done);
  else
    export_each(request, format, db, done);
  return done;
}

std::vector<DatabaseExport> export_beside(const fs::path& database, const std::vector<std::string>& formats) {
  std::vector<DatabaseExport> all;
  const Database db = io::read_database(database / io::database_name);
  for (const std::string& format : formats)
    for (const database::Word& im : db.intensities) {
      ExportRequest request;
      request.folder = database;
      request.output = database / "exports" / format;
      request.format = format;
      if (db.intensities.size() > 1) request.output = intensity_folder(request.output, im.name);
      remove_asides(request.output);
      make_folder(request.output);  // the dot in record.pga_g is no file's ending
      request.overwrite = true;
      request.im = im.name;
      all.push_back(export_database(request));
    }
  return all;
}

}  // namespace freestand::study
