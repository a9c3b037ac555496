#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "plot/fonts.hpp"
#include "plot/legend.hpp"
#include "plot/mathtext.hpp"
#include "plot/symbols.hpp"

namespace mathtext_tests {
using namespace chute::plot;

namespace {

std::string letters(const std::string& source) {
  std::string all;
  for (const auto& run : set_text(source, 10).runs) all += run.text;
  return all;
}

std::string message(const std::string& source) {
  try {
    set_text(source, 10);
    return "";
  } catch (const chute::InputError& error) {
    return error.what();
  }
}

const Glyph& glyph_of(const TextBox& box, std::size_t n) {
  for (const auto& run : box.runs) {
    if (n < run.glyphs.size()) return run.glyphs[n];
    n -= run.glyphs.size();
  }
  throw std::out_of_range("glyph");
}

}  // namespace

TEST_CASE("every command of the subset finds its glyph") {
  for (const auto& s : symbols()) {
    INFO(s.name);
    const auto box = set_text("$\\" + std::string(s.name) + "$", 9);
    REQUIRE(box.width > 0);
    REQUIRE(box.runs.size() == 1);
    REQUIRE(box.runs[0].text == encode_utf8(s.character));
  }
  for (const char* accent : {"bar", "hat", "tilde", "dot", "ddot", "vec"})
    for (const char* under : {"x", "v", "\\omega", "B", "{ab}"})
      REQUIRE(set_text(std::string("$\\") + accent + " " + under + "$", 9).ascent >
              set_text(std::string("$") + under + "$", 9).ascent);
}

TEST_CASE("letters of mathematics are italic, digits, units and words upright") {
  const auto face = [](const char* source) { return set_text(source, 9).runs.at(0).face; };
  REQUIRE(face("$v$") == Face::italic);
  REQUIRE(face("$\\theta$") == Face::italic);
  REQUIRE(face("$\\Phi$") == Face::regular);
  REQUIRE(face("$12$") == Face::regular);
  REQUIRE(face("v") == Face::regular);
  REQUIRE(face("$\\mathrm{m/s}$") == Face::regular);
  REQUIRE(face("$\\sin$") == Face::regular);
  REQUIRE(face("$\\mathbf{v}$") == Face::bold);
}

TEST_CASE("text copies out as it reads") {
  REQUIRE(letters("Mean $\\bar{v}_x$ (m/s)") == "Mean v\u0304x (m/s)");
  REQUIRE(letters("$-0.5$") == "\u22120.5");
  REQUIRE(letters("$\\epsilon_{\\max}=0.2$") == "\u03f5max=0.2");
  REQUIRE(letters("5 \\% \\$ \\_") == "5 % $ _");
  REQUIRE(letters("$\\frac12$") == "12");
  REQUIRE(letters("naïve – ±") == "naïve – ±");
}

TEST_CASE("scripts stand where they should and keep 7 points") {
  const auto sub = set_text("$v_x$", 10), super = set_text("$v^2$", 10), both = set_text("$v_x^2$", 10);
  REQUIRE(glyph_of(sub, 1).at.y() > 0);
  REQUIRE(glyph_of(super, 1).at.y() < -2);
  REQUIRE(both.descent > sub.descent - 1e-9);
  REQUIRE(both.ascent >= super.ascent - 1e-9);
  for (double size : {7.0, 8.0, 9.0, 20.0})
    for (const auto& run : set_text("$x_{a_b^c}^{2^n}$", size).runs) REQUIRE(run.size >= 7);
  REQUIRE(set_text("$x_a$", 20).runs[1].size == Approx(14));
  // between the two there is air
  const auto& b = both.runs;
  REQUIRE(b.size() >= 2);
}

TEST_CASE("signs know whether they stand between two things") {
  const double binary = set_text("$a-b$", 10).width - set_text("$a$", 10).width - set_text("$b$", 10).width;
  const double unary = set_text("$-b$", 10).width - set_text("$b$", 10).width;
  REQUIRE(binary > unary + 3);
  REQUIRE(set_text("$x=-1$", 10).width < set_text("$x=a-1$", 10).width);
  REQUIRE(set_text("$a b$", 10).width == Approx(set_text("$ab$", 10).width));  // spaces do not count
  REQUIRE(set_text("$a\\,b$", 10).width > set_text("$ab$", 10).width);
}

TEST_CASE("a slip in a label is named, with the nearest command") {
  REQUIRE(message("$\\thta$") == "text \"$\\thta$\": \\thta is not known, did you mean \\theta?");
  REQUIRE(message("$\\qwertyuiop$") == "text \"$\\qwertyuiop$\": \\qwertyuiop is not known");
  REQUIRE(message("\\theta") == "text \"\\theta\": \\theta stands outside mathematics, write $\\theta$");
  REQUIRE(message("$x") == "text \"$x\": $ is missing");
  REQUIRE(message("$x_{a$") == "text \"$x_{a$\": } is missing");
  REQUIRE(message("$x}$") == "text \"$x}$\": a } without its {");
  REQUIRE(message("$x_$") == "text \"$x_$\": _ lacks what it applies to");
  REQUIRE(message("$x_1_2$") == "text \"$x_1_2$\": two subscripts at one place");
  REQUIRE(message("$\\sqrt$") == "text \"$\\sqrt$\": \\sqrt lacks what it applies to");
  REQUIRE(message("漢") == "text \"漢\": the font STIXGeneral regular lacks the character 漢 (U+6F22)");
  REQUIRE(message("\xff") == "text is not UTF-8");
  REQUIRE(message("$" + std::string(100, '{') + std::string(100, '}') + "$").find("too many braces") !=
          std::string::npos);
}

TEST_CASE("any bytes are set or refused, never a crash") {
  const std::string alphabet = "$\\{}_^ab1.-=(frac sqrt bar\xc3\xa9'~,";
  std::uint32_t state = 1;
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (int k = 0; k < 12; ++k) {
      state = state * 1664525 + 1013904223;
      text += alphabet[(state >> 16) % alphabet.size()];
    }
    try {
      const auto box = set_text(text, 9);
      REQUIRE((box.width < 1e4 && box.ascent >= 0 && box.descent >= 0));
    } catch (const chute::InputError&) {
    }
  }
}

