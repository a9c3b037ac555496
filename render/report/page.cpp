#include "report/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/atomic_file.hpp"
#include "common/base64.hpp"
#include "common/error.hpp"
#include "plot/layout.hpp"
#include "plot/style.hpp"
#include "plot/svg.hpp"
#include "report/account.hpp"
#include "report/html.hpp"
#include "report/templates.hpp"
#include "report/words.hpp"

namespace chute::report {
namespace {

constexpr std::size_t largest_table =
    4u << 20;  // bytes; larger ones are named in place of being put into the page

/// Units as running text.
std::string unit_markup(const RunFiles& run, const char* si, const char* reduced) {
  return fmt::format(" <small>{}</small>", run.units == "SI" ? si : reduced);
}
std::string clock_unit(const RunFiles& run) {
  if (run.record.clock != "time") return " " + run.record.clock;
  return run.units == "SI" ? " s" : " √(d/g)";
}

std::string run_color(std::size_t k) {
  return fmt::format("style=\"--run: var(--run{})\"", k % plot::color_count);
}
std::string swatch(std::size_t k) { return fmt::format("<span class=\"swatch\" {}></span>", run_color(k)); }

std::string section(const std::string& title, const std::string& inside) {
  return fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", escape(title), inside);
}

std::string seconds_text(double seconds) {
  if (seconds < 120) return number_text(seconds) + " s";
  if (seconds < 7200) return number_text(std::round(seconds / 6) / 10) + " min";
  return number_text(std::round(seconds / 360) / 10) + " h";
}

/// What is told of a run in a line each: a tile of one run, a row of several.
struct OutcomeLine {
  std::string name;
  std::vector<std::string> values;  ///< HTML, one a run
};

std::vector<OutcomeLine> outcome(const std::vector<RunFiles>& runs) {
  std::vector<OutcomeLine> lines;
  const auto add = [&](const std::string& name, const auto& value_of) {
    OutcomeLine line{name, {}};
    for (const auto& run : runs) line.values.push_back(value_of(run));
    if (std::any_of(line.values.begin(), line.values.end(), [](const auto& v) { return !v.empty(); }))
      lines.push_back(std::move(line));
  };
  const auto mean = [](const Mean& m, const std::string& unit) {
    return m.value ? mean_text(m) + unit : std::string();
  };
  const auto flows = [](const RunFiles& run) {
    return run.record.flow.has_value() && run.record.clock == "time";
  };
  add("Mean velocity downhill", [&](const RunFiles& r) {
    return flows(r) ? mean(r.record.flow->v_x, unit_markup(r, "m/s", "√(gd)")) : "";
  });
  add("Mean spin", [&](const RunFiles& r) {
    return flows(r) ? mean(r.record.flow->omega, unit_markup(r, "rad/s", "√(g/d)")) : "";
  });
  add("Kinetic energy", [&](const RunFiles& r) {
    return flows(r) ? mean(r.record.flow->kinetic, unit_markup(r, "J", "mgd")) : "";
  });
  add("Averages from", [&](const RunFiles& r) {
    return flows(r) ? number_text(r.record.flow->from) + fmt::format(" <small>{}</small>", clock_unit(r))
                    : "";
  });
  add("Ran for", [&](const RunFiles& r) {
    return number_text(r.record.time) + fmt::format(" <small>{}</small>", clock_unit(r));
  });
  add("Steps", [&](const RunFiles& r) {
    return r.record.steps ? number_text(static_cast<double>(r.record.steps)) : "";
  });
  add("Computer time",
      [&](const RunFiles& r) { return r.record.seconds > 0 ? seconds_text(r.record.seconds) : ""; });
  return lines;
}

std::string verdict_line(const RunFiles& run) {
  const auto& record = run.record;
  if (record.end == "running" || !record.why.empty() || record.end == "left physics")
    return fmt::format(
        "<span class=\"pill failed\">{}</span> {}", escape(record.end),
        escape(record.why.empty() ? "the run had not finished when this page was made" : record.why));
  if (!record.flow || record.clock != "time")
    return fmt::format("<span class=\"pill\">{}</span>",
                       escape(record.end.empty() ? "no verdict" : record.end));
  const auto& verdict = record.flow->verdict;
  return fmt::format("<span class=\"pill {}\">{}</span> {}", escape(verdict), escape(verdict),
                     escape(meaning_of(verdict)));
}

std::string table_of(const std::vector<RunFiles>& runs, const std::vector<OutcomeLine>& lines,
                     const std::string& head) {
  std::string html = "<div class=\"card scroll\"><table>\n<thead><tr><th></th>";
  for (std::size_t k = 0; k < runs.size(); ++k)
    html += fmt::format("<th>{}{}</th>", swatch(k), escape(runs[k].name));
  html += "</tr></thead>\n<tbody>\n" + head;
  for (const auto& line : lines) {
    html += fmt::format("<tr><th scope=\"row\">{}</th>", line.name);
    for (const auto& value : line.values) html += fmt::format("<td>{}</td>", value.empty() ? "—" : value);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string summary(const std::vector<RunFiles>& runs) {
  if (runs.size() == 1) {
    std::string html =
        fmt::format("<p class=\"verdict\">{}</p>\n<dl class=\"tiles\">\n", verdict_line(runs[0]));
    for (const auto& line : outcome(runs))
      html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", line.name, line.values[0]);
    return html + "</dl>\n";
  }
  std::string html = "<ul class=\"names\">\n";
  for (std::size_t k = 0; k < runs.size(); ++k)
    html += fmt::format("<li>{}<strong>{}</strong> — {}</li>\n", swatch(k), escape(runs[k].name),
                        escape(runs[k].title));
  return html + "</ul>\n";
}

std::string words_section(const std::vector<RunFiles>& runs) {
  std::string html;
  if (runs.size() > 1) {
    std::vector<OutcomeLine> lines;
    for (const auto& difference : differences(runs)) {
      OutcomeLine line{fmt::format("<code class=\"key\">{}</code>", escape(difference.key)), {}};
      for (const auto& value : difference.values)
        line.values.push_back(value.empty() ? "" : fmt::format("<code>{}</code>", escape(value)));
      lines.push_back(std::move(line));
    }
    html += lines.empty() ? "<p>Their scenes are the same.</p>\n"
                          : "<p>What their scenes have different:</p>\n" + table_of(runs, lines, "");
    html += "<div class=\"columns\" style=\"margin-top: 1rem\">\n";
  }
  for (std::size_t k = 0; k < runs.size(); ++k) {
    html += "<div class=\"card words\">\n";
    if (runs.size() > 1)
      html += fmt::format("<p>{}<strong>{}</strong></p>\n", swatch(k), escape(runs[k].name));
    for (const auto& sentence : scene_in_words(runs[k])) html += fmt::format("<p>{}</p>\n", escape(sentence));
    html += "</div>\n";
  }
  if (runs.size() > 1) html += "</div>\n";
  return section(runs.size() > 1 ? "The scenes" : "The scene", html);
}

std::string outcome_section(const std::vector<RunFiles>& runs) {
  if (runs.size() == 1) return "";
  std::string verdicts = "<tr><th scope=\"row\">Verdict</th>";
  for (const auto& run : runs) verdicts += fmt::format("<td>{}</td>", verdict_line(run));
  return section("What became of them", table_of(runs, outcome(runs), verdicts + "</tr>\n"));
}

std::string times_text(const std::vector<double>& times) {
  return fmt::format("[{}]", fmt::join(times, ","));
}

std::string film_figure(const RunFiles& run, const Film& film, std::size_t k, bool several) {
  if (!film.why_none.empty())
    return fmt::format("<figure class=\"film card\"><p>{}{}</p></figure>\n",
                       several ? swatch(k) + "<strong>" + escape(run.name) + "</strong>: " : "",
                       escape(film.why_none));
  std::string html = fmt::format("<figure class=\"film card\" data-times=\"{}\" data-rate=\"{}\">\n",
                                 times_text(film.times), film.frames_per_second);
  const auto title = escape(several ? run.name : run.title);
  if (!film.light.empty()) {
    html += fmt::format(
        "<video muted playsinline preload=\"auto\" aria-label=\"{}\">"
        "<source media=\"(prefers-color-scheme: dark)\" type=\"video/mp4\" src=\"{}\">"
        "<source type=\"video/mp4\" src=\"{}\"></video>\n",
        title, data_address("video/mp4", film.dark), data_address("video/mp4", film.light));
  } else {
    html += fmt::format("<img alt=\"{}\" src=\"{}\">\n<script type=\"application/json\">[", title,
                        data_address("image/png", film.pictures.front()));
    for (std::size_t i = 0; i < film.pictures.size(); ++i)
      html += fmt::format("{}\"{}\"", i ? "," : "", data_address("image/png", film.pictures[i]));
    html += "]</script>\n";
  }
  if (several)
    html += fmt::format("<figcaption><span>{}{}</span><output></output></figcaption>\n", swatch(k), title);
  else
    html += "<output hidden></output>\n";
  html += "<div class=\"stills\">\n";
  for (const auto& still : film.stills) {
    const auto time = number_text(film.times[still.frame]) + clock_unit(run);
    html += fmt::format(
        "<button type=\"button\" data-time=\"{}\" aria-label=\"Go to {}\"><img alt=\"\" src=\"{}\"><span>{}</span></button>\n",
        film.times[still.frame], time, data_address("image/png", still.png), time);
  }
  return html + "</div>\n</figure>\n";
}

std::string film_section(const Contents& contents) {
  if (contents.films.empty()) return "";
  std::size_t longest = 0;
  std::string html = "<div class=\"films\">\n";
  for (std::size_t k = 0; k < contents.runs.size(); ++k) {
    longest = std::max(longest, contents.films[k].times.size());
    html += film_figure(contents.runs[k], contents.films[k], k, contents.runs.size() > 1);
  }
  html += "</div>\n";
  if (longest > 1)
    html += fmt::format(
        "<div class=\"bar\" data-unit=\"{}\"><button type=\"button\">Play</button>"
        "<input type=\"range\" min=\"0\" max=\"{}\" step=\"1\" value=\"0\" aria-label=\"Time\"><output></output></div>\n",
        clock_unit(contents.runs.front()), longest - 1);
  return section("Film", html);
}

std::string account_section(const std::vector<RunFiles>& runs) {
  std::string html;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto account = account_of(runs[k]);
    if (!account) continue;
    double largest = std::abs(account->residual);
    for (const auto* entries : {&account->in, &account->kept, &account->lost})
      for (const auto& entry : *entries) largest = std::max(largest, std::abs(entry.amount));
    const auto row = [&](const std::string& name, double amount) {
      return fmt::format(
          "<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td class=\"share\" {}><i{} style=\"width: {:.1f}%\"></i></td></tr>\n",
          name, number_text(amount), run_color(k), amount < 0 ? " class=\"less\"" : "",
          largest > 0 ? 100 * std::abs(amount) / largest : 0.0);
    };
    const auto group = [&](const char* title, const std::vector<EnergyAccount::Entry>& entries) {
      std::string rows;
      for (const auto& entry : entries)
        if (entry.amount != 0) rows += row(entry.name, entry.amount);
      return rows.empty() ? rows
                          : fmt::format("<tr class=\"group\"><th colspan=\"3\">{}</th></tr>\n", title) + rows;
    };
    html += "<div class=\"card scroll\">";
    if (runs.size() > 1)
      html += fmt::format("<p>{}<strong>{}</strong></p>\n", swatch(k), escape(runs[k].name));
    html += fmt::format(
        "<table><tbody>\n{}{}{}<tr class=\"group\"><th colspan=\"3\">Not accounted for</th></tr>\n{}</tbody></table></div>\n",
        group("Came in", account->in), group("Gained by what the grains have", account->kept),
        group("Lost", account->lost), row("residual", account->residual));
  }
  if (html.empty()) return "";
  const bool si = runs.front().units == "SI";
  return section("Energy account",
                 fmt::format("<p>From the first row of <code>series.csv</code> to the last, in {}.</p>\n"
                             "<div class=\"columns\">\n{}</div>\n",
                             si ? "J" : "mgd", html));
}

std::string results_section(const std::vector<RunFiles>& runs) {
  std::string html;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto table = runs[k].table("result.csv");
    if (!table || !table->has("name") || !table->has("value")) continue;
    html += "<div class=\"card scroll\">";
    if (runs.size() > 1)
      html += fmt::format("<p>{}<strong>{}</strong></p>\n", swatch(k), escape(runs[k].name));
    html += "<table><tbody>\n";
    const auto names = table->text("name");
    const auto values = table->column("value");
    const auto units = table->has("unit") ? table->text("unit") : std::vector<std::string>(names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
      html += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"number\">{} {}</td></tr>\n",
                          escape(names[i]), number_text(values[i]), escape(units[i]));
    html += "</tbody></table></div>\n";
  }
  return html.empty() ? ""
                      : section("Results of the experiment", "<div class=\"columns\">\n" + html + "</div>\n");
}

/// An exhibit as a card; throws InputError if it cannot be laid out.
std::string exhibit_card(const Exhibit& exhibit, const std::string& prefix) {
  auto figure = exhibit.figure;
  const auto draw = [&](plot::Style style) {
    figure.style = style;
    return data_address("image/svg+xml",
                        plot::svg_text(plot::lay_out(figure).list, {{"Title", exhibit.title}}));
  };
  const auto light = draw(plot::Style::journal), dark = draw(plot::Style::dark);
  return fmt::format(
      "<figure class=\"plot card{0}\" id=\"{1}\">\n<div class=\"head\"><h3>{4}</h3>"
      "<a class=\"get\" download=\"{2}-figure-{1}.csv\" href=\"{3}\">Numbers (CSV)</a></div>\n"
      "<img class=\"light\" alt=\"{4}: {5}\" src=\"{6}\">\n<img class=\"dark\" alt=\"{4}: {5}\" src=\"{7}\">\n"
      "<figcaption>{5}</figcaption>\n</figure>\n",
      figure.panels.size() > 1 ? " wide" : "", escape(exhibit.id), escape(prefix),
      data_address("text/csv;charset=utf-8", exhibit.csv), escape(exhibit.title), escape(exhibit.caption),
      light, dark);
}

std::string figures_section(const Contents& contents, std::vector<Missing>& missing) {
  const auto prefix =
      contents.runs.size() == 1 ? contents.runs[0].path.filename().string() : std::string("comparison");
  std::string html;
  for (const auto& exhibit : contents.gallery.exhibits) {
    try {
      html += exhibit_card(exhibit, prefix);
    } catch (const InputError& error) {
      missing.push_back({exhibit.title, error.what()});
    }
  }
  return html.empty() ? "" : section("Figures", "<div class=\"figures\">\n" + html + "</div>\n");
}

std::string missing_section(const std::vector<Missing>& missing) {
  if (missing.empty()) return "";
  std::string html = "<ul class=\"missing\">\n";
  for (const auto& m : missing) html += fmt::format("<li>{}: {}.</li>\n", escape(m.what), escape(m.how));
  return section("What is not here", html + "</ul>\n");
}

std::string tables_of(const RunFiles& run) {
  std::vector<std::string> items;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(run.path))
    if (entry.is_regular_file() && entry.path().extension() == ".csv") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    const auto name = file.filename().string();
    const auto size = std::filesystem::file_size(file);
    if (size > largest_table)
      items.push_back(fmt::format("{} ({:.1f} MB, in the run directory only)", escape(name),
                                  static_cast<double>(size) / 1e6));
    else
      items.push_back(fmt::format("<a download=\"{0}-{1}\" href=\"{2}\">{1}</a>",
                                  escape(run.path.filename().string()), escape(name),
                                  data_address("text/csv;charset=utf-8", read_file(file))));
  }
  return fmt::format("{}", fmt::join(items, ", "));
}

