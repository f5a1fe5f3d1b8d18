// Formats that others load: ONE FILE PER FORMAT in this folder, NAME.cpp, and one check of it, check_NAME.cpp. A format
// declares itself once:
//
//   const Register here{{.name = "openquake", .summary = "...", .form = ..., .write = ...}};
//
// and its check, which shares nothing with the writer, reads the written files back and evaluates the target's own
// formula:
//
//   const RegisterCheck here{{.name = "openquake", .open = ...}};
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "exports/model.hpp"

namespace freestand::exports {

// A file to be written: its name in the output folder, and its text.
struct File {
  std::string name, text;
};

// Many models over one intensity that go into one file.
struct Collection {
  std::string id, description;
  std::vector<Model> models;
};

struct Format {
  std::string name;         // of --format
  std::string summary;      // one line
  std::string file;         // usual name of its one file, such as fragility.xml; several: of the first
  bool folder = false;      // several files that belong together: -o must name a folder
  std::vector<Form> forms;  // that the target can hold, best first
  bool table = false;  // holds results as they are: nothing is pooled, limit states may cross, any intensity will do
  bool one_list_of_states = false;  // files of many have the same limit states for all
  bool last_only = false;           // holds the most severe limit state alone
  bool fixed_number = false;        // takes so many limit states and no fewer: those that never happened stay
  bool bands = false;               // its files hold the bands of the probabilities too, not the best estimate alone
  std::string note = {};            // a plain sentence that goes with every file of it
  // Plain sentences on what it makes of these curves.
  std::vector<std::string> (*notes_on)(const Model&) = nullptr;
  std::string usual_category = {};  // what stands for --asset-category where nothing was said
  // Refuses, with an Error, what the target cannot express.
  void (*refuse)(const Model&) = nullptr;
  // The files; the first is named `name`.
  std::vector<File> (*write)(const Model&, const std::string& name) = nullptr;
  // The same of many models in files that hold them all, each under its id; none: each is a file of its own.
  std::vector<File> (*write_all)(const Collection&, const std::string& name) = nullptr;
};

// A written file as its target reads it: limit states by name, and what it makes of an intensity in freestand's unit.
struct ReadBack {
  std::vector<std::string> states;  // empty: the file does not name them
  std::function<double(std::size_t state, double im)> probability;
  std::string unit;      // of the intensity in the file
  std::string rounding;  // what the target rounds; "" nothing
  double rounds_by = 0;  // bound on what that does to a probability
};

struct Check {
  std::string name;
  // Reads the files from their folder; throws Error (Exit::data) where they break a rule of the target.
  ReadBack (*open)(const std::filesystem::path& file, const Intensity& im) = nullptr;
  // That of one id, of files that hold many; none where the format has no such files.
  ReadBack (*open_one)(const std::filesystem::path& file, const Intensity& im, const std::string& id) = nullptr;
};

const std::vector<Format>& all();
const Format& find(const std::string& name);       // throws Error that lists the names there are
const Check& check_of(const std::string& format);  // throws where there is none: a format without a check is no format

struct Register {
  explicit Register(Format format);
};
struct RegisterCheck {
  explicit RegisterCheck(Check check);
};

}  // namespace freestand::exports
