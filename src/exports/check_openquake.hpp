// What the checks of both OpenQuake files share: the outer element, and intensities as OpenQuake understands them.
#pragma once

#include <filesystem>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "exports/exporter.hpp"

namespace freestand::exports::openquake_check {

// The rules that OpenQuake's reader and its schema hold files to; Error (Exit::data) that names the file and the rule.
[[noreturn]] void broken(const std::filesystem::path&, const std::string& rule);
void require(bool holds, const std::filesystem::path&, const std::string& rule);

// The document's one model of that name, under <nrml> of NRML 0.5, with id, categories and a description.
pugi::xml_node model(const pugi::xml_document&, const std::filesystem::path&, const char* name);

// Numbers separated by blanks.
std::vector<double> numbers(const char* text, const std::filesystem::path&);

// What a level of this imt is in SI (or g), for an intensity that freestand gives in SI (or g): g, cm/s, cm.
struct Unit {
  std::string text;
  double in_si;
};
Unit unit_of(const std::string& imt, const Intensity&, const std::filesystem::path&);

// numpy.interp within the levels.
double line(const std::vector<double>& x, const std::vector<double>& y, double at);

}  // namespace freestand::exports::openquake_check
