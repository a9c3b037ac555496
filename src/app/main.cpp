#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "app/verbs.hpp"
#include "common/error.hpp"
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

int say(Status status, const char* what) {
  fmt::print(stderr, "chute: {}\n", what);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace chute;
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
  app::add_theory(app);

  try {
    app.parse(argc, argv);
    return done;
  } catch (const CLI::Success& asked) {  // --help, --version
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    return say(wrong, error.what());
  } catch (const InputError& error) {
    return say(wrong, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return say(failed, error.what());
  } catch (const std::bad_alloc&) {
    return say(failed, "out of memory");
  } catch (const std::exception& error) {
    return say(failed, error.what());
  }
}
