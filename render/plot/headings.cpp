#include "plot/headings.hpp"

#include <string>

#include "plot/axes.hpp"

namespace chute::plot {
std::string heading(const Panel& p) {
  std::string text = p.label.empty() ? "" : "(" + p.label + ")";
  for (const auto* part : {&p.title, &p.parameters})
    if (!part->empty())
      text += (text.empty() ? "" : part == &p.title || p.title.empty() ? " " : ", ") + *part;
  return text;
}

std::vector<TextBox> heading_lines(const Panel& panel, double size, double width) {
  const auto text = heading(panel);
  std::vector<TextBox> lines;
  if (text.empty()) return lines;
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const auto comma = text.find(", ", at);
    const auto end = comma == std::string::npos ? text.size() : comma + 1;
    const auto part = text.substr(at, end - at);
    const auto longer = line.empty() ? part : line + " " + part;
    if (!line.empty() && set_text(longer, size).width > width) {
      lines.push_back(set_to_fit(line, size, width));
      line = part;
    } else {
      line = longer;
    }
    at = comma == std::string::npos ? text.size() : comma + 2;
  }
  lines.push_back(set_to_fit(line, size, width));
  return lines;
}

}  // namespace chute::plot
