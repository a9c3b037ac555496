#include "app/figure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "app/input.hpp"
#include "app/progress.hpp"
#include "app/verbs.hpp"
#include "common/atomic_file.hpp"
#include "common/column_texts.hpp"
#include "common/error.hpp"
#include "common/key_table.hpp"
#include "common/share_folder.hpp"
#include "common/toml_reader.hpp"
#include "experiments/computed_figures.hpp"
#include "figures/simulate.hpp"
#include "io/csv.hpp"
#include "plot/draw.hpp"
#include "plot/fonts.hpp"
#include "plot/layout.hpp"
#include "plot/recipe.hpp"
#include "plot/referee.hpp"
#include "plot/style.hpp"
#include "plot/table_sheet.hpp"
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

/// A recipe file: [data], or several [[data]], say where the numbers come from, [plot] and [style] how they look.
struct Recipe {
  std::string title;
  std::vector<figures::DataRecipe> data;
  plot::PlotRecipe plot;  ///< with what [style] or the style file says
};

plot::StyleChanges read_style(const fs::path& file) {
  const auto keys = parse_toml(read_file(file), file.string());
  TomlReader reader(keys, file.string());
  plot::StyleChanges style;
  describe(reader, style);
  reader.finish();
  return style;
}

/// 0, the usual one, where none is named, or one that is not there: [style] has told that.
int family_named(const std::optional<std::string>& font) try {
  return font ? plot::font_family(*font) : 0;
} catch (const InputError&) {
  return 0;
}

/// The rows of a map would be drawn as lines, along an axis that is not theirs, where no panel makes a map of them.
void check_maps(const TomlReader& a, const Recipe& recipe) {
  for (const auto& data : recipe.data) {
    if (!data.table || !data.columns.z) continue;
    const auto name = figures::series_of_map(data.columns);
    const bool drawn = std::ranges::any_of(recipe.plot.panels, [&](const plot::PanelRecipe& panel) {
      return panel.map && panel.label == data.columns.panel && plot::matches(panel.map->series, name + "0");
    });
    a.check(drawn, "data",
            fmt::format("z = \"{}\" is of a map: [[plot.panel]] with {}map = {{ series = \"{}*\" }} draws it",
                        *data.columns.z,
                        data.columns.panel.empty() ? "" : fmt::format("label = \"{}\", ", data.columns.panel),
                        name));
  }
}

}  // namespace

static void describe(TomlReader& a, Recipe& recipe) {
  a.required("title", recipe.title);
  if (!a.has("data") || a.has_table("data"))
    a.required_section("data", recipe.data.emplace_back());
  else
    a.sections("data", recipe.data);
  a.check(!recipe.data.empty(), "data", "a figure needs data");
  if (!a.has("style") || a.has_table("style")) {
    a.section("style", recipe.plot.changes);
  } else {
    std::string file;
    a.value("style", file);
    recipe.plot.changes = read_style(fs::path(recipe.plot.source).parent_path() / file);
  }
  // texts are tried out as they are read, so their font comes first
  const auto& font = recipe.plot.changes.font;
  const plot::FamilyScope family(family_named(font));
  a.section("plot", recipe.plot);
}
static void describe(KeyLister& a, Recipe& recipe) {
  a.required("title", recipe.title, "of the figure");
  a.value("style", std::string(), "a file with the keys of [style], relative to the recipe, in its place");
  a.sections("data", recipe.data);
  a.section("plot", recipe.plot);
  a.section("style", recipe.plot.changes);
}

