#pragma once
#include <CLI/CLI.hpp>

/// Each verb adds itself to the command line, with its options, help and an example, and does its work in a
/// callback.
namespace chute::app {

void add_run(CLI::App& app);
void add_check(CLI::App& app);
void add_info(CLI::App& app);
void add_render(CLI::App& app);
void add_sweep(CLI::App& app);
void add_figure(CLI::App& app);
void add_compare(CLI::App& app);
void add_report(CLI::App& app);
void add_convert(CLI::App& app);
void add_measure(CLI::App& app);
void add_export(CLI::App& app);
void add_import(CLI::App& app);
void add_theory(CLI::App& app);

/// The command line as it was given, for run.json and figure comments.
const std::string& command_line();

}  // namespace chute::app
