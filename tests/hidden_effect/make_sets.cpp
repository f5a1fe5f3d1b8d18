// make_sets -o DIR [--seeds 5] [--first 1] [--effects a,b,c+d] [--tests 10] [--duration 20] [--rate 200] [--unpicked] [--weak] [--fault drift]:
// measurement sets DIR/<effect>-<seed>/, and what is hidden in them in DIR/answers.json. make_sets --list: what is hidden by default.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "hidden_effect/default_effects.hpp"
#include "hidden_effect/laboratory.hpp"
#include "hidden_effect/make_set.hpp"

namespace freestand::test {
namespace {

struct Options {
  std::filesystem::path folder;
  std::vector<std::string> effects = default_effects();
  std::uint64_t seeds = 5, first = 1;
  int tests = 10;
  double duration_s = 20, rate_hz = 200;
  bool list = false, unpicked = false, weak = false;
  std::string fault;
};

nlohmann::ordered_json known_answers(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return stream ? nlohmann::ordered_json::parse(stream) : nlohmann::ordered_json::object();
}

void make(const Options& options) {
  std::filesystem::create_directories(options.folder);
  const std::filesystem::path file = options.folder / "answers.json";
  nlohmann::ordered_json answers = known_answers(file);
  for (std::uint64_t seed = options.first; seed < options.first + options.seeds; ++seed)
    for (const std::string& effects : options.effects) {
      SetRequest request{split_effects(effects), seed, options.tests, options.duration_s};
      request.unpicked = options.unpicked;
      request.weak = options.weak;
      request.rate_hz = options.rate_hz;
      request.fault = options.fault;
      const MadeSet set = make_set(request);
      write_set(set, options.folder / set.name);
      answers[set.name] = answer_of(set);
      std::ofstream(file) << answers.dump(1) << '\n';
      fmt::print("{:<40} plain model {:8.2f} noise units, weakest effect {:8.2f}\n", set.name, set.plain_error,
                 set.weakest_error);
      std::fflush(stdout);
    }
}

}  // namespace
}  // namespace freestand::test

int main(int count, char** words) {
  freestand::test::Options options;
  CLI::App parser("measurement sets with hidden effects");
  parser.add_option("-o,--output", options.folder, "folder of the sets");
  parser.add_flag("--list", options.list, "names of what can be hidden, and nothing made");
  parser.add_option("--effects", options.effects, "a,b,c+d: none, an effect, or several at once")->delimiter(',');
  parser.add_option("--seeds", options.seeds, "sets of each");
  parser.add_option("--first", options.first, "first seed");
  parser.add_option("--tests", options.tests, "tests of a set")->check(CLI::Range(2, 99));
  parser.add_option("--duration", options.duration_s, "mean length of a stochastic motion [s]");
  parser.add_flag("--weak", options.weak, "effects that make 1 to 6 noise units");
  parser.add_option("--rate", options.rate_hz, "readings of the sensors [Hz]")
      ->check(CLI::IsMember({50.0, 100.0, 200.0, 400.0, 1000.0, 2000.0}));
  parser.add_flag("--unpicked", options.unpicked, "floors as they come, down to such as do not move the specimen");
  parser.add_option("--fault", options.fault, "of the laboratory that measures")
      ->check(CLI::IsMember(freestand::test::laboratory_faults()));
  CLI11_PARSE(parser, count, words);
  if (options.list) {
    for (const std::string& effects : freestand::test::default_effects()) fmt::print("{}\n", effects);
    return 0;
  }
  if (options.folder.empty()) {
    fmt::print(stderr, "no folder (the sets need a place): give -o DIR\n");
    return 2;
  }
  try {
    freestand::test::make(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
