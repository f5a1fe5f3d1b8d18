#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <set>

#include "app/command.hpp"
#include "base/durable_file.hpp"
#include "base/shown_text.hpp"
#include "io/provenance.hpp"
#include "parallel/stop.hpp"
#include "study/kernel_number.hpp"

namespace {

// Tells the parser's problem, or its help, once for all ranks.
int tell(const CLI::App& parser, const std::string& verb, const CLI::ParseError& error,
         const freestand::parallel::Communicator& world) {
  const bool is_help = error.get_exit_code() == 0;
  if (world.is_root() && !is_help && !verb.empty() && verb[0] != '-') {
    const auto verbs = parser.get_subcommands([](const CLI::App*) { return true; });
    std::string known;
    for (const CLI::App* one : verbs) {
      if (one->get_name() == verb) known.clear();
      if (one->get_name() == verb) break;
      known += (known.empty() ? "" : ", ") + one->get_name();
    }
    if (!known.empty()) {
      fmt::print(stderr, "{} is no command (freestand has {}): choose one, or see freestand --help\n",
                 freestand::shown(verb), known);
      return static_cast<int>(freestand::Exit::usage);
    }
  }
  if (world.is_root()) parser.exit(error);
  return static_cast<int>(is_help ? freestand::Exit::done : freestand::Exit::usage);
}

}  // namespace

namespace {

// Of these what they print is all that they make; of the others it is a log, and one that cannot be written ends no run.
bool prints_its_answer(const CLI::App& verb) {
  static const std::set<std::string> names = {"effects", "im", "edp", "query", "motion"};
  const CLI::Option* check = verb.get_option_no_throw("--check");
  return names.contains(verb.get_name()) || (check && check->count() > 0);
}

// Its answer may not have come to the file. A reader that has left wants no more.
void flush_answer() {
  errno = 0;
  if ((std::fflush(stdout) == 0 && !std::ferror(stdout)) || errno == EPIPE) return;
  throw freestand::file_error("write", "what is printed", errno ? errno : EIO);
}

// What keeps nothing on its way ends at once when it is asked to stop; what does has a watch of its own.
constexpr double patience_s = 0.2;

int run(int argc, char** argv, const freestand::parallel::Communicator& world) {
  CLI::App parser("Seismic fragility databases for freestanding equipment", "freestand");
  parser.require_subcommand(1);
  parser.set_version_flag("--version", freestand::io::provenance_here("", 1).version);
  freestand::app::Work work;
  freestand::app::add_run(parser, work);
  freestand::app::add_sweep(parser, work);
  freestand::app::add_fit(parser, work);
  freestand::app::add_simulate(parser, work);
  freestand::app::add_motion(parser, work);
  freestand::app::add_effects(parser, work);
  freestand::app::add_im(parser, work);
  freestand::app::add_edp(parser, work);
  freestand::app::add_import(parser, work);
  freestand::app::add_compare(parser, work);
  freestand::app::add_diagnose(parser, work);
  freestand::app::add_add(parser, work);
  freestand::app::add_catalogue(parser, work);
  freestand::app::add_query(parser, work);
  freestand::app::add_export(parser, work);
  freestand::app::add_risk(parser, work);
  freestand::app::add_sensitivity(parser, work);
  freestand::app::add_reproduce(parser, work);
  try {
    parser.parse(argc, argv);
    freestand::study::refuse_mixed_machines(world);
    const freestand::Exit exit = work({world, freestand::io::command_line(argc, argv)});
    if (world.is_root() && prints_its_answer(*parser.get_subcommands().front())) flush_answer();
    return static_cast<int>(exit);
  } catch (const CLI::ParseError& error) {
    return tell(parser, argc > 1 ? argv[1] : "", error, world);
  } catch (const freestand::Error& error) {
    return freestand::parallel::end_run(world, error);
  } catch (const std::exception& error) {
    return freestand::parallel::end_run(world, fmt::format("unexpected: {}", error.what()), 1);
  }
}

}  // namespace

// Signals are answered before MPI starts, which may take a second or, where a rank is missing, for ever: it leaves these handlers as they
// are. Until it has started no rank knows whether it speaks for all, and none does.
int main(int argc, char** argv) {
  std::atomic<bool> speaks = false;
  const freestand::parallel::StopOnSignal stop({patience_s, [&speaks] {
                                                  if (speaks)
                                                    fmt::print(stderr,
                                                               "stopped on request (nothing is kept): start again\n");
                                                  std::_Exit(static_cast<int>(freestand::Exit::resumable));
                                                }});
  int code = 0;
  try {
    const freestand::parallel::Session session(&argc, &argv);
    speaks = session.world().is_root();
    code = run(argc, argv, session.world());
  } catch (const freestand::Error& error) {  // MPI does not start
    fmt::print(stderr, "{}\n", freestand::printable(error.what(), freestand::Lines::keep));
    code = static_cast<int>(error.exit());
  }
  freestand::parallel::request_stop();  // a request that comes while the process ends changes nothing: its work is done
  return code;
}
