#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "beds/planes.hpp"
#include "common/error.hpp"
#include "io/grains_file.hpp"

namespace chute::beds {
namespace {

namespace fs = std::filesystem;

/// The columns x and y of a CSV file; lines with # are comments.
std::vector<std::array<double, 2>> places_in_csv(const std::string& file) {
  std::ifstream in(file);
  std::vector<std::array<double, 2>> places;
  std::vector<std::string> names;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    std::istringstream parts(line);
    for (std::string cell; std::getline(parts, cell, ',');) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      continue;
    }
    std::array<double, 2> place{};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto column = std::find(names.begin(), names.end(), k == 0 ? "x" : "y") - names.begin();
      try {
        place[k] = std::stod(cells.at(static_cast<std::size_t>(column)));
      } catch (const std::exception&) {
        throw InputError(fmt::format(
            "{}:{}: no number in a column {}; the first line names the columns, x and y among them", file,
            number, k == 0 ? "x" : "y"));
      }
    }
    places.push_back(place);
  }
  return places;
}

}  // namespace

std::optional<Refusal> PlaneFromFile::misfit(const Site& site) const {
  if (site.dimensions != 3) return Refusal{"bed.kind", "a plane of beads needs dimensions = 3"};
  if (!fs::exists(file)) return Refusal{"bed.file", file + ": no such file"};
  constexpr std::size_t fewest = 3;
  const auto beads = sheet(site).place.size();
  if (beads < fewest)
    return Refusal{"bed.file", fmt::format("{}: it has {} beads, a plane needs at least 3", file, beads)};
  return {};
}

Sheet PlaneFromFile::arrange(const Site&) const {
  Sheet sheet{length(), width(), {}};
  if (fs::path(file).extension() == ".csv") {
    sheet.place = places_in_csv(file);
  } else {
    for (const auto& grain : io::read_grains(file)) sheet.place.push_back({grain.place[0], grain.place[1]});
  }
  for (auto& place : sheet.place) place = sheet.wrapped(place);
  return sheet;
}

}  // namespace chute::beds
