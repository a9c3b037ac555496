#include "report/html.hpp"

#include <algorithm>
#include <cassert>

#include "common/base64.hpp"

namespace chute::report {

std::string escape(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else
      out += c;
  }
  return out;
}

std::string data_address(std::string_view type, std::string_view bytes) {
  return "data:" + std::string(type) + ";base64," + base64(bytes);
}

std::string fill(std::string_view form, const std::vector<std::pair<std::string, std::string>>& values) {
  std::string out;
  for (;;) {
    const auto open = form.find("{{");
    const auto close = form.find("}}", open);
    out += form.substr(0, open);
    if (open == std::string_view::npos || close == std::string_view::npos) return out;
    const auto name = form.substr(open + 2, close - open - 2);
    const auto value =
        std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == name; });
    assert(value != values.end());
    out += value->second;
    form.remove_prefix(close + 2);
  }
}

}  // namespace chute::report
