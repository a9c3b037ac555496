#include <fmt/format.h>

#include <filesystem>

#include "app/verbs.hpp"
#include "common/atomic_file.hpp"
#include "common/error.hpp"

namespace chute::app {
namespace {

namespace fs = std::filesystem;

void info(const fs::path& path) {
  if (!fs::exists(path)) throw InputError(path.string() + ": no such file or run");
  if (!fs::is_directory(path)) throw InputError(path.string() + ": not a run directory");
  fmt::print("{}", read_file(path / "run.json"));
}

}  // namespace

void add_info(CLI::App& app) {
  auto* verb = app.add_subcommand("info", "Tell what a run or a file holds");
  auto path = std::make_shared<std::string>();
  verb->add_option("path", *path, "run directory, VTK file or CSV table")->required();
  verb->footer("Example: chute info out/demo");
  verb->callback([path] { info(*path); });
}

}  // namespace chute::app
