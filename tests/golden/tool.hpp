#pragma once
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "common/error.hpp"

namespace chute::golden {

/// A command of its own: reads the command line, does `work`, tells what went wrong in one line. Exit status
/// as chute's: 0 done, 1 the work failed, 2 the command or a file is wrong.
template <class Work>
int run_tool(CLI::App& app, int argc, char** argv, Work work) {
  try {
    app.parse(argc, argv);
    work();
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

}  // namespace chute::golden