TEST_CASE("names of series become labels") {
  const std::pair<const char*, const char*> pairs[] = {
      {"e_n=0.7", "$e_n=0.7$"},
      {"Phi=2.5", "$\\Phi=2.5$"},
      {"mu=0.5", "$\\mu=0.5$"},
      {"eps_max=0.2", "$\\epsilon_{\\max}=0.2$"},
      {"t_n=1e-5", "$t_n=10^{-5}$"},
      {"k_n=7.32e6", "$k_n=7.32\\times10^{6}$"},
      {"k_s/k_n=2/7", "$k_s/k_n=2/7$"},
      {"v=1 k_s/k_n=1/5", "$v=1$, $k_s/k_n=1/5$"},
      {"R=3mm", "$R=3\\,\\mathrm{mm}$"},
      {"R=3mm fit", "$R=3\\,\\mathrm{mm}$, fit"},
      {"e_n=0.8 fine", "$e_n=0.8$, fine"},
      {"theory", "theory"},
      {"theory corrected Phi=1.75", "theory corrected, $\\Phi=1.75$"},
      {"AB eps=0", "AB, $\\epsilon=0$"},
      {"D_x Phi=3", "$D_x$, $\\Phi=3$"},
      {"omega mu=0.25", "$\\omega$, $\\mu=0.25$"},
      {"v_bf", "$v_{\\mathrm{bf}}$"},
      {"F_s^b", "$F_s^b$"},
      {"e_n^1", "$e_n^1$"},
      {"tau", "$\\tau$"},
      {"v0=3.5", "$v_0=3.5$"},
      {"zeta_0=1e-8", "$\\zeta_0=10^{-8}$"},
      {"gamma_s=20", "$\\gamma_s=20$"},
      {"eq 3.8", "eq 3.8"},
      {"peak 1", "peak 1"},
      {"e_tot", "$e_{\\mathrm{tot}}$"},
      {"event-driven", "event-driven"},
      {"mu=0 e_n=0.7", "$\\mu=0$, $e_n=0.7$"},
      {"hertz-kuwabara-kono fit", "hertz-kuwabara-kono fit"},
      {"costs 5$", "costs 5\\$"}};
  for (const auto& [name, label] : pairs) {
    REQUIRE(label_from_name(name) == label);
    REQUIRE_NOTHROW(set_text(label, 9));
  }
}

TEST_CASE("another family sets letters, and STIXGeneral what it lacks") {
  const int family = font_family("DejaVu Sans");
  CHECK(font_family("DejaVu Sans") == family);
  CHECK(family_name(family) == "DejaVu Sans");
  CHECK_THROWS_WITH(font_family("No Such Grotesk"), Catch::Contains("no font \"No Such Grotesk\""));
  const auto stix = set_text("flow $v_x$", 10);
  const FamilyScope scope(family);
  const auto text = set_text("flow $v_x$", 10);
  CHECK(text.width > 1.05 * stix.width);  // DejaVu is a wide face
  for (const auto& run : text.runs) CHECK(family_of(run.face) == family);
  CHECK(text.runs.at(0).face == in_family(Face::regular, family));
  CHECK(text.runs.at(1).face == in_family(Face::italic, family));
  // a sign that only STIXGeneral has, between two letters: all three keep their places
  auto& fonts = Fonts::mine();
  char32_t sign = 0x2190;
  const auto only_stix = [&](char32_t c) {
    return fonts.has(Face::regular, c) && !fonts.has(in_family(Face::regular, family), c);
  };
  while (sign < 0x1d7ff && !only_stix(sign)) ++sign;
  REQUIRE(only_stix(sign));
  const auto mixed = set_text("a" + encode_utf8(sign) + "b", 10);
  std::string read;
  double last = -1;
  for (const auto& run : mixed.runs) {
    read += run.text;
    for (const auto& glyph : run.glyphs) {
      CHECK(glyph.at.x() > last);
      last = glyph.at.x();
    }
  }
  CHECK(read == "a" + encode_utf8(sign) + "b");
  REQUIRE(mixed.runs.size() == 3);
  CHECK(mixed.runs[1].face == Face::regular);
}

TEST_CASE("a family's scope ends with its block") {
  const auto before = set_text("x", 10).runs.at(0).face;
  {
    const FamilyScope scope(font_family("DejaVu Serif"));
    CHECK(set_text("x", 10).runs.at(0).face != before);
  }
  CHECK(set_text("x", 10).runs.at(0).face == before);
}

}  // namespace mathtext_tests
