#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "image/compare.hpp"
#include "image/png.hpp"
#include "plot/draw.hpp"
#include "plot/layout.hpp"

namespace back_ends_tests {
using namespace chute;
using namespace chute::plot;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / ("chute-plot-" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

Figure specimen() {
  Figure figure;
  figure.width = 178;
  figure.panels.resize(2);
  int p = 0;
  for (auto& panel : figure.panels) {
    panel.label = p++ ? "b" : "a";
    panel.x.label = "$\\sin\\theta$", panel.y.label = "$\\bar{v}_x\\ (\\sqrt{gd})$";
    if (p == 2) panel.y.scale = Scale::log;
    int k = 0;
    for (Kind kind :
         {Kind::both, Kind::markers, Kind::line, Kind::band, Kind::bars, Kind::steps, Kind::dots}) {
      Series s;
      s.name = "e_n=0." + std::to_string(++k), s.kind = kind;
      for (int i = 1; i <= 12; ++i) {
        s.x.push_back(i / 12.0), s.y.push_back(0.1 * k + std::pow(i / 12.0, k)),
            s.y_err.push_back(0.03 + 0.002 * i);
      }
      panel.series.push_back(s);
    }
    panel.references = {{Reference::Kind::diagonal, 0, "$y=x$"}};
  }
  return figure;
}

DisplayList many_dots(int n) {
  Figure figure;
  figure.panels.resize(1);
  Series s;
  s.name = "impacts", s.kind = Kind::dots;
  std::uint32_t state = 5;
  const auto next = [&] { return (state = state * 1664525 + 1013904223) / 4294967296.0; };
  for (int i = 0; i < n; ++i) s.x.push_back(next() + next()), s.y.push_back(next() + next());
  figure.panels[0].series = {s};
  return lay_out(figure).list;
}

std::string output_of(const std::string& command) {
  std::string out;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  REQUIRE(pipe);
  char buffer[4096];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) out.append(buffer, n);
  REQUIRE(::pclose(pipe) == 0);
  return out;
}

/// Mean of (255 - value) over the picture and its colours: how much ink.
double mean_ink(const image::Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    if (i % 4 != 3) sum += 255 - image.rgba[i];
  return sum / (0.75 * static_cast<double>(image.rgba.size()));
}

/// Largest difference of the mean values of blocks of 8 x 8 pixels, of 255: what is left when edges, which
/// two rasterisers round differently, are averaged away. A glyph, a dash or a tick too many shows here.
double worst_block(const image::Image& a, const image::Image& b) {
  double worst = 0;
  for (int y0 = 0; y0 + 8 <= a.height; y0 += 4)
    for (int x0 = 0; x0 + 8 <= a.width; x0 += 4) {
      double sum = 0;
      for (int y = y0; y < y0 + 8; ++y)
        for (int x = x0; x < x0 + 8; ++x)
          for (int c = 0; c < 3; ++c) sum += double(a.pixel(x, y)[c]) - b.pixel(x, y)[c];
      worst = std::max(worst, std::abs(sum) / (3 * 64));
    }
  return worst;
}

}  // namespace

TEST_CASE("two independent rasterisers agree on a figure") {
  // Both average over samples, on different grids. Measured when this was written: RMS 2.0 and 2.2 of 255,
  // SSIM 0.9989, worst block 17.6 and 16.3 (a hairline that lies on quarters of a pixel here and on
  // fifteenths there).
  for (double dpi : {150.0, 300.0}) {
    auto list = lay_out(specimen()).list;
    const auto mesa = rasterise(list, dpi), cairo = rasterise_by_cairo(list, dpi);
    const auto c = image::compare(cairo, mesa);
    INFO(c.summary() << ", worst block " << worst_block(cairo, mesa));
    REQUIRE(c.same_size);
    CHECK(c.rms < 4);
    CHECK(c.ssim > 0.995);
    CHECK(worst_block(cairo, mesa) < 25);
    CHECK(mean_ink(mesa) == Approx(mean_ink(cairo)).epsilon(0.01));
    // and the measure sees one glyph more or less
    for (auto& item : list.items)
      if (auto* run = std::get_if<GlyphRun>(&item)) {
        run->glyphs[0].at.y() += 1000;
        break;
      }
    CHECK(worst_block(rasterise_by_cairo(list, dpi), mesa) > 30);
  }
}

