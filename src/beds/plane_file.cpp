#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "beds/planes.hpp"
#include "common/csv_columns.hpp"
#include "common/error.hpp"
#include "io/grains_file.hpp"

namespace chute::beds {
namespace {

namespace fs = std::filesystem;

/// The columns x and y of a CSV file.
std::vector<std::array<double, 2>> places_in_csv(const std::string& file) {
  const auto columns = read_csv_columns(file, {"x", "y"});
  std::vector<std::array<double, 2>> places;
  for (std::size_t i = 0; i < columns[0].size(); ++i) places.push_back({columns[0][i], columns[1][i]});
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
