#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// VTK files made by VTK itself, for the readers to read.
namespace vtk_files {

struct Content {
  std::vector<double> points;                          ///< x y z of each
  std::map<std::string, std::vector<double>> scalars;  ///< one value per point
  std::map<std::string, std::vector<double>> vectors;  ///< three per point
  std::map<std::string, std::vector<double>> field;    ///< field data
  std::string units;                                   ///< field data, a text
  std::vector<long long> lines;                        ///< pairs of points
  std::vector<std::vector<long long>> polygons;        ///< corners of each
  std::map<std::string, std::vector<double>>
      cells;  ///< as many values as there are, shared by all cells alike
};

/// Three grains, as chute writes them.
Content three_grains();

enum class Kind { polydata, unstructured, legacy_ascii, legacy_binary, image };
void write(const Content& content, const std::filesystem::path& path, Kind kind = Kind::polydata);

/// An empty folder of its own, removed at the end.
struct Folder {
  std::filesystem::path path;
  Folder();
  ~Folder();
  std::filesystem::path operator/(const std::string& name) const { return path / name; }
};

}  // namespace vtk_files
