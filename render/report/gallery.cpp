#include "report/gallery.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/columns.hpp"
#include "common/fields.hpp"
#include "plot/legend.hpp"
#include "read/points_file.hpp"
#include "report/topics.hpp"
#include "view/color_field.hpp"

namespace chute::report {
namespace {

constexpr double half_width = 112, full_width = 200;  // mm, of figures of one frame and of several
constexpr std::size_t most_points = 3000;  // of a curve; more would make the page heavy and look the same
constexpr std::size_t most_dots = 8000;    // of a cloud
constexpr std::size_t most_told = 6;       // frames of quantities that only some methods have

using Runs = std::span<const RunFiles>;

bool is_flat(const std::vector<double>& values) {
  return std::none_of(values.begin(), values.end(), [](double v) { return std::isfinite(v) && v != 0; });
}

/// Every n-th value, so that no more than `most` are left.
void thin(std::vector<double>& values, std::size_t stride) {
  if (stride < 2) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); i += stride) values[kept++] = values[i];
  values.resize(kept);
}

/// A column that counts time, or what a method counts in its place.
std::string clock_of(const read::Table& table) {
  for (const auto word : fields::clocks)
    if (!table.header.empty() && table.header.front() == word) return std::string(word);
  return "time";
}

struct Curve {
  std::string name, label;
  std::vector<double> x, y, y_err;
};

plot::Series series_of(Curve curve, plot::Kind kind) {
  const std::size_t stride = kind == plot::Kind::dots ? 1 : curve.x.size() / most_points + 1;
  for (auto* values : {&curve.x, &curve.y, &curve.y_err}) thin(*values, stride);
  plot::Series series;
  series.name = curve.name, series.label = curve.label, series.kind = kind;
  series.x = std::move(curve.x), series.y = std::move(curve.y), series.y_err = std::move(curve.y_err);
  return series;
}

std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }

std::string csv_of(const Exhibit& exhibit) {
  std::string text = fmt::format("# {}\n", exhibit.title);
  for (const auto& panel : exhibit.figure.panels)
    text += fmt::format("# {}: x is {}, y is {}\n", panel.label.empty() ? "figure" : panel.label,
                        panel.x.label, panel.y.label);
  text += "panel,series,x,y,x_err,y_err\n";
  for (const auto& panel : exhibit.figure.panels)
    for (const auto& s : panel.series)
      for (std::size_t i = 0; i < s.x.size(); ++i)
        text += fmt::format("{},{},{},{},{},{}\n", cell(panel.label), cell(s.name), number(s.x[i]),
                            number(s.y[i]), s.x_err.empty() ? "" : number(s.x_err[i]),
                            s.y_err.empty() ? "" : number(s.y_err[i]));
  return text;
}

/// Lays panels out, and names them a, b, c … where there are several.
Exhibit exhibit_of(const Topic& topic, std::vector<plot::Panel> panels, std::size_t runs) {
  Exhibit exhibit{topic.id, topic.title, topic.caption, {}, {}};
  auto& figure = exhibit.figure;
  figure.source = topic.title;
  figure.width = panels.size() == 1 ? half_width : full_width;
  figure.columns = panels.size() == 1 ? 1 : 2;
  figure.aspect = panels.size() == 1 ? 0.66 : 0.56;
  if (runs > 1) figure.legend = panels.size() == 1 ? plot::Legend::automatic : plot::Legend::common;
  for (std::size_t i = 0; panels.size() > 1 && i < panels.size(); ++i)
    panels[i].label = std::string(1, static_cast<char>('a' + i % 26));
  figure.panels = std::move(panels);
  exhibit.csv = csv_of(exhibit);
  return exhibit;
}

/// What several runs call the x of a topic: of series it may be time in one and shakes in another.
std::string x_title(const Topic& topic, const std::vector<std::string>& clocks, const RunFiles& run) {
  const bool only_time = std::all_of(clocks.begin(), clocks.end(), [](const auto& c) { return c == "time"; });
  if (topic.x.column != "time" || only_time) return topic.x.title(run.units, run.dimensions);
  std::vector<std::string> names = clocks;
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return fmt::format("{}", fmt::join(names, " or "));
}

/// The exhibit of a topic, if any of the runs has numbers for it.
class TopicDrawer {
 public:
  TopicDrawer(const Topic& topic, Runs runs) : topic_(topic), runs_(runs) {
    for (const auto& run : runs) {
      tables_.push_back(run.table(topic.file));
      if (!tables_.back()) continue;
      clocks_.push_back(clock_of(*tables_.back()));
      any_ = true;
    }
  }
  bool has_tables() const { return any_; }

  std::vector<plot::Panel> panels() const {
    std::vector<plot::Panel> made;
    for (const auto& frame : topic_.frames) {
      if (runs_.size() == 1) {
        add(made, frame, frame.lines);
      } else {
        for (const auto& line : frame.lines) add(made, {{line}, line, frame.log_y}, {line});
      }
    }
    return made;
  }

