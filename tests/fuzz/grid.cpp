#include "read/image_data.hpp"
#include "targets.hpp"

void chute::fuzz::grid(std::string_view bytes) {
  const auto data = read::parse_image_data(std::string(bytes), "grid.vti");
  for (const auto* arrays : {&data.cell_arrays, &data.point_arrays})
    for (const auto& array : *arrays) read::field_of(data, array.name, "grid.vti");
}
