#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "plot/legend.hpp"
#include "plot/symbols.hpp"

namespace chute::plot {
namespace {

bool is_greek(const std::string& word) {
  const auto* symbol = find_symbol(word);
  return symbol && ((symbol->character >= 0x391 && symbol->character <= 0x3c9) ||
                    symbol->character == 0x3d5 || symbol->character == 0x3f5);
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (char c : text)
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// The part before the first _ or ^: a Greek name, or one letter ("t0" counts as t with subscript 0). Empty
/// if it is no symbol.
std::string stem(const std::string& word) {
  if (word == "eps" || word == "epsilon") return "\\epsilon";
  if (is_greek(word)) return "\\" + word;
  if (word.size() == 1 && std::isalpha(static_cast<unsigned char>(word[0]))) return word;
  if (word.size() == 2 && std::isalpha(static_cast<unsigned char>(word[0])) &&
      std::isdigit(static_cast<unsigned char>(word[1])))
    return fmt::format("{}_{}", word[0], word[1]);
  return "";
}

std::string script(const std::string& word) {
  if (word.size() == 1) return word;
  if (is_function_name(word) || is_greek(word)) return "{\\" + word + "}";
  if (std::all_of(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c); }))
    return "{" + word + "}";
  return "{\\mathrm{" + word + "}}";
}

/// "k_n" -> k_n, "eps_max" -> \epsilon_{\max}, "F_s^b" -> F_s^b; empty if the word is no symbol.
std::string symbol(const std::string& word) {
  const auto cut = word.find_first_of("_^");
  std::string out = stem(word.substr(0, cut));
  if (out.empty()) return "";
  if (cut != std::string::npos && out.find('_') != std::string::npos) return "";
  for (std::size_t at = cut; at != std::string::npos && at < word.size();) {
    const auto next = word.find_first_of("_^", at + 1);
    const auto part = word.substr(at + 1, next == std::string::npos ? next : next - at - 1);
    if (part.empty() ||
        std::any_of(part.begin(), part.end(), [](unsigned char c) { return !std::isalnum(c); }))
      return "";
    out += word[at] + script(part);
    at = next;
  }
  return out;
}

/// "k_s/k_n" as well, and "sin(theta)".
std::string quotient(const std::string& word) {
  std::string out;
  if (const auto open = word.find('('); open != std::string::npos && word.ends_with(')')) {
    const auto argument = symbol(word.substr(open + 1, word.size() - open - 2));
    const auto function = word.substr(0, open);
    return argument.empty() || !is_function_name(function) ? "" : "\\" + function + argument;
  }
  for (const auto& part : split(word, '/')) {
    const auto one = symbol(part);
    if (one.empty()) return "";
    out += (out.empty() ? "" : "/") + one;
  }
  return out;
}

/// "1e-5" -> 10^{-5}, "7.3e6" -> 7.3\times10^{6}, "3mm" -> 3\,\mathrm{mm}; other values as they are.
std::string number(const std::string& value) {
  std::size_t end = 0;
  try {
    std::stod(value, &end);
  } catch (const std::exception&) {
    const auto as_symbol = quotient(value);
    return as_symbol.empty() ? "\\text{" + value + "}" : as_symbol;
  }
  const auto digits = value.substr(0, end);
  auto rest = value.substr(end);
  const auto e = digits.find_first_of("eE");
  std::string out = digits;
  if (e != std::string::npos && digits.find_first_of("xX") == std::string::npos) {
    const auto mantissa = digits.substr(0, e);
    out = (mantissa == "1" ? "" : mantissa + "\\times") +
          fmt::format("10^{{{}}}", std::stoi(digits.substr(e + 1)));
  }
  if (rest.empty()) return out;
  if (rest == "deg" || rest == "°") return out + "\\degree";
  const bool unit = std::all_of(rest.begin(), rest.end(), [](unsigned char c) { return std::isalpha(c); });
  return unit ? out + "\\,\\mathrm{" + rest + "}" : out + rest;  // "2/7"
}

std::string escaped(const std::string& word) {
  std::string out;
  for (char c : word) out += (c == '$' || c == '\\' ? std::string("\\") : "") + c;
  return out;
}

}  // namespace

std::string label_from_name(const std::string& name) {
  std::string label;
  bool before_was_value = false;
  for (const auto& token : split(name, ' ')) {
    if (token.empty()) continue;
    const auto equals = token.find('=');
    std::string text;
    bool value = false;
    if (equals != std::string::npos && equals > 0 && equals + 1 < token.size()) {
      const auto key = quotient(token.substr(0, equals));
      value = !key.empty();
      if (value) text = "$" + key + "=" + number(token.substr(equals + 1)) + "$";
    } else if (token.size() > 1 || name.size() == 1) {  // a lone letter among words is a word
      const auto one = quotient(token);
      if (!one.empty() &&
          (token.find_first_of("_^/") != std::string::npos || is_greek(token) || name == token))
        text = "$" + one + "$";
    }
    if (text.empty()) text = escaped(token);
    if (!label.empty()) label += value || before_was_value ? ", " : " ";
    label += text;
    before_was_value = value;
  }
  return label;
}

}  // namespace chute::plot
