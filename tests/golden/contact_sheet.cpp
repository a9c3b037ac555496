#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "golden.hpp"
#include "image/png.hpp"
#include "tool.hpp"
#include "view/lay_over.hpp"

namespace {
using namespace chute;

/// Pictures in rows on white, each in the middle of its cell.
image::Image sheet_of(const std::vector<image::Image>& pictures, int columns) {
  const int count = static_cast<int>(pictures.size()), rows = (count + columns - 1) / columns;
  std::vector<int> widths(static_cast<std::size_t>(columns), 0), heights(static_cast<std::size_t>(rows), 0);
  const auto cell = [&](int i) {
    return std::pair<int&, int&>{widths[static_cast<std::size_t>(i % columns)],
                                 heights[static_cast<std::size_t>(i / columns)]};
  };
  for (int i = 0; i < count; ++i) {
    const auto& picture = pictures[static_cast<std::size_t>(i)];
    auto [width, height] = cell(i);
    width = std::max(width, picture.width), height = std::max(height, picture.height);
  }
  image::Image sheet(std::accumulate(widths.begin(), widths.end(), 0),
                     std::accumulate(heights.begin(), heights.end(), 0));
  std::fill(sheet.rgba.begin(), sheet.rgba.end(), std::uint8_t{255});
  int left = 0, top = 0;
  for (int i = 0; i < count; ++i) {
    const auto& picture = pictures[static_cast<std::size_t>(i)];
    const auto [width, height] = cell(i);
    view::lay_over(sheet, picture, left + (width - picture.width) / 2, top + (height - picture.height) / 2);
    left += width;
    if (i % columns == columns - 1) left = 0, top += height;
  }
  return sheet;
}

/// Sixteen levels of each colour but for those that fill areas: on plots this halves the bytes, and no eye
/// sees it at the edges of letters and lines.
void thin(image::Image& picture) {
  const auto color = [&](std::size_t i) {
    return picture.rgba[i] << 16 | picture.rgba[i + 1] << 8 | picture.rgba[i + 2];
  };
  std::unordered_map<int, std::size_t> seen;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) ++seen[color(i)];
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    if (seen[color(i)] > picture.rgba.size() / 4 / 300) continue;  // a third of a per cent: an area
    for (std::size_t c = i; c < i + 3; ++c)
      picture.rgba[c] = static_cast<std::uint8_t>((picture.rgba[c] + 8) / 17 * 17);
  }
}

}  // namespace

/// Puts golden pictures on one page: to look at them all, or for the README.
int main(int argc, char** argv) {
  CLI::App app{"Put golden pictures on one page"};
  std::string output;
  std::vector<std::string> names;
  int columns = 3;
  bool small = false;
  app.add_option("output", output, "the page, a PNG")->required();
  app.add_option("names", names, "goldens by name; default all");
  app.add_option("--columns", columns, "pictures side by side")
      ->capture_default_str()
      ->check(CLI::Range(1, 20));
  app.add_flag("--small", small, "fewer colours: a smaller file");
  app.footer("Example: contact_sheet .pictures/figures.png --small band inset steps");
  return golden::run_tool(app, argc, argv, [&] {
    if (names.empty())
      for (const auto& golden : golden::all_goldens()) names.push_back(golden.name);
    std::vector<image::Image> pictures;
    for (const auto& name : names)
      pictures.push_back(image::read_png(std::string(CHUTE_SOURCE_DIR) + "/golden/" + name + ".png"));
    auto sheet = sheet_of(pictures, columns);
    if (small) thin(sheet);
    image::write_png(output, sheet, {{"Software", "chute, contact_sheet"}}, image::small_level);
  });
}
