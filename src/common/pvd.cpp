#include "common/pvd.hpp"

#include <fmt/format.h>

namespace chute {

std::string pvd(std::span<const double> times, std::span<const std::string> files) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n";
  for (std::size_t i = 0; i < files.size(); ++i)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times[i], files[i]);
  return text + "  </Collection>\n</VTKFile>\n";
}

}  // namespace chute
