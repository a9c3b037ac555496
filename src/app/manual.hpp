#pragma once
#include <CLI/CLI.hpp>

/// What the command line's parser knows of itself, written for others than the reader of --help. Both are made
/// when the program is built, by the program, so that they cannot tell of options that it does not have.
namespace chute::app {

/// The manual page chute(1), in the language of troff's package man.
std::string manual_page(const CLI::App& app);

/// What bash sources to complete verbs, options and the ids of figures.
std::string bash_completion(const CLI::App& app);

/// Gives the command line the options that print them. They stand in no help: only the build asks for them.
void add_manual(CLI::App& app);

}  // namespace chute::app