std::string origin_section(const std::vector<RunFiles>& runs) {
  std::string html;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const auto& run = runs[k];
    const auto& r = run.record;
    html += "<div class=\"card\">\n";
    if (runs.size() > 1) html += fmt::format("<p>{}<strong>{}</strong></p>\n", swatch(k), escape(run.name));
    html += "<dl class=\"facts\">\n";
    const auto fact = [&](const char* name, const std::string& value) {
      if (!value.empty()) html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
    };
    fact("Command", r.command.empty() ? "" : "<code>" + escape(r.command) + "</code>");
    fact("Program", escape(fmt::format("chute {} ({})", r.version, r.commit)));
    fact("Started", escape(r.started) + (r.machine.empty() ? "" : ", on " + escape(r.machine)) +
                        fmt::format(", {} thread{}", r.threads, r.threads == 1 ? "" : "s"));
    fact("Seed", fmt::format("{}", r.seed));
    fact("Time step", r.time_step > 0 ? number_text(r.time_step) + escape(clock_unit(run)) : "");
    fact("Tables", tables_of(run));
    html += fmt::format(
        "</dl>\n<details style=\"margin-top: .8rem\"><summary>The complete scene</summary>\n"
        "<p style=\"margin-top: .6rem\"><a class=\"get\" download=\"{}.toml\" href=\"{}\">scene.toml</a>: "
        "<code>chute run scene.toml</code> gives the same bytes again.</p>\n<pre>{}</pre></details>\n</div>\n",
        escape(run.path.filename().string()), data_address("application/toml", run.scene_text),
        escape(run.scene_text));
  }
  return section("Where it comes from", (runs.size() > 1 ? "<div class=\"columns\">\n" : "") + html +
                                            (runs.size() > 1 ? "</div>\n" : ""));
}

}  // namespace

std::string page_of(const Contents& contents) {
  const auto& runs = contents.runs;
  std::vector<std::string> names;
  for (const auto& run : runs) names.push_back(run.name);
  const auto heading = runs.size() == 1 ? runs[0].title : fmt::format("{} runs compared", runs.size());
  auto missing = contents.gallery.missing;
  const auto figures = figures_section(contents, missing);
  const auto body = words_section(runs) + film_section(contents) + outcome_section(runs) +
                    account_section(runs) + results_section(runs) + figures + missing_section(missing) +
                    origin_section(runs);
  return fill(page_html, {{"title", escape(fmt::format("{} — chute", heading))},
                          {"css", page_css},
                          {"js", page_js},
                          {"over", escape(fmt::format("chute report · {}", fmt::join(names, ", ")))},
                          {"heading", escape(heading)},
                          {"summary", summary(runs)},
                          {"body", body},
                          {"footer", escape(contents.made_by) +
                                         " made this page. It needs no network and no file beside it."}});
}

}  // namespace chute::report
