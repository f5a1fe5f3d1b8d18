#include "database/query.hpp"

#include <fmt/format.h>

#include <memory>

#include "app/checks.hpp"
#include "app/command.hpp"
#include "app/query_words.hpp"
#include "base/folder.hpp"
#include "io/database_file.hpp"

namespace freestand::app {
namespace {

struct QueryOptions {
  std::string database, id, equipment, floor, friction, im, demand;
  double mu = database::unknown, height_m = database::unknown, width_m = database::unknown;
  double capacity = database::unknown;
  bool curve = false, json = false;
};

std::optional<std::string> given(const std::string& text) { return text.empty() ? std::nullopt : std::optional(text); }
std::optional<double> given(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }

// "pga_g=0.4": name and value; a name alone asks for the curve.
void read_intensity(const QueryOptions& options, database::Question& question) {
  const std::size_t equals = options.im.find('=');
  question.im = options.im.substr(0, equals);
  if (equals == std::string::npos) return;
  const std::string text = options.im.substr(equals + 1);
  std::size_t used = 0;
  try {
    question.im_value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(question.im_value))
    throw Error(fmt::format("--im {} is no intensity with a value (a number stands behind =): write --im {}=0.4",
                            options.im, question.im));
}

database::Question question_of(const QueryOptions& options) {
  database::Question question;
  question.id = given(options.id);
  question.equipment = given(options.equipment);
  question.floor = given(options.floor);
  question.friction = given(options.friction);
  question.wanted[static_cast<std::size_t>(database::Coordinate::mu)] = given(options.mu);
  question.wanted[static_cast<std::size_t>(database::Coordinate::height_m)] = given(options.height_m);
  question.wanted[static_cast<std::size_t>(database::Coordinate::width_m)] = given(options.width_m);
  question.demand = options.demand;
  question.capacity = options.capacity;
  read_intensity(options, question);
  return question;
}

void tell(const QueryOptions& options) {
  std::filesystem::path file = options.database;
  if (is_folder(file)) file /= io::database_name;
  if (!is_there(file))
    throw Error(fmt::format("{} holds no database (there is no such file): name what `freestand catalogue` has made",
                            file.string()),
                Exit::data);
  const database::Database db = io::read_database(file);
  database::Question question = question_of(options);
  if (options.im.empty() && options.demand.empty()) {
    if (options.curve || given(options.capacity) || given(options.mu) || given(options.height_m) ||
        given(options.width_m))
      throw Error(
          "--im and --demand are missing (a probability is that of a demand at an intensity): add for example " +
          example(db, options.database));
    const database::Database part = part_of(db, picked(db, question));
    fmt::print("{}", options.json ? contents_json(part) : contents(part, options.database));
    return;
  }
  if (options.curve) question.im_value = database::unknown;
  const std::vector<database::Answer> answers = ask(db, question);
  fmt::print("{}", options.json ? answers_json(db, question, answers) : answers_text(db, question, answers));
}

}  // namespace

void add_query(CLI::App& parser, Work& work) {
  auto options = std::make_shared<QueryOptions>();
  CLI::App* verb = parser.add_subcommand("query", "what a database holds; probabilities and curves out of it");
  verb->add_option("database", options->database, "folder of a database, or its HDF5 file")->required();
  verb->add_option("--class", options->equipment, "class of equipment");
  verb->add_option("--id", options->id, "one entry");
  verb->add_option("--floor", options->floor, "floor, as the catalogue names it");
  verb->add_option("--friction", options->friction, "friction, as the catalogue names it");
  verb->add_option("--mu", options->mu, "kinetic friction, interpolated between entries")
      ->check(above_zero("friction"));
  verb->add_option("--height", options->height_m, "height in m, interpolated between entries")
      ->check(above_zero("height"));
  verb->add_option("--width", options->width_m, "width in m, interpolated between entries")->check(above_zero("width"));
  verb->add_option("--im", options->im, "intensity: pga_g=0.4; pga_g for the whole curve");
  verb->add_option("--demand", options->demand, "demand: peak_slip_m");
  verb->add_option("--capacity", options->capacity, "what the demand goes beyond, in its unit");
  verb->add_flag("--curve", options->curve, "the curve over the intensity");
  verb->add_flag("--json", options->json, "for programs");
  verb->callback([options, &work] {
    work = [options](const Context& context) {
      context.world.on_root([&] { tell(*options); });
      return Exit::done;
    };
  });
}

}  // namespace freestand::app
