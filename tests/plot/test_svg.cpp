#include <catch2/catch.hpp>
#include <regex>
#include <set>

#include "plot/font_subset.hpp"
#include "plot/fonts.hpp"
#include "plot/layout.hpp"
#include "plot/mathtext.hpp"
#include "plot/svg.hpp"

namespace svg_tests {
using namespace chute::plot;

namespace {

DisplayList page_with(const std::string& text, double angle = 0) {
  DisplayList list;
  list.width = 200, list.height = 50;
  draw_text(list, set_text(text, 10), {20, 30}, Color{}, angle);
  return list;
}

std::vector<std::string> found(const std::string& svg, const char* pattern) {
  const std::regex wanted(pattern);
  std::vector<std::string> all;
  for (std::sregex_iterator at(svg.begin(), svg.end(), wanted), end; at != end; ++at) all.push_back((*at)[1]);
  return all;
}

std::string letters(const std::string& svg) {
  std::string all;
  for (const auto& span : found(svg, "<tspan[^>]*>([^<]*)</tspan>")) all += span;
  return all;
}

}  // namespace

TEST_CASE("SVG text is text: one element per label, all of its letters, special ones escaped") {
  const auto svg = svg_text(page_with("a < b \\& $\\sin\\theta=-0.1\\,\\sqrt{gd}$"), {});
  REQUIRE(found(svg, "(<text )").size() == 1);
  REQUIRE(letters(svg) == "a &lt; b &amp; sinθ=\u22120.1\u221agd");
  REQUIRE(svg_text(page_with("a"), {}).find("rotate") == std::string::npos);
  REQUIRE(svg_text(page_with("a", 1.5707963267948966), {}).find("translate(20 30) rotate(-90)") !=
          std::string::npos);
}

TEST_CASE("letters of an SVG stand where the list puts them") {
  const auto list = page_with("$v_x=2$");
  std::set<std::string> wanted;
  for (const auto& item : list.items)
    if (const auto* run = std::get_if<GlyphRun>(&item))
      for (const auto& glyph : run->glyphs) wanted.insert(std::to_string(std::lround(1000 * glyph.at.x())));
  std::set<std::string> standing;
  for (const auto& x : found(svg_text(list, {}), "<tspan x=\"([0-9.]*)\""))
    standing.insert(std::to_string(std::lround(1000 * std::stod(x))));
  REQUIRE(standing == wanted);  // none follows another by itself here
}

TEST_CASE("an SVG without text carries no font; with text those faces that it uses") {
  DisplayList empty;
  empty.width = empty.height = 10;
  REQUIRE(svg_text(empty, {}).find("font-face") == std::string::npos);
  const auto svg = svg_text(page_with("$v$ = 1"), {});
  REQUIRE(found(svg, "@font-face.*font-style:(\\w+);font-weight:normal").size() == 2);
  REQUIRE(svg_text(page_with("$v$ = 1"), {}) == svg);
}

TEST_CASE("a font's subset is an OpenType file with little more than what was asked for") {
  const auto one = subset_font(Face::italic, {U'v'}), many = subset_font(Face::italic, {U'v', U'x', U'θ'});
  REQUIRE((one.substr(0, 4) == "OTTO" && many.substr(0, 4) == "OTTO"));
  REQUIRE((one.size() < many.size() && many.size() < 6000));
  REQUIRE(subset_font(Face::italic, {U'v'}) == one);
  auto& fonts = Fonts::mine();
  for (char32_t c : {U'v', U'θ', U'1'})
    REQUIRE(character_of(Face::regular, fonts.glyph(Face::regular, c)) == c);
}

TEST_CASE("SVG keeps shapes, dashes, clips; long scatter plots become one picture") {
  DisplayList list;
  list.width = list.height = 100;
  list.items.emplace_back(ClipBegin{{10, 10, 90, 90}});
  list.stroke(Path().move({0, 0}).line({50, 50}), {1, {4, 2}, Cap::round, Join::bevel}, Color::hex(0x0072B2));
  DotsItem dots{Path().circle({0, 0}, 1), {}, Color::hex(0xD55E00)};
  for (int i = 0; i < 50; ++i) dots.at.push_back({10 + 1.5 * i, 50});
  list.items.emplace_back(dots);
  list.items.emplace_back(ClipEnd{});
  auto svg = svg_text(list, {});
  REQUIRE(svg.find(
              "d=\"M0 0L50 50\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1\" stroke-linecap=\"round\" "
              "stroke-linejoin=\"bevel\" stroke-dasharray=\"4 2\"") != std::string::npos);
  REQUIRE(svg.find("<rect x=\"10\" y=\"10\" width=\"80\" height=\"80\"/></clipPath>") != std::string::npos);
  REQUIRE(found(svg, "(<use )").size() == 50);
  auto& many = std::get<DotsItem>(list.items[2]);
  while (many.at.size() <= dots_kept_as_curves) many.at.push_back(many.at[many.at.size() % 50]);
  svg = svg_text(list, {});
  REQUIRE((found(svg, "(<use )").empty() && found(svg, "(<image )").size() == 1));
}

}  // namespace svg_tests
