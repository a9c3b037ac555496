#include "app/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

#include "common/error.hpp"
#include "common/toml_reader.hpp"

namespace chute::app {

std::vector<double> numbers(const std::string& option, const std::string& text, char separator,
                            const char* expected) {
  std::vector<double> values;
  std::size_t from = 0;
  for (;;) {
    const auto to = std::min(text.find(separator, from), text.size());
    double value = std::numeric_limits<double>::quiet_NaN();
    const char* const end = text.data() + to;
    const auto [stop, error] = std::from_chars(text.data() + from, end, value);
    if (to > from && (error != std::errc() || stop != end))
      throw InputError(fmt::format("{} {}: expected {}", option, text, expected));
    values.push_back(value);
    if (to == text.size()) return values;
    from = to + 1;
  }
}

void require(bool holds, const std::string& option, const std::string& text, const char* expected) {
  if (!holds) throw InputError(fmt::format("{} {}: expected {}", option, text, expected));
}

std::size_t choice(const std::string& option, const std::string& word,
                   const std::vector<std::string>& words) {
  const auto found = std::ranges::find(words, word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  const auto hint = nearest(word, words);
  throw InputError(fmt::format("{} {}: not known{}, allowed: {}", option, word,
                               hint.empty() ? "" : fmt::format(", did you mean {}?", hint),
                               fmt::join(words, ", ")));
}

namespace {
std::string number_that(bool (*holds)(double), const std::string& text, const char* must) {
  std::istringstream in(text);
  double x = 0;
  if (in >> x && in.eof() && std::isfinite(x) && holds(x)) return "";
  return text + " is not allowed, must be a number " + must;
}
}  // namespace

std::string positive(const std::string& text) {
  return number_that([](double x) { return x > 0; }, text, "> 0");
}
std::string not_negative(const std::string& text) {
  return number_that([](double x) { return x >= 0; }, text, ">= 0");
}

bool all_given(const std::vector<double>& values) {
  return std::none_of(values.begin(), values.end(), [](double x) { return std::isnan(x); });
}

std::pair<int, int> read_size(const std::string& text, double dpi) {
  constexpr const char* expected = "WIDTHxHEIGHT in pixels, such as 1920x1080; or with --dpi in mm, 86x60mm";
  const bool in_print = text.ends_with("mm") && dpi > 0;
  auto sides = numbers("--size", in_print ? text.substr(0, text.size() - 2) : text, 'x', expected);
  constexpr double mm_per_inch = 25.4;
  if (in_print)
    for (double& side : sides) side = std::round(side / mm_per_inch * dpi);
  require(sides.size() == 2 && all_given(sides) && sides[0] == std::floor(sides[0]) &&
              sides[1] == std::floor(sides[1]) && std::abs(sides[0]) < 1e6 && std::abs(sides[1]) < 1e6,
          "--size", text, expected);
  return {static_cast<int>(sides[0]), static_cast<int>(sides[1])};
}

}  // namespace chute::app
