#include "read/image_data.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "read/byte_stream.hpp"
#include "read/xml_check.hpp"

namespace chute::read {

bool is_image_data(std::string_view bytes) {
  const auto type = xml_head(bytes).type;
  return type == "ImageData" || type == "PImageData";
}

ImageData read_image_data(const std::filesystem::path& path) {
  return parse_image_data(read_unpacked(path), path);
}

GridField field_of(const ImageData& data, const std::string& name, const std::filesystem::path& path) {
  std::string array = name;
  int component = -1;
  if (const auto colon = name.rfind(':'); colon != std::string::npos) {
    const auto which = name.substr(colon + 1);
    array = name.substr(0, colon);
    component = which == "x" ? 0 : which == "y" ? 1 : which == "z" ? 2 : -1;
    if (component < 0 && which != "magnitude")
      throw InputError(
          fmt::format("\"{}\": \":{}\" is no component, allowed: x, y, z, magnitude", name, which));
  }
  const auto take = [&](const PointArray& found, bool of_cells) {
    GridField field;
    field.units = data.units, field.clock = data.clock, field.time = data.time;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool cells = of_cells && data.points[k] > 1;
      field.count[k] = cells ? data.points[k] - 1 : data.points[k];
      field.step[k] = data.spacing[k];
      field.first[k] = data.origin[k] + (cells ? 0.5 * data.spacing[k] : 0);
    }
    if (component >= found.components)
      throw InputError(fmt::format("{}: \"{}\" has {} component{}", path.string(), array, found.components,
                                   found.components > 1 ? "s" : ""));
    const std::size_t n = found.values.size() / static_cast<std::size_t>(found.components);
    for (std::size_t i = 0; i < n; ++i) {
      double square = 0;
      for (int c = 0; c < found.components; ++c) square += found.at(i, c) * found.at(i, c);
      field.values.push_back(found.components == 1 ? found.at(i)
                             : component >= 0      ? found.at(i, component)
                                                   : std::sqrt(square));
    }
    return field;
  };
  for (const auto& a : data.cell_arrays)
    if (a.name == array) return take(a, true);
  for (const auto& a : data.point_arrays)
    if (a.name == array) return take(a, false);
  std::vector<std::string> known;
  for (const auto& a : data.cell_arrays) known.push_back(a.name);
  for (const auto& a : data.point_arrays) known.push_back(a.name);
  const auto hint = nearest(array, known);
  std::string all;
  for (const auto& k : known) all += (all.empty() ? "" : ", ") + k;
  throw InputError(fmt::format("{}: no field \"{}\"{}; there are: {}", path.string(), array,
                               hint.empty() ? "" : ", did you mean \"" + hint + "\"?",
                               all.empty() ? "none" : all));
}

}  // namespace chute::read
