#include <fmt/format.h>

#include <cmath>
#include <freestand/error.hpp>

#include "base/durable_file.hpp"
#include "base/folder.hpp"
#include "exports/certificate.hpp"
#include "exports/exporter.hpp"
#include "io/database_file.hpp"
#include "io/fragility_file.hpp"
#include "io/own_files.hpp"
#include "io/text_files.hpp"
#include "io/written_files.hpp"
#include "study/export_parts.hpp"
#include "study/study.hpp"
#include "study/target.hpp"

namespace freestand::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* certificate_name = "certificate.json";

// mu_k of the study where all samples have the same.
std::optional<double> one_mu(const Study& study) {
  const FrictionPart& friction = study.model.friction;
  const std::optional<Quantity>& mu = friction.mu ? friction.mu : friction.mu_k;
  if (!mu || !sampling::is_fixed(mu->value)) return {};
  return sampling::quantile(mu->value, 0.5);
}

// The report's intensity fits no target. At one mu it is PTA in other words.
fragility::Result convertible(fragility::Result result, const Study& study, const ExportRequest& request,
                              const exports::Format& format) {
  if (result.im_name != "report") {
    if (request.mu)
      throw Error(fmt::format(
          "--mu converts the intensity of the report only (these results are over {}): leave it out", result.im_name));
    return result;
  }
  const std::optional<double> mu = one_mu(study);
  if (!request.mu && format.table) return result;
  const std::string again =
      fmt::format("fit {} over another intensity, as pga_g, and export that", request.folder.string());
  if (!request.mu)
    throw Error(fmt::format(
        "the intensity of the report, PTA/(mu g) - 1, is known to no target (it takes the friction of the "
        "block, and can be negative): {}{}",
        mu ? fmt::format("add --mu {}, the one of all samples, which turns it into PTA; or ", *mu) : "", again));
  if (!mu)
    throw Error(
        fmt::format("--mu {} cannot turn the intensity of the report into PTA (the samples have many mu, and each "
                    "has its own PTA): {}",
                    *request.mu, again));
  if (std::fabs(*mu - *request.mu) > 1e-12)
    throw Error(fmt::format("--mu {} is not the mu of the samples (it is {}): add --mu {}", *request.mu, *mu, *mu));
  return exports::as_pta(std::move(result), *mu);
}

exports::Intensity intensity_of(const fragility::Result& result, const Study& study, const ExportRequest& request) {
  if (!request.period_s)
    return {result.im_name, result.im_unit, result.im_period_s.value_or(exports::unknown),
            is_of_a_floor(result.im_name, study)};
  if (result.im_name != "record.sa_g")
    throw Error(fmt::format(
        "--period {} is not for these results (they are over {}{}; it says that of record.sa_g): leave it out",
        *request.period_s, result.im_name, result.im_period_s ? fmt::format(" at {} s", *result.im_period_s) : ""));
  if (!(*request.period_s > 0) || !std::isfinite(*request.period_s))
    throw Error(fmt::format("--period {} is no period (it is above zero): give it in s", *request.period_s));
  return {result.im_name, result.im_unit, *request.period_s};
}

}  // namespace

namespace export_parts {

std::string usual_id(const std::string& study_name) {
  std::string id;
  for (const char c : study_name.empty() ? "freestand" : study_name)
    id += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return id.substr(0, 60);
}

}  // namespace export_parts

namespace {

std::string usual_description(const io::Provenance& from, const fragility::Result& result) {
  return fmt::format("{}: {} samples, {} groups of motions, over {}; freestand {}", from.study_name, result.samples,
                     result.motions, result.im_name, from.version);
}

}  // namespace

namespace export_parts {

bool names_a_file(const fs::path& output) {
  const std::string ending = output.extension().string();
  return !fs::is_directory(output) && ending.find_first_not_of(".0123456789") != std::string::npos;
}

ExportPlace place(const ExportRequest& request, const exports::Format& format) {
  if (!names_a_file(request.output)) return {request.output, format.file};
  if (format.folder)
    throw Error(fmt::format("{} cannot hold what {} wants (several files that belong together): name a folder, as {}",
                            request.output.string(), format.name, request.output.stem().string()));
  if (request.output.extension() != fs::path(format.file).extension())
    throw Error(fmt::format("{} has another ending than a file for {} ({}): name {}, or a folder",
                            request.output.string(), format.name, fs::path(format.file).extension().string(),
                            fs::path(request.output).replace_extension(fs::path(format.file).extension()).string()));
  return {request.output.parent_path(), request.output.filename().string()};
}

}  // namespace export_parts

