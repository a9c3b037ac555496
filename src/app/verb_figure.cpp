#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/figure.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/say.hpp"
#include "app/settings.hpp"
#include "app/verbs.hpp"
#include "common/error.hpp"

namespace chute::app {
namespace {

struct FigureArguments {
  std::vector<std::string> figures;
  std::string directory = "out/figures";
  bool quick = false, list = false, keys = false, check = false, quiet = false, referee = false;
  int jobs = 1;
  std::vector<std::string> settings;
};

void run(const FigureArguments& arguments) {
  if (arguments.list) {
    for (const auto& figure : known_figures()) fmt::print("{:<12} {}\n", figure.id, figure.title);
    fmt::print("\ngroups:\n");
    for (const auto& group : figure_groups()) fmt::print("{:<12} {}\n", group.word, group.meaning);
    return;
  }
  if (arguments.keys) return fmt::print("{}", figure_keys());
  if (arguments.figures.empty())
    throw InputError("figure: name a figure, a recipe file, or a group such as all; --list shows them");
  std::vector<std::filesystem::path> recipes;
  for (const auto& name : arguments.figures) {
    const auto more = find_recipes(name);
    recipes.insert(recipes.end(), more.begin(), more.end());
  }
  figures::FigureContext context;
  context.quick = arguments.quick;
  context.jobs = arguments.jobs;
  context.set = arguments.settings;
  if (arguments.check) {
    for (const auto& recipe : recipes)
      fmt::print("{}: {}\n", recipe.string(), check_figure(recipe, arguments.directory, context));
    return;
  }
  watch_for_interrupt();
  std::size_t found = 0;
  for (const auto& recipe : recipes) {
    const auto id = recipe.stem().string();
    Progress progress(id, arguments.quiet);
    const auto findings = make_figure(recipe, arguments.directory, context, [&](double part) {
      progress.show(part);
      return !interrupted();
    });
    if (!arguments.quiet) tell("{}: {}/{}.png, .pdf, .svg, .csv\n", id, arguments.directory, id);
    if (!arguments.referee) continue;
    for (const auto& finding : findings) fmt::print("{}: {}\n", id, finding);
    found += findings.size();
  }
  if (found > 0) throw WorkError(fmt::format("a referee finds {} fault{}", found, found > 1 ? "s" : ""));
}

}  // namespace

void add_figure(CLI::App& app) {
  auto* verb =
      app.add_subcommand("figure", "Make figures: simulate what they need, write PNG, PDF, SVG and CSV");
  auto a = std::make_shared<FigureArguments>();
  verb->add_option(
      "figures", a->figures,
      "ids such as fig-4-10, recipe files (TOML), groups (all, thesis, experiments, methods, beyond), "
      "or - for a recipe on standard input");
  verb->add_option("-o,--output", a->directory, "folder for the results")->capture_default_str();
  verb->add_flag("--quick", a->quick, "a cheaper simulation: shorter, fewer points");
  verb->add_flag("--list", a->list, "list the figures that are known");
  verb->add_flag("--keys", a->keys, "print every key that a recipe can have, with what it means");
  verb->add_flag("--check", a->check,
                 "say whether the recipes are right and what they would take; write nothing");
  add_settings(
      *verb, "--set", "KEY=VALUE", a->settings,
      "change a key of every scene that is simulated, on top of what the recipe sets: half the step, another friction");
  verb->add_option("--jobs", a->jobs, "simulations side by side; results do not depend on it")
      ->check(CLI::Range(1, 1024));
  verb->add_flag(
      "--referee", a->referee,
      "read the finished pictures as a referee would: points lost or on the frame, texts that overlap, series "
      "that only colour tells apart, panels without parameters; status 1 if there are such");
  verb->add_flag("--quiet", a->quiet, "no progress line");
  verb->footer("Example: chute figure fig-4-10 fig-5-01 --quick -o out/figures");
  verb->callback([a] { run(*a); });
}

}  // namespace chute::app