namespace {

Recipe read_recipe(const fs::path& file) {
  // A recipe on standard input can be read once, and this is the one place that reads recipes.
  const auto text = file == standard_input_name ? read_input(standard_input).text : read_file(file);
  const auto table = parse_toml(text, file.string());
  if (!table.contains("data") && !table.contains("plot") &&
      (table.contains("grains") || table.contains("engine") || table.contains("experiment")))
    throw InputError(
        fmt::format("{}: a scene, not the recipe of a figure: chute run {}", file.string(), file.string()));
  TomlReader reader(table, file.string());
  Recipe recipe;
  recipe.plot.source = file.string();
  reader.collect();
  try {
    describe(reader, recipe);
    reader.finish();
  } catch (const SlipTold&) {
    // told with the others
  }
  reader.throw_slips();
  check_maps(reader, recipe);
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

/// The recipe with these settings for all its scenes, on top of its own. They stand in the figure's table.
Recipe with_settings(Recipe recipe, const std::vector<std::string>& set, const fs::path& file) {
  if (set.empty()) return recipe;
  bool any = false;
  for (auto& data : recipe.data) {
    if (!data.scene) continue;
    any = true;
    for (auto& curve : data.curves)
      for (auto* settings : {&curve.set, &curve.quick})
        settings->insert(settings->end(), set.begin(), set.end());
    for (auto& curve : data.sweeps) curve.set.insert(curve.set.end(), set.begin(), set.end());
    data.notes.push_back(fmt::format("not as the recipe has it: {}", fmt::join(set, " ")));
  }
  if (!any)
    throw InputError(
        fmt::format("{}: no scene is simulated, of which --set could change a key", file.string()));
  return recipe;
}

/// The rows of one source of a figure.
figures::FigureTable table_of(const figures::DataRecipe& data, const fs::path& file,
                              const fs::path& directory, const figures::FigureContext& context,
                              const std::function<bool(double)>& progress) {
  if (data.table) return figures::rows_of_table(data.columns, file.parent_path() / *data.table);
  if (data.formula) return figures::rows_of_formula(*data.formula);
  figures::FigureTable table;
  if (data.compute || !data.experiments.empty()) {
    table = data.compute ? find_computation(*data.compute, file)(context)
                         : experiments::make_table(data.experiments, file, context, progress);
    if (!data.scene) {
      table.comments.push_back(
          fmt::format("made by chute {} ({}){}", run::version, run::commit,
                      context.quick ? "; quick: a cheaper computation than the full figure's" : ""));
      return table;
    }
  }
  auto simulated = figures::simulate(data, file, directory / "runs", context, command_line(), progress);
  simulated.rows.insert(simulated.rows.begin(), table.rows.begin(), table.rows.end());
  // What x and y are the recipe says; the rest tells of the rows that were computed.
  for (const auto& comment : table.comments)
    if (!comment.starts_with("x:") && !comment.starts_with("y:")) simulated.comments.push_back(comment);
  return simulated;
}

/// All sources one after the other, and the laws that are put through them.
figures::FigureTable make_table(const Recipe& recipe, const fs::path& file, const fs::path& directory,
                                const figures::FigureContext& context,
                                const std::function<bool(double)>& progress) {
  figures::FigureTable table;
  const auto count = static_cast<double>(recipe.data.size());
  for (std::size_t k = 0; k < recipe.data.size(); ++k) {
    auto one = table_of(recipe.data[k], file, directory, context,
                        [&](double part) { return progress((static_cast<double>(k) + part) / count); });
    for (auto& comment : one.comments)
      if (std::ranges::find(table.comments, comment) == table.comments.end())
        table.comments.push_back(std::move(comment));
    table.x_times = table.x_times || one.x_times, table.y_times = table.y_times || one.y_times;
    table.rows.insert(table.rows.end(), std::make_move_iterator(one.rows.begin()),
                      std::make_move_iterator(one.rows.end()));
  }
  for (const auto& data : recipe.data)
    for (const auto& fit : data.fits) figures::draw_fit(context.quick ? figures::quick_of(fit) : fit, table);
  for (const auto& data : recipe.data)
    for (const auto& ratio : data.ratios) figures::draw_ratio(ratio, table);
  return table;
}

/// The figure of a table's text, as any reader of the file would see the numbers.
plot::Figure figure_of(const Recipe& recipe, const figures::FigureTable& table, const std::string& text,
                       const fs::path& csv) {
  auto plot = recipe.plot;
  plot.labels = table.labels;
  return plot::figure_from(plot, read::parse_table(text, csv));
}

std::string csv_text(const Recipe& recipe, const figures::FigureTable& table) {
  std::vector<std::string> comments{recipe.title};
  comments.insert(comments.end(), table.comments.begin(), table.comments.end());
  io::Csv csv(comments, {"panel", "series", "x", "y", "x_err", "y_err"});
  // An error of exactly 0, such as of a mean over runs that all have the same, is one that nobody knows.
  const auto known = [](std::optional<double> error) { return error && *error > 0 ? error : std::nullopt; };
  const auto text = [](double value, bool is_time) {
    return is_time ? read::iso_text(value) : fmt::format("{}", value);
  };
  for (const auto& row : table.rows) {
    const auto x_err = known(row.x_err), y_err = known(row.y_err);
    if (table.y_times)
      csv.row({row.panel, row.series, text(row.x, table.x_times), text(row.y, true)}, {x_err, y_err});
    else if (table.x_times)
      csv.row({row.panel, row.series, text(row.x, true)}, {row.y, x_err, y_err});
    else
      csv.row({row.panel, row.series}, {row.x, row.y, x_err, y_err});
  }
  return with_column_comments("figure", csv.text(), true);
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

const std::vector<FigureGroup>& figure_groups() {
  static const std::vector<FigureGroup> groups{
      {"all", "every figure", {""}},
      {"thesis", "those of the dissertation", {"fig-1-", "fig-2-", "fig-3-", "fig-4-", "fig-5-", "table-"}},
      {"experiments", "those of its laboratory, fig-e-…", {"fig-e-"}},
      {"methods", "those of its methods, fig-m-…", {"fig-m-"}},
      {"beyond", "those of its outlook, fig-b-…", {"fig-b-"}}};
  return groups;
}

std::vector<fs::path> find_recipes(const std::string& name) {
  const auto& groups = figure_groups();
  const auto group =
      std::find_if(groups.begin(), groups.end(), [&](const FigureGroup& g) { return g.word == name; });
  if (group == groups.end()) return {find_recipe(name)};
  std::vector<fs::path> recipes;
  for (const auto& figure : known_figures())
    if (std::any_of(group->beginnings.begin(), group->beginnings.end(),
                    [&](const char* beginning) { return figure.id.starts_with(beginning); }))
      recipes.push_back(figure.recipe);
  if (recipes.empty())
    throw InputError(fmt::format("figure {}: none is in {}", name, scenes_folder().string()));
  return recipes;
}

fs::path find_recipe(const std::string& name) {
  if (name == standard_input) return standard_input_name;
  if (name.ends_with(".toml")) return name;  // read_recipe says if it cannot be read
  std::vector<std::string> ids;
  for (const auto& figure : known_figures()) {
    if (figure.id == name) return figure.recipe;
    ids.push_back(figure.id);
  }
  for (const auto& group : figure_groups()) ids.push_back(group.word);
  const auto hint = nearest(name, ids);
  throw InputError(fmt::format("figure {}: not known{}; chute figure --list shows all", name,
                               hint.empty() ? "" : ", did you mean " + hint + "?"));
}

namespace {

/// What a figure's comment "y: velocity; y_err: of eight runs" is below its table, where errors stand behind a ±.
std::string note_of_table(const std::string& comment) {
  auto text = comment.substr(comment.find_first_not_of(' ', 2));
  constexpr std::string_view column = "y_err";
  for (std::size_t at = 0; (at = text.find(column, at)) != std::string::npos;)
    text.replace(at, column.size(), "±");
  return text;
}

/// ID-table.csv, .md, .pdf, .svg and .png beside the figure: a table is read, typeset and computed with, and each wants its own.
void write_table(const plot::TableSheet& sheet, const plot::Look& look, const fs::path& beside,
                 const plot::Metadata& metadata) {
  const auto file = [&](const char* extension) { return fs::path(beside.string() + "-table" + extension); };
  std::vector<std::string> comments{sheet.title};
  comments.insert(comments.end(), sheet.notes.begin(), sheet.notes.end());
  std::vector<std::string> names;
  for (const auto& name : sheet.series) names.push_back(name), names.push_back(name + "_err");
  std::vector<std::string_view> columns{"panel", "name"};
  columns.insert(columns.end(), names.begin(), names.end());
  io::Csv csv(comments, columns);
  for (const auto& group : sheet.groups)
    for (const auto& row : group.rows) {
      std::vector<io::Csv::Cell> cells;
      for (const auto& cell : row.cells)
        for (const double v : {cell.value, cell.error})
          cells.push_back(std::isfinite(v) ? io::Csv::Cell(v) : std::nullopt);
      csv.row({group.heading, row.name}, cells);
    }
  write_atomically(file(".csv"), csv.text());
  write_atomically(file(".md"), plot::markdown(sheet));
  const auto layout = plot::lay_out(sheet, look);
  plot::draw_png(layout.list, file(".png"), plot::default_dpi, metadata);
  plot::draw_pdf(layout.list, file(".pdf"), metadata);
  plot::draw_svg(layout.list, file(".svg"), metadata);
}

}  // namespace

std::vector<std::string> make_figure(const fs::path& file, const fs::path& directory,
                                     const figures::FigureContext& context,
                                     const std::function<bool(double)>& progress) {
  const Recipe recipe = with_settings(read_recipe(file), context.set, file);
  const auto table = make_table(recipe, file, directory, context, progress);
  const auto beside = [&](const char* extension) { return directory / (file.stem().string() + extension); };
  // A table of the user's own may stand where the figure's would go: it stays as it is.
  std::error_code error;
  const bool is_source = std::ranges::any_of(recipe.data, [&](const auto& data) {
    return data.table && fs::equivalent(file.parent_path() / *data.table, beside(".csv"), error);
  });
  // Before anything is written, since what stands there may be better than nothing.
  const auto text = csv_text(recipe, table);
  const auto figure = figure_of(recipe, table, text, beside(".csv"));
  const auto layout = plot::lay_out(figure);
  const auto& list = layout.list;
  std::optional<plot::TableSheet> sheet;
  if (recipe.plot.table) {
    std::vector<std::string> notes;
    for (const auto& comment : table.comments)
      if (comment.starts_with("y:")) notes.push_back(note_of_table(comment));
    sheet = plot::table_sheet(figure, recipe.title, notes);
  }
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
  if (sheet) write_table(*sheet, plot::look_of(figure), directory / file.stem(), metadata);
  std::vector<std::string> findings;
  for (const auto& finding : plot::review(figure, layout))
    findings.push_back(fmt::format(
        "{}{}: {}",
        finding.panel >= 0 && figure.panels.size() > 1 ? fmt::format("panel {}: ", finding.panel + 1) : "",
        plot::name(finding.kind), finding.what));
  return findings;
}

std::string check_figure(const fs::path& file, const fs::path& directory,
                         const figures::FigureContext& context) {
  const Recipe recipe = with_settings(read_recipe(file), context.set, file);
  figures::Work work;
  bool all_there = true;
  for (const auto& data : recipe.data) {
    if (data.compute) find_computation(*data.compute, file);
    if (data.scene) {
      const auto own = figures::work_of(data, file, directory / "runs", context.quick);
      work.runs += own.runs, work.there += own.there, work.seconds += own.seconds;
    }
    all_there = all_there && !data.scene && !data.compute && data.experiments.empty();
  }
  if (all_there) {
    const auto table = make_table(recipe, file, directory, context, [](double) { return true; });
    plot::lay_out(figure_of(recipe, table, csv_text(recipe, table), file.stem().string() + ".csv"));
    return fmt::format("{} rows, nothing to simulate", table.rows.size());
  }
  if (work.runs == 0) return "a computation of its own";
  return fmt::format("{} run{}, {} of them there already, about {} of one core", work.runs,
                     work.runs == 1 ? "" : "s", work.there, duration_text(work.seconds));
}

namespace {

/// What stands above the keys of a table: of `data.+table.where` "[data.where] with table".
std::string heading_of(const std::string& table) {
  if (table.empty()) return "All recipes";
  if (table == "plot.x") return "`[plot.x]`, and every other axis: y, right, top, those of panels and insets";
  const auto plus = table.find(".+");
  if (plus == table.npos) return fmt::format("`[{}]`", table);
  const auto end = std::min(table.find('.', plus + 1), table.size());
  return fmt::format("`[{}{}]` with `{}`", table.substr(0, plus), table.substr(end),
                     table.substr(plus + 2, end - plus - 2));
}

}  // namespace

std::string figure_keys() {
  KeyLister lister;
  Recipe recipe;
  describe(lister, recipe);
  // One table for each table of the recipe, in the order in which they come.
  std::vector<std::pair<std::string, std::vector<KeyText>>> tables;
  for (auto key : lister.keys()) {
    const auto dot = key.key.rfind('.');
    const auto table = dot == key.key.npos ? std::string() : key.key.substr(0, dot);
    if (dot != key.key.npos) key.key = key.key.substr(dot + 1);
    // Axes look the same everywhere.
    if (table.starts_with("plot.") && table != "plot.x" &&
        (table.ends_with(".x") || table.ends_with(".y") || table.ends_with(".right") ||
         table.ends_with(".top")))
      continue;
    auto found = std::ranges::find(tables, table, &std::pair<std::string, std::vector<KeyText>>::first);
    if (found == tables.end()) found = tables.insert(found, {table, {}});
    const bool again = std::ranges::any_of(found->second, [&](const auto& k) { return k.key == key.key; });
    if (!again) found->second.push_back(std::move(key));
  }
  KeyTable all;
  for (const auto& [table, keys] : tables) all.add(heading_of(table), keys);
  return all.text();
}

}  // namespace chute::app
