// The verbs of the command line. One file per verb: it adds its options to the parser and returns what to do.
#pragma once

#include <CLI/CLI.hpp>
#include <freestand/error.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "parallel/communicator.hpp"
#include "study/validation.hpp"

namespace freestand::app {

// What a verb needs to know of the run.
struct Context {
  parallel::Communicator world;
  std::string command_line;
};

// Adds a verb; the parser calls `done` with the work when the verb was given.
using Work = std::function<Exit(const Context&)>;
using Verb = std::function<void(CLI::App& parser, Work& work)>;

// What the verbs that hold the model against measurements share.
struct ValidationOptions {
  std::string study, measurements, output;
  bool overwrite = false, quiet = false;
  study::ValidationRun run(const Context&) const;
  std::vector<std::filesystem::path> reads() const;  // what no --overwrite may remove
};
void add_options(CLI::App& verb, ValidationOptions&, const std::string& output, const std::string& overwrite);

// Three digits, as tables show errors: "45.8", "1.00", "0.0206", "1.2e+04"; "-" for null.
std::string three_digits(const nlohmann::ordered_json& number);

void add_run(CLI::App& parser, Work& work);
void add_sweep(CLI::App& parser, Work& work);
void add_fit(CLI::App& parser, Work& work);
void add_simulate(CLI::App& parser, Work& work);
void add_motion(CLI::App& parser, Work& work);
void add_effects(CLI::App& parser, Work& work);
void add_im(CLI::App& parser, Work& work);
void add_edp(CLI::App& parser, Work& work);
void add_compare(CLI::App& parser, Work& work);
void add_diagnose(CLI::App& parser, Work& work);
void add_add(CLI::App& parser, Work& work);
void add_import(CLI::App& parser, Work& work);
void add_catalogue(CLI::App& parser, Work& work);
void add_query(CLI::App& parser, Work& work);
void add_export(CLI::App& parser, Work& work);
void add_risk(CLI::App& parser, Work& work);
void add_sensitivity(CLI::App& parser, Work& work);
void add_reproduce(CLI::App& parser, Work& work);

}  // namespace freestand::app