namespace {

// What stands in the folder's certificate by now.
Json certificate_in(const fs::path& folder) {
  const fs::path file = folder / certificate_name;
  if (!fs::exists(file)) return {{"format", exports::certificate_format}, {"files", Json::object()}};
  const Json found = io::is_own(file) ? Json::parse(read_whole(file), nullptr, false) : Json();
  if (!found.is_object() || found.value("format", "") != exports::certificate_format || !found["files"].is_object())
    throw Error(fmt::format("{} would be replaced (freestand did not write it): name another folder", file.string()));
  return found;
}

// A file that is there is replaced only if that was asked for, and only if it is as the certificate has it.
void refuse_to_replace(const fs::path& file, const Json& certificate, bool overwrite) {
  if (!fs::exists(file)) return;
  if (!overwrite)
    throw Error(
        fmt::format("{} is there already (it would be replaced): name another one, or add --overwrite", file.string()));
  const Json& known = certificate["files"];
  const std::string name = file.filename().string();
  if (!known.contains(name) || known[name].value("hash", "") != io::hash_text(read_whole(file)))
    throw Error(fmt::format("{} would be replaced (freestand did not write it, or it was changed since): move it away",
                            file.string()));
}

Json origin(const ExportRequest& request, const io::Provenance& from, double confidence) {
  return {{"results", request.folder.filename().string()},
          {"confidence_of_bands", confidence},
          {"study", from.study_name},
          {"seed", from.seed},
          {"samples", from.samples},
          {"version", from.version},
          {"git_commit", from.git_commit},
          {"created_utc", from.created_utc}};
}

}  // namespace

namespace export_parts {

ReadyModel ready_model(const ExportRequest& request, const exports::Format& format) {
  const fs::path source = request.folder / "fragility.h5";
  const auto [from, found] = io::read_fragility(source);
  const Study study = parse_stored(from.study, source);
  const fragility::Result result = convertible(found, study, request, format);
  exports::Request what = request.what;
  if (what.id.empty()) what.id = usual_id(from.study_name);
  if (what.description.empty()) what.description = usual_description(from, result);
  ReadyModel found_model{exports::select(result, intensity_of(result, study, request), what, format), {}};
  exports::Model& model = found_model.model;
  if (const std::string target = target_told(study); !target.empty()) model.notes.push_back(target);
  if (request.mu) model.notes.push_back(fmt::format("PTA = {} g (1 + IM) of the report", *request.mu));
  if (format.refuse) format.refuse(model);
  found_model.origin = origin(request, from, result.confidence);
  return found_model;
}

exports::Certified put_files(const ExportRequest& request, const exports::Format& format, const ExportPlace& to,
                             const std::vector<exports::File>& files, const Json& origin, const Certify& certify,
                             std::vector<fs::path>& written) {
  Json certificate = certificate_in(to.folder);
  for (const exports::File& file : files) refuse_to_replace(to.folder / file.name, certificate, request.overwrite);
  if (!to.folder.empty()) make_folder(to.folder);
  for (const exports::File& file : files) {
    write_durably(to.folder / file.name, file.text);
    written.push_back(to.folder / file.name);
  }
  exports::Certified certified = certify(written.front());
  if (certified.difference > certified.allowed) {
    for (const fs::path& file : written) fs::remove(file);
    throw Error(
        fmt::format("{} would be read with probabilities that are off by {:.3g} (more than {:.3g}, which is a fault of "
                    "freestand): tell its makers; nothing was exported",
                    written.front().string(), certified.difference, certified.allowed),
        Exit::data);
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    Json entry = i == 0 ? certified.json : Json{{"target", format.name}, {"belongs_to", files.front().name}};
    entry["from"] = origin;
    entry["hash"] = io::hash_text(files[i].text);
    certificate["files"][files[i].name] = entry;
  }
  write_durably(to.folder / certificate_name, io::json_text(certificate));
  written.push_back(to.folder / certificate_name);
  return certified;
}

}  // namespace export_parts

ExportSummary export_fragility(const ExportRequest& request) {
  using namespace export_parts;
  const exports::Format& format = exports::find(request.format);
  if (!request.im.empty())
    throw Error(fmt::format(
        "--im {0} is for a database ({1} is one sweep, over one intensity): fit it over that one (freestand "
        "fit {1} --im {0} -o FOLDER), and export FOLDER",
        request.im, request.folder.string()));
  const ReadyModel from = ready_model(request, format);
  const ExportPlace to = place(request, format);
  ExportSummary summary;
  summary.model = from.model;
  const exports::Certified certified = put_files(
      request, format, to, format.write(from.model, to.name), from.origin,
      [&](const fs::path& file) { return exports::certify(from.model, format, file); }, summary.files);
  summary.difference = certified.difference;
  summary.rounding = certified.json["rounding"];
  return summary;
}

}  // namespace freestand::study
