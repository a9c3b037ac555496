#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/vtk_files.hpp"

namespace chute::io {

/// Fields of a gas or flow on a grid of equal cells, at one time or averaged up to it.
struct CellFields {
  double time = 0;
  std::array<double, 3> origin{}, side{1, 1, 1};
  std::array<int, 3> count{1, 1, 1};
  struct Field {
    std::string name;
    int components = 1;
    std::vector<double> values;  ///< of cell (x, y, z) at ((z count_y + y) count_x + x) components
  };
  std::vector<Field> fields;
};

/// As VTK image data, whose cells carry the fields.
std::string cells_vti(const CellFields& cells, const RunFacts& facts);

}  // namespace chute::io