TEST_CASE("every back end gives the same bytes again") {
  Folder folder;
  const Metadata metadata{{"Title", "fig-4-05"}, {"Software", "chute"}, {"Source", "scenes/fig-4-05.toml"}};
  const auto list = lay_out(specimen()).list;
  for (const char* end : {"png", "pdf", "svg"}) {
    const auto first = folder.path / (std::string("a.") + end),
               second = folder.path / (std::string("b.") + end);
    for (const auto& path : {first, second}) {
      if (end == std::string("png")) draw_png(list, path, 100, metadata);
      if (end == std::string("pdf")) draw_pdf(list, path, metadata);
      if (end == std::string("svg")) draw_svg(list, path, metadata);
    }
    REQUIRE(read_file(first) == read_file(second));
    REQUIRE(read_file(first).size() > 1000);
  }
  REQUIRE(read_file(folder.path / "a.pdf").find("CreationDate") == std::string::npos);
  REQUIRE(read_file(folder.path / "a.svg").find("<title>fig-4-05</title>") != std::string::npos);
  REQUIRE(image::read_png_text(folder.path / "a.png").at("Source") == "scenes/fig-4-05.toml");
}

TEST_CASE("a PDF has the page's size, embedded fonts, and text that can be copied") {
  Folder folder;
  const auto path = (folder.path / "a.pdf").string();
  const auto list = lay_out(specimen()).list;
  draw_pdf(list, path, {{"Title", "Velocity, θ"}, {"Software", "chute 0.1"}, {"Source", "x.toml"}});
  if (std::string(PDFFONTS).find("NOTFOUND") != std::string::npos) return;
  const auto fonts = output_of(PDFFONTS " " + path);
  REQUIRE(fonts.find("STIXGeneral-Italic") != std::string::npos);
  REQUIRE(fonts.find(" no ") == std::string::npos);  // embedded, subset, with Unicode: yes yes yes
  const auto text = output_of(PDFTOTEXT " -layout " + path + " -");
  for (const char* word : {"sin θ", "v̄", "en = 0.3", "(a)", "(b)", "0.2"}) {
    INFO(word << " in " << text);
    REQUIRE(text.find(word) != std::string::npos);
  }
  const auto info = output_of(PDFINFO " " + path);
  char size[64];
  std::snprintf(size, sizeof size, "%.5g x %.5g", list.width, list.height);
  REQUIRE(info.find("Velocity, θ") != std::string::npos);
  REQUIRE(info.find("chute 0.1") != std::string::npos);
  REQUIRE(info.find("Source: x.toml") != std::string::npos);
  REQUIRE(info.find(std::string("Page size:       ") + std::to_string(list.width).substr(0, 5)) !=
          std::string::npos);
}

TEST_CASE("100,000 dots: pixels within 2 s of work, and a small PDF") {
  Folder folder;
  const auto list = many_dots(100000);
  const auto start = std::clock();  // of the processor: other work on the machine does not count
  draw_png(list, folder.path / "a.png");
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  INFO(seconds << " s");
  REQUIRE(seconds < 2.0);
  draw_pdf(list, folder.path / "a.pdf");
  draw_svg(list, folder.path / "a.svg");
  REQUIRE(fs::file_size(folder.path / "a.pdf") < 2000000);
  REQUIRE(fs::file_size(folder.path / "a.svg") < 4000000);
  draw_pdf(many_dots(2000), folder.path / "b.pdf");
  REQUIRE(read_file(folder.path / "b.pdf").find("/Subtype /Image") == std::string::npos);
  REQUIRE(read_file(folder.path / "a.pdf").find("/Subtype /Image") != std::string::npos);
}

TEST_CASE("a folder that does not exist is a failure of the work") {
  const auto list = many_dots(10);
  REQUIRE_THROWS_AS(draw_png(list, "/nonexistent-folder/a.png"), WorkError);
  REQUIRE_THROWS_AS(draw_pdf(list, "/nonexistent-folder/a.pdf"), WorkError);
  REQUIRE_THROWS_AS(draw_svg(list, "/nonexistent-folder/a.svg"), WorkError);
}

}  // namespace back_ends_tests
