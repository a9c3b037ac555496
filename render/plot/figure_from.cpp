#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "common/error.hpp"
#include "plot/cells.hpp"
#include "plot/density.hpp"
#include "plot/factors.hpp"
#include "plot/legend.hpp"
#include "plot/map.hpp"
#include "plot/parameters.hpp"
#include "plot/recipe.hpp"

namespace chute::plot {

bool matches(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) return name.empty();
  if (pattern[0] != '*')
    return !name.empty() && pattern[0] == name[0] && matches(pattern.substr(1), name.substr(1));
  for (std::size_t skip = 0; skip <= name.size(); ++skip)
    if (matches(pattern.substr(1), name.substr(skip))) return true;
  return false;
}

namespace {

struct Rows {
  std::vector<std::string> panel, series;
  std::vector<double> x, y, x_err, y_err;
  bool x_times = false, y_times = false;
};

bool is_line_by_name(const std::string& name) {
  return name.starts_with("theory") || name.starts_with("exact") || name.starts_with("linear") ||
         name.starts_with("eq ") || name.ends_with(" fit");
}

/// More markers than these would run together into a string, and are drawn small: diameter in points.
constexpr std::size_t crowded = 60;
constexpr double small_marker = 2;

class Builder {
 public:
  Builder(const PlotRecipe& recipe, const read::Table& table) : recipe_(recipe), table_(table) {
    rows_.panel = table.text("panel"), rows_.series = table.text("series");
    rows_.x = table.values("x"), rows_.y = table.values("y");
    rows_.x_times = table.is_time("x"), rows_.y_times = table.is_time("y");
    if (table.has("x_err")) rows_.x_err = table.column("x_err");
    if (table.has("y_err")) rows_.y_err = table.column("y_err");
    if (rows_.x.empty()) fail("no rows to draw");
    for (const auto& p : rows_.panel)
      if (std::find(names_.begin(), names_.end(), p) == names_.end()) names_.push_back(p);
  }

  Figure build() {
    Figure figure;
    figure.source = recipe_.source;
    figure.width = recipe_.width, figure.height = recipe_.height, figure.aspect = recipe_.aspect;
    figure.style = recipe_.style, figure.changes = recipe_.changes,
    figure.columns = static_cast<int>(recipe_.columns);
    figure.share_x = recipe_.share_x, figure.share_y = recipe_.share_y, figure.legend = recipe_.legend;
    figure.own_ranges = recipe_.own_ranges;
    for (const auto& word : recipe_.words) figure.words.emplace_back(word.name, word.label);
    check_recipe();
    for (const auto& panel : recipe_.panels) figure.panels.push_back(make_panel(panel));
    for (const auto& name : names_) {
      const bool named = std::any_of(recipe_.panels.begin(), recipe_.panels.end(),
                                     [&](const PanelRecipe& p) { return p.label == name; });
      if (named || is_inset(name)) continue;
      PanelRecipe plain;
      plain.label = name;
      figure.panels.push_back(make_panel(plain));
    }
    require_use(&Panel::right, recipe_.right, "right", "axis", figure);
    require_use(&Panel::top, recipe_.top, "top", "x_axis", figure);
    draw_crowds_as_densities(figure);
    if (figure.panels.size() == 1 && names_.size() == 1)
      figure.panels[0].label.clear();  // (a) alone says nothing
    return figure;
  }

 private:
  const PlotRecipe& recipe_;
  const read::Table& table_;
  Rows rows_;
  std::vector<std::string> names_;  // of panels, as they come in the table

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(table_.file.string() + ": " + what);
  }
  [[noreturn]] void fail_recipe(const std::string& what) const {
    throw InputError((recipe_.source.empty() ? std::string("recipe") : recipe_.source) + ": plot: " + what);
  }

  bool is_inset(const std::string& panel) const {
    for (const auto& p : recipe_.panels)
      for (const auto& inset : p.insets)
        if (inset.panel == panel) return true;
    return false;
  }

  void require_panel(const std::string& name, const char* where) const {
    if (std::find(names_.begin(), names_.end(), name) != names_.end()) return;
    fail_recipe(fmt::format("{} \"{}\": no rows of that panel in {}", where, name, table_.file.string()));
  }

  /// A second axis along which nothing counts would not be drawn.
  void require_use(std::optional<Axis> Panel::*axis, const std::optional<AxisRecipe>& asked,
                   std::string_view name, std::string_view key, const Figure& figure) const {
    if (asked && std::none_of(figure.panels.begin(), figure.panels.end(),
                              [&](const Panel& panel) { return (panel.*axis).has_value(); }))
      fail_recipe(
          fmt::format("{}: no series counts along it: [[plot.series]] with {} = \"{}\"", name, key, name));
  }

