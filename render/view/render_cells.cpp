#include "view/render_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "image/png.hpp"
#include "plot/draw.hpp"
#include "plot/layout.hpp"
#include "plot/legend.hpp"
#include "plot/map.hpp"
#include "plot/style.hpp"
#include "read/image_data.hpp"
#include "view/movie.hpp"

namespace chute::view {
namespace fs = std::filesystem;
namespace {

/// A field in the plane: what is drawn.
struct Slab {
  std::vector<double> x, y, values;
  std::string units, clock;
  std::optional<double> time;
  bool space = false;  ///< it was averaged over y, and y is z
};

std::vector<double> places(const read::GridField& f, std::size_t k) {
  std::vector<double> at;
  for (int i = 0; i < f.count[k]; ++i) at.push_back(f.first[k] + i * f.step[k]);
  return at;
}

/// As it lies in the plane; of a field in space the mean over y of what is known.
Slab flattened(const read::GridField& f) {
  const std::size_t up = f.count[2] > 1 ? 2 : 1;
  const auto nx = static_cast<std::size_t>(f.count[0]), ny = static_cast<std::size_t>(f.count[1]),
             nz = static_cast<std::size_t>(f.count[2]);
  Slab slab{places(f, 0), places(f, up), {}, f.units, f.clock, f.time, up == 2};
  if (up == 1) {
    slab.values = f.values;
    return slab;
  }
  for (std::size_t z = 0; z < nz; ++z)
    for (std::size_t x = 0; x < nx; ++x) {
      double sum = 0, known = 0;
      for (std::size_t y = 0; y < ny; ++y)
        if (const double v = f.values[(z * ny + y) * nx + x]; std::isfinite(v)) sum += v, ++known;
      slab.values.push_back(known > 0 ? sum / known : plot::unknown);
    }
  return slab;
}

/// The field that is drawn if none is named.
std::string usual_field(const read::ImageData& data, const fs::path& path) {
  std::string first;
  for (const auto* arrays : {&data.cell_arrays, &data.point_arrays})
    for (const auto& a : *arrays) {
      if (a.name == "density") return a.name;
      if (first.empty()) first = a.name;
    }
  if (first.empty()) throw InputError(path.string() + ": holds no field");
  return first;
}

std::string title_of(const std::string& field, const std::string& units) {
  struct Known {
    std::string_view name, label, reduced, si;
  };
  static constexpr std::array<Known, 6> known{
      {{"density", "density $\\rho$", "", ""},
       {"packing_fraction", "packing fraction $\\phi$", "", ""},
       {"temperature", "temperature $T$", "mgd", "J"},
       {"temperature_rotation", "temperature of rotation", "mgd", "J"},
       {"number", "grains in a cell", "", ""},
       {"velocity", "speed of flow", "\\sqrt{gd}", "m/s"}}};
  const auto array = field.substr(0, field.rfind(':'));
  for (const auto& k : known) {
    if (k.name != array) continue;
    std::string text(k.label);
    if (field.size() > array.size() && field.back() != 'e') text = fmt::format("$v_{}$", field.back());
    if (units == "reduced" && !k.reduced.empty()) return fmt::format("{} (${}$)", text, k.reduced);
    if (units == "SI" && !k.si.empty()) return fmt::format("{} ({})", text, k.si);
    return text;
  }
  return plot::label_from_name(field);
}

/// All that pictures of one run have in common.
struct Look {
  std::string field;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double x_low = low, x_high = -low, y_low = low, y_high = -low;
};

plot::Figure figure_of(const Slab& slab, const Look& look, const FrameStyle& style, double dpi) {
  plot::Figure figure;
  figure.style = style.background == Background::dark ? plot::Style::dark : plot::Style::journal;
  figure.width = style.width * 72 / dpi / plot::points_per_mm;
  figure.height = style.height * 72 / dpi / plot::points_per_mm;
  auto& panel = figure.panels.emplace_back();
  const std::string unit = slab.units == "reduced" ? " ($d$)" : slab.units == "SI" ? " (m)" : "";
  panel.x.label = "$x$" + unit;
  panel.y.label = (slab.space ? "$z$" : "$y$") + unit;
  panel.x.min = look.x_low, panel.x.max = look.x_high, panel.y.min = look.y_low, panel.y.max = look.y_high;
  if (slab.time)
    panel.title = slab.clock.empty() ? fmt::format("$t = {:.6g}$", *slab.time)
                                     : fmt::format("{:.6g} {}", *slab.time, slab.clock);
  auto& map = panel.map.emplace();
  map.x = slab.x, map.y = slab.y, map.values = slab.values;
  map.low = look.low, map.high = look.high;
  map.diverging = !style.map.empty() ? style.map.starts_with("rdbu") : look.low < 0 && look.high > 0;
  map.label = title_of(look.field, slab.units);
  return figure;
}

/// Keeps lengths along both axes alike, unless the field is much longer than high: then it fills the picture.
void keep_shape(plot::Figure& figure, const Look& look) {
  const double shape = (look.y_high - look.y_low) / (look.x_high - look.x_low);
  constexpr double flattest = 0.15, steepest = 3;
  if (shape < flattest || shape > steepest) return;
  const plot::Layout first = plot::lay_out(figure);
  for (const auto& box : first.boxes) {
    if (box.kind != plot::Box::Kind::frame) continue;
    const double now = box.rect.height() / box.rect.width();
    auto& panel = figure.panels[0];
    // The range that is not filled is shown empty.
    if (now > shape) {
      const double more = (look.x_high - look.x_low) * (now - shape) / 2;
      panel.y.min = *panel.y.min - more, panel.y.max = *panel.y.max + more;
    } else {
      const double more = (look.y_high - look.y_low) * (1 / now - 1 / shape) / 2;
      panel.x.min = *panel.x.min - more, panel.x.max = *panel.x.max + more;
    }
    return;
  }
}

}  // namespace

bool are_cells(const std::vector<read::FrameFile>& frames) {
  return std::any_of(frames.begin(), frames.end(), [](const auto& f) {
    const auto extension = f.path.extension();
    const bool packed = extension == ".gz" || extension == ".zst";
    const auto kind = packed ? f.path.stem().extension() : extension;
    return kind == ".vti" || kind == ".pvti";
  });
}

RenderReport render_cells(const RenderJob& job, const std::vector<read::FrameFile>& frames,
                          const std::vector<std::size_t>& numbers) {
  constexpr double dpi = 200;
  const auto& style = job.style;
  for (const auto& frame : frames)
    if (!frame.more.empty())
      throw InputError(fmt::format("{}: a grid in {} parts of one time; a .pvti file names parts of a grid",
                                   frame.path.string(), 1 + frame.more.size()));
  const auto load = [&](std::size_t i, const std::string& field) {
    const auto data = read::read_image_data(frames[i].path);
    auto slab = flattened(read::field_of(data, field, frames[i].path));
    if (frames[i].time) slab.time = frames[i].time;
    return slab;
  };
  Look look;
  look.field = !style.color.empty() ? style.color
                                    : usual_field(read::read_image_data(frames[numbers.front()].path),
                                                  frames[numbers.front()].path);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto slab = load(i, look.field);
    const auto ex = plot::cell_edges(slab.x), ey = plot::cell_edges(slab.y);
    look.x_low = std::min(look.x_low, ex.front()), look.x_high = std::max(look.x_high, ex.back());
    look.y_low = std::min(look.y_low, ey.front()), look.y_high = std::max(look.y_high, ey.back());
    for (const double v : slab.values)
      if (std::isfinite(v)) look.low = std::min(look.low, v), look.high = std::max(look.high, v);
    if (job.progress) job.progress("reading", i + 1, frames.size());
  }
  if (style.range) look.low = style.range->first, look.high = style.range->second;
  if (!(look.high > look.low))
    look.high =
        std::min(look.low + std::max(1.0, std::abs(look.low) / 2), std::numeric_limits<double>::max());
  std::optional<Movie> movie;
  if (!job.movie.empty()) {
    if (Movie::kind_of(job.movie) == Movie::Kind::gif)
      throw InputError(job.movie.string() + ": maps make .mp4 and .png movies");
    movie.emplace(job.movie, style.width, style.height, job.frames_per_second,
                  palette_of(style.background).ground);
  }
  if (!job.output.empty()) {
    std::error_code error;
    fs::create_directories(job.output, error);
    if (error) throw WorkError(fmt::format("{}: cannot be made: {}", job.output.string(), error.message()));
    remove_leftovers(job.output);
  }
  RenderReport report;
  for (const auto number : numbers) {
    auto figure = figure_of(load(number, look.field), look, style, dpi);
    keep_shape(figure, look);
    const auto list = plot::lay_out(figure).list;
    ++report.drawn;
    if (job.progress) job.progress("drawing", static_cast<std::size_t>(report.drawn), numbers.size());
    if (job.format != StillFormat::png) {
      const bool is_pdf = job.format == StillFormat::pdf;
      const auto path = job.output / fmt::format("{:06}.{}", number, is_pdf ? "pdf" : "svg");
      is_pdf ? plot::draw_pdf(list, path) : plot::draw_svg(list, path);
      continue;
    }
    const auto picture = plot::rasterise(list, dpi);
    if (!job.output.empty())
      image::write_png(job.output / fmt::format("{:06}.png", number), picture,
                       {{"Software", "chute"}, {"Source", frames[number].path.filename().string()}});
    if (movie) movie->add(picture);
  }
  if (movie) movie->finish();
  return report;
}

}  // namespace chute::view
