// What exports of one sweep and of a whole database share.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "exports/certificate.hpp"
#include "study/export.hpp"

namespace freestand::study::export_parts {

// A model that the format takes, and where its numbers are from.
struct ReadyModel {
  exports::Model model;
  nlohmann::ordered_json origin;
};
ReadyModel ready_model(const ExportRequest&, const exports::Format&);

struct ExportPlace {
  std::filesystem::path folder;
  std::string name;  // of the first file
};
// By its ending, and by what is there; that of sa_g_0.5 is the period of an intensity.
bool names_a_file(const std::filesystem::path& output);
ExportPlace place(const ExportRequest&, const exports::Format&);

// Letters and digits in place of all else, so that any target takes it.
std::string usual_id(const std::string& study_name);

// Writes the files and the certificate beside them, adding their paths to `written`. Throws Error where one would be replaced, or where the
// target would read other probabilities.
using Certify = std::function<exports::Certified(const std::filesystem::path&)>;
exports::Certified put_files(const ExportRequest&, const exports::Format&, const ExportPlace&,
                             const std::vector<exports::File>&, const nlohmann::ordered_json& origin, const Certify&,
                             std::vector<std::filesystem::path>& written);

}  // namespace freestand::study::export_parts