 private:
  const Topic& topic_;
  Runs runs_;
  std::vector<std::optional<read::Table>> tables_;
  std::vector<std::string> clocks_;
  bool any_ = false;

  void add(std::vector<plot::Panel>& made, const Frame& frame, const std::vector<Quantity>& lines) const {
    plot::Panel panel;
    panel.x.label = x_title(topic_, clocks_, runs_.front());
    panel.y.label = frame.axis.title(runs_.front().units, runs_.front().dimensions);
    panel.x.scale = topic_.log_x ? plot::Scale::log : plot::Scale::linear;
    panel.y.scale = frame.log_y ? plot::Scale::log : plot::Scale::linear;
    for (std::size_t k = 0; k < runs_.size(); ++k)
      for (const auto& line : lines) add_line(panel, k, line);
    if (!panel.series.empty()) made.push_back(std::move(panel));
  }

  void add_line(plot::Panel& panel, std::size_t k, const Quantity& line) const {
    const auto& table = tables_[k];
    if (!table || !table->has(line.column) || !table->is_number(line.column)) return;
    const auto clock = topic_.x.column == "time" ? clock_of(*table) : topic_.x.column;
    if (!table->has(clock)) return;
    Curve curve{line.column, line.label, table->column(clock), table->column(line.column), {}};
    if (is_flat(curve.y)) return;
    if (table->has(line.column + "_err")) curve.y_err = table->column(line.column + "_err");
    if (runs_.size() > 1) curve.name = runs_[k].name, curve.label = view::escaped(runs_[k].name);
    const bool alone = panel_has_one_line();
    if (runs_.size() == 1 && alone) curve.label.clear();
    auto series = series_of(std::move(curve), topic_.kind);
    if (runs_.size() > 1) series.color = static_cast<int>(k);
    panel.series.push_back(std::move(series));
  }

  bool panel_has_one_line() const {
    return std::all_of(topic_.frames.begin(), topic_.frames.end(),
                       [](const Frame& f) { return f.lines.size() == 1; });
  }
};

/// What only some methods, or an experiment, tell in series.csv: a frame a column.
Topic told_topic(Runs runs) {
  Topic topic{"told",
              "What the method tells",
              "series.csv",
              "Quantities that only this kind of run has.",
              "",
              {"time", "$t$", "s", "\\sqrt{d/g}"},
              {}};
  std::vector<std::string> known{"v_z", "wall_work", "projection_work"};
  for (const auto& column : columns::series) known.emplace_back(column.name);
  for (const auto word : fields::clocks) known.emplace_back(word);
  for (const auto& run : runs) {
    if (run.is_experiment())
      topic.title = "What happened", topic.caption = "Against the time since the surfaces met.";
    const auto table = run.table("series.csv");
    if (!table) continue;
    for (const auto& name : table->header) {
      if (std::find(known.begin(), known.end(), name) != known.end() || !table->is_number(name) ||
          is_flat(table->column(name)) || topic.frames.size() == most_told)
        continue;
      known.push_back(name);
      const Quantity quantity{name, plot::label_from_name(name), "", ""};
      topic.frames.push_back({{quantity}, quantity});
    }
  }
  return topic;
}

/// Distributions of impacts: angles and velocities, of one run by what was hit, of several all together.
std::vector<plot::Panel> impact_panels(Runs runs) {
  std::vector<plot::Panel> panels(2);
  panels[0].x.label = "$\\gamma\\ \\mathrm{mod}\\ \\pi$ (rad)", panels[0].y.label = "probability density";
  panels[1].x.label = Quantity{"", "$|v_n|$", "m/s", "\\sqrt{gd}"}.title(runs.front().units, 2);
  panels[1].y.label = "probability density";
  panels[0].x.min = 0, panels[0].x.max = std::numbers::pi, panels[0].y.min = 0, panels[1].y.min = 0;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto table = runs[k].table("impact_histograms.csv");
    if (!table) continue;
    const auto pair = table->text("pair"), quantity = table->text("quantity");
    const auto x = table->column("x"), value = table->column("value");
    for (std::size_t p = 0; p < 2; ++p)
      for (const char* whom : {"grain", "bed", "all"}) {
        const bool wanted = runs.size() == 1 ? whom != std::string("all") : whom == std::string("all");
        Curve curve{whom, whom == std::string("grain") ? "with grains" : "with the bed", {}, {}, {}};
        for (std::size_t i = 0; wanted && i < x.size(); ++i)
          if (pair[i] == whom && quantity[i] == (p == 0 ? "gamma" : "v_n"))
            curve.x.push_back(x[i]), curve.y.push_back(value[i]);
        if (is_flat(curve.y)) continue;
        if (p == 1)  // a tail that is empty shows nothing
          while (curve.y.back() == 0) curve.x.pop_back(), curve.y.pop_back();
        if (runs.size() > 1) curve.name = runs[k].name, curve.label = view::escaped(runs[k].name);
        auto series = series_of(std::move(curve), plot::Kind::steps);
        if (runs.size() > 1) series.color = static_cast<int>(k);
        panels[p].series.push_back(std::move(series));
      }
  }
  std::erase_if(panels, [](const plot::Panel& p) { return p.series.empty(); });
  return panels;
}

