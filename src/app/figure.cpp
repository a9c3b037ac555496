#include "app/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "app/input.hpp"
#include "app/verbs.hpp"
#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/share_folder.hpp"
#include "common/toml_reader.hpp"
#include "experiments/computed_figures.hpp"
#include "figures/simulate.hpp"
#include "io/csv.hpp"
#include "plot/draw.hpp"
#include "plot/layout.hpp"
#include "plot/recipe.hpp"
#include "read/iso_time.hpp"
#include "read/table.hpp"
#include "run/version.hpp"
#include "theory/theory_figures.hpp"

namespace chute::app {
namespace fs = std::filesystem;
namespace {

/// Where the recipes that come with chute are: CHUTE_SCENES, or what was installed with the program.
fs::path scenes_folder() {
  const char* given = std::getenv("CHUTE_SCENES");
  return given ? fs::path(given) : share_folder() / "scenes";
}

/// A recipe file: [data] says where the numbers come from, [plot] how they look.
struct Recipe {
  std::string title;
  figures::DataRecipe data;
  plot::PlotRecipe plot;
};

}  // namespace

static void describe(TomlReader& a, Recipe& recipe) {
  a.required("title", recipe.title);
  a.required_section("data", recipe.data);
  a.section("plot", recipe.plot);
}

namespace {

Recipe read_recipe(const fs::path& file) {
  // A recipe on standard input can be read once, and this is the one place that reads recipes.
  const auto text = file == standard_input_name ? read_input(standard_input).text : read_file(file);
  const auto table = parse_toml(text, file.string());
  TomlReader reader(table, file.string());
  Recipe recipe;
  recipe.plot.source = file.string();
  describe(reader, recipe);
  reader.finish();
  return recipe;
}

using Computation = std::function<figures::FigureTable(const figures::FigureContext&)>;

/// The built-in computation of that name. InputError at the recipe's key if there is none.
const Computation& find_computation(const std::string& name, const fs::path& recipe) {
  std::vector<std::string> known;
  for (const auto* list : {&experiments::computed_figures(), &theory::theory_figures()}) {
    if (const auto found = list->find(name); found != list->end()) return found->second;
    for (const auto& [id, computation] : *list) known.push_back(id);
  }
  const auto hint = nearest(name, known);
  throw InputError(fmt::format("{}: data.compute: \"{}\" is not known{}", recipe.string(), name,
                               hint.empty() ? "" : ", did you mean \"" + hint + "\"?"));
}

/// Rows of a CSV file with the columns that figures have.
figures::FigureTable read_rows(const fs::path& file) {
  const auto table = read::read_table(file);
  const auto x = table.values("x"), y = table.values("y");
  const auto series = table.text("series");
  const auto optional = [&](const char* name) {
    return table.has(name) ? table.column(name) : std::vector<double>(x.size(), NAN);
  };
  const auto x_err = optional("x_err"), y_err = optional("y_err");
  const auto panel = table.has("panel") ? table.text("panel") : std::vector<std::string>(x.size());
  const auto known = [](double v) { return std::isfinite(v) ? std::optional(v) : std::nullopt; };
  figures::FigureTable made;
  made.comments = table.comments;
  made.x_times = table.is_time("x"), made.y_times = table.is_time("y");
  for (std::size_t i = 0; i < x.size(); ++i)
    made.rows.push_back({panel[i], series[i], x[i], y[i], known(x_err[i]), known(y_err[i])});
  return made;
}

figures::FigureTable make_table(const Recipe& recipe, const fs::path& file, const fs::path& directory,
                                const figures::FigureContext& context,
                                const std::function<bool(double)>& progress) {
  if (recipe.data.table) return read_rows(file.parent_path() / *recipe.data.table);
  figures::FigureTable table;
  if (recipe.data.compute || !recipe.data.experiments.empty()) {
    table = recipe.data.compute ? find_computation(*recipe.data.compute, file)(context)
                                : experiments::make_table(recipe.data.experiments, file, context, progress);
    if (!recipe.data.scene) {
      table.comments.push_back(
          fmt::format("made by chute {} ({}){}", run::version, run::commit,
                      context.quick ? "; quick: a cheaper computation than the full figure's" : ""));
      return table;
    }
  }
  auto simulated =
      figures::simulate(recipe.data, file, directory / "runs", context, command_line(), progress);
  simulated.rows.insert(simulated.rows.begin(), table.rows.begin(), table.rows.end());
  // What x and y are the recipe says; the rest tells of the rows that were computed.
  for (const auto& comment : table.comments)
    if (!comment.starts_with("x:") && !comment.starts_with("y:")) simulated.comments.push_back(comment);
  return simulated;
}

std::string csv_text(const Recipe& recipe, const figures::FigureTable& table) {
  std::vector<std::string> comments{recipe.title};
  comments.insert(comments.end(), table.comments.begin(), table.comments.end());
  io::Csv csv(comments, {"panel", "series", "x", "y", "x_err", "y_err"});
  const auto text = [](double value, bool is_time) {
    return is_time ? read::iso_text(value) : fmt::format("{}", value);
  };
  for (const auto& row : table.rows)
    if (table.y_times)
      csv.row({row.panel, row.series, text(row.x, table.x_times), text(row.y, true)}, {row.x_err, row.y_err});
    else if (table.x_times)
      csv.row({row.panel, row.series, text(row.x, true)}, {row.y, row.x_err, row.y_err});
    else
      csv.row({row.panel, row.series}, {row.x, row.y, row.x_err, row.y_err});
  return csv.text();
}

}  // namespace

std::vector<KnownFigure> known_figures() {
  std::vector<KnownFigure> known;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(scenes_folder(), error)) {
    const auto id = entry.path().stem().string();
    if (entry.path().extension() != ".toml" || !(id.starts_with("fig-") || id.starts_with("table-")))
      continue;
    known.push_back({id, read_recipe(entry.path()).title, entry.path()});
  }
  if (error)
    throw InputError(scenes_folder().string() + ": cannot read the folder of recipes: " + error.message());
  std::sort(known.begin(), known.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return known;
}

fs::path find_recipe(const std::string& name) {
  if (name == standard_input) return standard_input_name;
  if (name.ends_with(".toml")) return name;  // read_recipe says if it cannot be read
  std::vector<std::string> ids;
  for (const auto& figure : known_figures()) {
    if (figure.id == name) return figure.recipe;
    ids.push_back(figure.id);
  }
  const auto hint = nearest(name, ids);
  throw InputError(fmt::format("figure {}: not known{}; chute figure --list shows all", name,
                               hint.empty() ? "" : ", did you mean " + hint + "?"));
}

void make_figure(const fs::path& file, const fs::path& directory, const figures::FigureContext& context,
                 const std::function<bool(double)>& progress) {
  const Recipe recipe = read_recipe(file);
  const auto table = make_table(recipe, file, directory, context, progress);
  const auto beside = [&](const char* extension) { return directory / (file.stem().string() + extension); };
  // A table of the user's own may stand where the figure's would go: it stays as it is.
  std::error_code error;
  const bool is_source =
      recipe.data.table && fs::equivalent(file.parent_path() / *recipe.data.table, beside(".csv"), error);
  // The picture is drawn from the table's text, as any reader of the file would see the numbers; and before anything is
  // written, since what stands there may be better than nothing.
  const auto text = csv_text(recipe, table);
  const auto figure = plot::figure_from(recipe.plot, read::parse_table(text, beside(".csv")));
  const auto list = plot::lay_out(figure).list;
  fs::create_directories(directory);
  remove_leftovers(directory);
  if (!is_source) write_atomically(beside(".csv"), text);
  const plot::Metadata metadata{
      {"Title", recipe.title},
      {"Creator", fmt::format("chute {} ({})", run::version, run::commit)},
      {"Subject", fmt::format("{}{}", file.filename().string(), context.quick ? ", quick" : "")}};
  plot::draw_png(list, beside(".png"), plot::default_dpi, metadata);
  plot::draw_pdf(list, beside(".pdf"), metadata);
  plot::draw_svg(list, beside(".svg"), metadata);
}

}  // namespace chute::app