  /// A name that nothing answers to is a slip.
  void check_recipe() const {
    for (const auto& p : recipe_.panels) {
      require_panel(p.label, "panel");
      for (const auto& inset : p.insets) {
        if (inset.panel) require_panel(*inset.panel, "inset panel");
        for (const auto& pattern : inset.series) require_series(pattern, inset.panel.value_or(p.label));
      }
    }
    for (const auto& s : recipe_.series) {
      if (s.panel) require_panel(*s.panel, "series panel");
      if (!s.may_be_empty) require_series(s.match, s.panel);
    }
  }

  void require_series(const std::string& pattern, const std::optional<std::string>& panel) const {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < rows_.series.size(); ++i) {
      if (panel && rows_.panel[i] != *panel) continue;
      if (matches(pattern, rows_.series[i])) return;
      if (known.empty() || known.back() != rows_.series[i]) known.push_back(rows_.series[i]);
    }
    const auto hint = nearest(pattern, known);
    fail_recipe(fmt::format("series \"{}\": none of that name in {}{}", pattern, table_.file.string(),
                            hint.empty() ? "" : fmt::format(", did you mean \"{}\"?", hint)));
  }

  Axis make_axis(const AxisRecipe& general, const AxisRecipe& own, bool times) const {
    Axis axis;
    axis.label = own.label.value_or(general.label.value_or(""));
    const auto scale = own.scale != AxisRecipe::Scale::automatic ? own.scale : general.scale;
    axis.scale = scale == AxisRecipe::Scale::log ? Scale::log : Scale::linear;
    axis.min = own.min ? own.min : general.min;
    axis.max = own.max ? own.max : general.max;
    axis.names = own.names.empty() ? general.names : own.names;
    axis.times = times && axis.names.empty();
    const auto from = own.from ? own.from : general.from, to = own.to ? own.to : general.to;
    if ((from || to) && !axis.times) fail_recipe("from and to are of axes of dates: give min and max");
    if (from) axis.min = from;
    if (to) axis.max = to;
    if (axis.times && axis.scale == Scale::log) fail_recipe("dates have no logarithmic axis");
    if (axis.times && factor(general, own) != 1) fail_recipe("dates have no factor");
    return axis;
  }
  static double factor(const AxisRecipe& general, const AxisRecipe& own) {
    return own.factor.value_or(general.factor.value_or(1));
  }

  const SeriesRecipe* recipe_for(const std::string& name, const std::string& panel) const {
    for (const auto& s : recipe_.series)
      if (matches(s.match, name) && (!s.panel || *s.panel == panel)) return &s;
    return nullptr;
  }

  /// The panel's series in the order of the table; those that match one of `only`, if there are any.
  std::vector<Series> make_series(const std::string& panel, const std::vector<std::string>& only, double fx,
                                  double fy) const {
    std::vector<Series> found;
    for (std::size_t i = 0; i < rows_.x.size(); ++i) {
      const auto& name = rows_.series[i];
      if (rows_.panel[i] != panel) continue;
      if (!only.empty() && std::none_of(only.begin(), only.end(), [&](auto& p) { return matches(p, name); }))
        continue;
      auto s = std::find_if(found.begin(), found.end(), [&](const Series& f) { return f.name == name; });
      if (s == found.end()) {
        found.emplace_back().name = name;
        s = found.end() - 1;
      }
      s->x.push_back(fx * rows_.x[i]), s->y.push_back(fy * rows_.y[i]);
      s->x_err.push_back(rows_.x_err.empty() ? unknown : std::abs(fx) * rows_.x_err[i]);
      s->y_err.push_back(rows_.y_err.empty() ? unknown : std::abs(fy) * rows_.y_err[i]);
    }
    std::vector<Series> drawn;
    for (auto& s : found) {
      const auto* own = recipe_for(s.name, panel);
      auto kind = own ? own->kind : KindChoice::automatic;
      if (kind == KindChoice::off) continue;
      if (kind == KindChoice::automatic && is_line_by_name(s.name)) kind = KindChoice::line;
      if (kind == KindChoice::automatic) kind = recipe_.kind;
      if (kind == KindChoice::automatic) kind = s.x.size() > 80 ? KindChoice::line : KindChoice::both;
      s.kind = static_cast<Kind>(static_cast<int>(kind) - 1);
      s.hollow = is_told_hollow(table_.comments, panel, s.name);
      // points that averages do not vouch for are not joined, nor drawn as a line of their own
      if (is_doubtful(s.name) && !own && s.kind != Kind::dots && s.kind != Kind::cells) {
        s.kind = Kind::markers;
        if (s.x.size() > crowded) s.size = small_marker;
      }
      if (own) {
        s.label = own->label;
        if (own->color >= 0) s.color = own->color;
        if (own->marker >= 0) s.marker = own->marker;
        if (own->dash >= 0) s.dash = own->dash;
        s.ink = own->ink, s.width = own->width, s.size = own->size;
        s.right = own->right, s.top = own->top;
      }
      if (const auto told = recipe_.labels.find(s.name); !s.label && told != recipe_.labels.end())
        s.label = told->second;
      drawn.push_back(std::move(s));
    }
    return drawn;
  }

  /// Over a name, points of equal height would hide each other.
  static void set_side_by_side(std::vector<Series>& series) {
    const double n = static_cast<double>(series.size()), step = std::min(0.16, 0.7 / std::max(1.0, n));
    for (std::size_t i = 0; i < series.size(); ++i)
      for (double& x : series[i].x) x += step * (static_cast<double>(i) - (n - 1) / 2);
  }

  /// The rows of a map: of each series that matches, in order of the number after its last =.
  Map make_map(const PanelRecipe& p, std::vector<Series>& series) const {
    const auto& wanted = *p.map;
    std::map<double, const Series*> of;
    for (const auto& s : series) {
      if (!matches(wanted.series, s.name)) continue;
      const auto text = s.name.substr(s.name.rfind('=') + 1);
      char* end = nullptr;
      const double y = std::strtod(text.c_str(), &end);
      if (text.empty() || *end) fail_recipe(fmt::format("map: the name \"{}\" ends with no number", s.name));
      of[factor(recipe_.y, p.y) * y] = &s;
    }
    if (of.empty()) require_series(wanted.series, p.label);
    Map map;
    map.label = wanted.label, map.low = wanted.low, map.high = wanted.high;
    map.diverging = wanted.diverging, map.contours = static_cast<int>(wanted.contours);
    map.filled = static_cast<int>(wanted.filled);
    map.levels = wanted.levels, map.values_on_lines = wanted.contour_labels;
    for (const auto& [y, row] : of) map.x.insert(map.x.end(), row->x.begin(), row->x.end());
    std::sort(map.x.begin(), map.x.end());
    map.x.erase(std::unique(map.x.begin(), map.x.end()), map.x.end());
    constexpr std::size_t most = 4'000'000;  // more than a page shows, and tens of megabytes
    if (map.x.size() * of.size() > most)
      fail_recipe(
          fmt::format("map: {} values of x in {} rows make more than {} cells: they are to lie on a grid",
                      map.x.size(), of.size(), most));
    for (const auto& [y, row] : of) {
      map.y.push_back(y);
      std::vector<double> values(map.x.size(), unknown);
      const double unscaled = factor(recipe_.y, p.y);
      for (std::size_t i = 0; i < row->x.size(); ++i)
        values[static_cast<std::size_t>(std::lower_bound(map.x.begin(), map.x.end(), row->x[i]) -
                                        map.x.begin())] = row->y[i] / unscaled;
      map.values.insert(map.values.end(), values.begin(), values.end());
    }
    if (map.filled > 0 && (map.x.size() < 2 || map.y.size() < 2))
      fail_recipe("map: filled needs at least two columns and two rows");
    std::erase_if(series, [&](const Series& s) { return matches(wanted.series, s.name); });
    return map;
  }

  /// What belongs to the lines is no series of its own.
  Chains make_chains(const PanelRecipe& p, std::vector<Series>& series) const {
    const auto& wanted = *p.chains;
    const auto named = [&](const std::string& name) -> const Series& {
      require_series(name, p.label);
      for (const auto& s : series)
        if (s.name == name) return s;
      fail_recipe(fmt::format("chains: series \"{}\" is off", name));
    };
    const auto &places = named(wanted.places), &branches = named(wanted.branches),
               &weights = named(wanted.weights);
    if (branches.x.size() != places.x.size() || weights.x.size() != places.x.size())
      fail(fmt::format("{}, {} and {} must have one row for each line", wanted.places, wanted.branches,
                       wanted.weights));
    Chains chains{places.x, places.y, branches.x, branches.y, weights.y};
    std::erase_if(series, [&](const Series& s) {
      return s.name == wanted.places || s.name == wanted.branches || s.name == wanted.weights;
    });
    return chains;
  }

  /// A second axis of y or x, if the recipe has one or a series asks for it, and how much more its numbers are than those of the
  /// first. `side` says which of the two.
  std::optional<Axis> second_axis(const PanelRecipe& p, const Panel& panel, bool Series::*side,
                                  std::optional<AxisRecipe> PlotRecipe::*of_all,
                                  std::optional<AxisRecipe> PanelRecipe::*of_panel, double& more) const {
    const bool is_right = side == &Series::right;
    const std::string name = is_right ? "right" : "top", key = is_right ? "axis" : "x_axis";
    const bool used = std::any_of(panel.series.begin(), panel.series.end(), [&](auto& s) { return s.*side; });
    if (!used && p.*of_panel)
      fail_recipe(fmt::format("panel.{}: no series of this panel has {} = \"{}\"", name, key, name));
    if (!used) return {};
    if (is_right ? rows_.y_times : rows_.x_times) fail_recipe(name + ": dates have no second axis");
    if (p.map && is_right) fail_recipe("right: the colour bar of the map stands there");
    const AxisRecipe general = (recipe_.*of_all).value_or(AxisRecipe{}),
                     own = (p.*of_panel).value_or(AxisRecipe{});
    more = factor(general, own) / (is_right ? factor(recipe_.y, p.y) : factor(recipe_.x, p.x));
    return make_axis(general, own, false);
  }

  void make_second_axes(const PanelRecipe& p, Panel& panel) const {
    double more_y = 1, more_x = 1;
    panel.right = second_axis(p, panel, &Series::right, &PlotRecipe::right, &PanelRecipe::right, more_y);
    panel.top = second_axis(p, panel, &Series::top, &PlotRecipe::top, &PanelRecipe::top, more_x);
    const auto scale = [](std::vector<double>& values, std::vector<double>& errors, double more) {
      for (double& v : values) v *= more;
      for (double& e : errors) e *= std::abs(more);
    };
    for (auto& s : panel.series) {
      if (s.right) scale(s.y, s.y_err, more_y);
      if (s.top) scale(s.x, s.x_err, more_x);
      if ((s.right || s.top) && !s.label)
        s.label = fmt::format("{} ({})", label_from_name(s.name),
                              !s.top     ? "right"
                              : !s.right ? "top"
                                         : "right, top");
    }
  }

  Panel make_panel(const PanelRecipe& p) const {
    Panel panel;
    panel.label = p.tag.value_or(p.label), panel.title = p.title, panel.legend = p.legend;
    panel.parameters = p.parameters.value_or(parameters_of(table_.comments, p.label));
    panel.x = make_axis(recipe_.x, p.x, rows_.x_times), panel.y = make_axis(recipe_.y, p.y, rows_.y_times);
    panel.references = p.references, panel.regions = p.regions, panel.notes = p.notes;
    panel.series = make_series(p.label, {}, factor(recipe_.x, p.x), factor(recipe_.y, p.y));
    make_second_axes(p, panel);
    if (p.chains) panel.chains = make_chains(p, panel.series);
    // Maps and phase diagrams fill their frames.
    const auto tight = [](Axis& axis, const std::vector<double>& edges) {
      if (!axis.min) axis.min = edges.front();
      if (!axis.max) axis.max = edges.back();
    };
    const auto fill_frame = [&](const std::vector<double>& x, const std::vector<double>& y, bool to_edges) {
      tight(panel.x, to_edges ? cell_edges(x, panel.x.scale) : x);
      tight(panel.y, to_edges ? cell_edges(y, panel.y.scale) : y);
    };
    if (p.map) {
      panel.map = make_map(p, panel.series);
      fill_frame(panel.map->x, panel.map->y, panel.map->filled == 0);
    }
    if (const auto grid = cell_grid(panel); !grid.empty()) fill_frame(grid.x, grid.y, true);
    if (!panel.x.names.empty()) set_side_by_side(panel.series);
    for (const auto& i : p.insets) {
      Inset& inset = panel.insets.emplace_back();
      inset.width = i.width, inset.height = i.height, inset.place = i.place;
      inset.plot.x = make_axis({}, i.x, rows_.x_times), inset.plot.y = make_axis({}, i.y, rows_.y_times);
      inset.plot.series = make_series(i.panel.value_or(p.label), i.series, factor({}, i.x), factor({}, i.y));
      for (auto& s : inset.plot.series) s.right = s.top = false;
    }
    return panel;
  }
};

}  // namespace

Figure figure_from(const PlotRecipe& recipe, const read::Table& table) {
  return Builder(recipe, table).build();
}

}  // namespace chute::plot
