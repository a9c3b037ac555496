#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace chute::app {

/// An option such as --set KEY=VALUE, which is given once for every key: what comes behind a value is another argument, so that
/// a scene's name may stand there.
void add_settings(CLI::App& verb, const char* option, const char* shape, std::vector<std::string>& into,
                  const std::string& what);

/// Of a command line that was not understood: a KEY=VALUE that stands behind another one, without an option of its own.
/// Empty if there is none.
std::string stray_setting(int argc, const char* const* argv);

}  // namespace chute::app