/// First-return map of the angles of impacts: a frame a run.
std::vector<plot::Panel> return_panels(Runs runs, std::string& caption) {
  std::vector<plot::Panel> panels;
  for (const auto& run : runs) {
    if (!run.has("impacts.vtp")) continue;
    const auto points =
        read::parse_points(read::read_parts(run.path / "impacts.vtp"), [](std::string_view name) {
          return name == fields::gamma.name || name == fields::gamma_before.name;
        });
    const auto find = [&](std::string_view name) -> const std::vector<double>* {
      for (const auto& array : points.point_arrays)
        if (array.name == name) return &array.values;
      return nullptr;
    };
    const auto *after = find(fields::gamma.name), *before = find(fields::gamma_before.name);
    if (!after || !before) continue;
    Curve curve{run.name, "", {}, {}, {}};
    for (std::size_t i = 0; i < after->size(); ++i)
      if (std::isfinite((*after)[i]) && std::isfinite((*before)[i]))
        curve.x.push_back((*before)[i]), curve.y.push_back((*after)[i]);
    if (curve.x.empty()) continue;
    const std::size_t stride = curve.x.size() / most_dots + 1;
    if (stride > 1) caption += fmt::format(" Of {} one impact in {}.", run.name, stride);
    thin(curve.x, stride), thin(curve.y, stride);
    plot::Panel panel;
    panel.x.label = "$\\gamma_n$ (rad)", panel.y.label = "$\\gamma_{n+1}$ (rad)";
    if (runs.size() > 1) panel.title = view::escaped(run.name);
    panel.references.push_back({plot::Reference::Kind::diagonal, 0, ""});
    panel.series.push_back(series_of(std::move(curve), plot::Kind::dots));
    panel.legend = plot::Place::off;
    if (runs.size() > 1) panel.series.back().color = static_cast<int>(&run - runs.data());
    panels.push_back(std::move(panel));
  }
  return panels;
}

std::string names_without(Runs runs, const std::string& file) {
  std::vector<std::string> names;
  for (const auto& run : runs)
    if (!run.table(file)) names.push_back(run.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

Gallery make_gallery(Runs runs) {
  Gallery gallery;
  const auto add = [&](const Topic& topic, std::vector<plot::Panel> panels) {
    if (!panels.empty()) gallery.exhibits.push_back(exhibit_of(topic, std::move(panels), runs.size()));
    return !gallery.exhibits.empty() && gallery.exhibits.back().id == topic.id;
  };
  const auto miss = [&](const Topic& topic, const std::string& why) {
    gallery.missing.push_back(
        {topic.title, why + (topic.how.empty() ? "" : "; a scene keeps it with " + topic.how)});
  };
  const auto draw = [&](const Topic& topic) {
    const TopicDrawer drawer(topic, runs);
    if (!drawer.has_tables()) return miss(topic, fmt::format("no {}", topic.file));
    if (!add(topic, drawer.panels()))
      return miss(topic, fmt::format("{} has nothing of it but zeros", topic.file));
    if (const auto without = names_without(runs, topic.file); !without.empty())
      gallery.exhibits.back().caption += fmt::format(" Not kept by {}.", without);
  };
  const bool experiments =
      std::all_of(runs.begin(), runs.end(), [](const RunFiles& r) { return r.is_experiment(); });
  if (experiments) {
    draw(told_topic(runs));
    return gallery;
  }
  for (const auto& topic : topics()) {
    draw(topic);
    if (topic.id != "fields") continue;
    // The impacts stand between what is over the height and what only some runs ask for.
    Topic impacts{"impacts",
                  "Impacts",
                  "impact_histograms.csv",
                  "Distributions of the angle γ at which grains hit each other, and of the normal velocity.",
                  "output.impact_histograms = { from = … }",
                  {},
                  {}};
    if (!add(impacts, impact_panels(runs))) miss(impacts, "no " + impacts.file);
    Topic map{"return",
              "First-return map",
              "impacts.vtp",
              "The angle of an impact against that of the same grain's impact before.",
              "output.impacts = { from = … }",
              {},
              {}};
    auto panels = return_panels(runs, map.caption);
    if (!add(map, std::move(panels)))
      miss(map, "no impacts that follow one another");
    else if (runs.size() == 1)
      gallery.exhibits.back().figure.aspect = 0.8;
  }
  if (auto told = told_topic(runs); !told.frames.empty()) draw(told);
  return gallery;
}

}  // namespace chute::report
