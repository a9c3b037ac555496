#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "app/manual.hpp"
#include "app/say.hpp"
#include "app/settings.hpp"
#include "app/verbs.hpp"
#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "read/vtk_process.hpp"
#include "run/version.hpp"

namespace chute::app {
namespace {
std::string given;  // set once, in main
}
const std::string& command_line() { return given; }
}  // namespace chute::app

namespace {

/// Exit status of the program, see README: 0 done, 1 the work failed, 2 the command or a given file is wrong.
enum Status { done = 0, failed = 1, wrong = 2 };

/// Says what was wrong: several slips of one file are several lines.
int end(Status status, std::string_view what) {
  for (;;) {
    const auto line = what.substr(0, what.find('\n'));
    chute::app::tell("chute: {}\n", line);
    if (line.size() == what.size()) return status;
    what.remove_prefix(line.size() + 1);
  }
}

/// CLI11 would only say that a verb is required.
void check_verb(CLI::App& app, const std::string& word) {
  std::vector<std::string> verbs;
  for (const auto* verb : app.get_subcommands([](CLI::App*) { return true; }))
    verbs.push_back(verb->get_name());
  if (word.starts_with('-') || std::ranges::count(verbs, word) > 0) return;
  const auto hint = chute::nearest(word, verbs);
  throw chute::InputError(fmt::format("{}: no such verb{}; chute --help lists them", word,
                                      hint.empty() ? "" : ", did you mean " + hint + "?"));
}

}  // namespace

int main(int argc, char** argv) {
  using namespace chute;
  if (read::serve_vtk_files(argc, argv)) return done;
  app::keep_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error that is told, as a full disk is
  std::signal(SIGPIPE, SIG_IGN);  // a process that stops reading, too
  CLI::App app{"chute simulates grains on a rough incline and draws what they do, without a screen."};
  app.name("chute");
  app.set_version_flag("--version", fmt::format("chute {} ({})", run::version, run::commit));
  app.require_subcommand(1);
  app.footer("Every verb has --help with an example. README.md is the manual.");
  for (int i = 0; i < argc; ++i) app::given += fmt::format("{}{}", i ? " " : "", i ? argv[i] : "chute");
  app::add_run(app);
  app::add_check(app);
  app::add_info(app);
  app::add_render(app);
  app::add_sweep(app);
  app::add_figure(app);
  app::add_compare(app);
  app::add_report(app);
  app::add_convert(app);
  app::add_measure(app);
  app::add_export(app);
  app::add_import(app);
  app::add_theory(app);
  app::add_manual(app);

  try {
    if (argc > 1) check_verb(app, argv[1]);
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help, --version
      app.exit(asked);
    }
    app::finish_output();
    return done;
  } catch (const CLI::ParseError& error) {
    const auto stray = app::stray_setting(argc, argv);
    return end(wrong, stray.empty() ? std::string_view(error.what()) : stray);
  } catch (const InputError& error) {
    return end(wrong, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return end(failed, error.what());
  } catch (const std::system_error& error) {  // fmt's, of standard output
    return end(failed, std::ferror(stdout)
                           ? fmt::format("standard output: cannot write: {}", error.code().message())
                           : error.what());
  } catch (const std::bad_alloc&) {
    return end(failed, "out of memory");
  } catch (const std::exception& error) {
    return end(failed, error.what());
  }
}
