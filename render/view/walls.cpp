#include "view/walls.hpp"

#include <array>
#include <map>
#include <tuple>

namespace chute::view {
namespace {

/// A wall of so many faces is round: boxes and hoppers are made of walls of one face each.
constexpr std::size_t faces_of_a_round_wall = 8;

/// By how much what is to be seen may grow along each axis: half a drum would not look like one, a silo whose top is cut off does.
constexpr double most_growth_round = 3, most_growth = 2;

std::map<int, std::vector<const read::WallPiece*>> by_wall(std::span<const read::WallPiece> walls) {
  std::map<int, std::vector<const read::WallPiece*>> faces;
  for (const auto& piece : walls) faces[piece.wall].push_back(&piece);
  return faces;
}

}  // namespace

std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> edges_of(std::span<const read::WallPiece> walls) {
  // Corners are the same numbers where faces share them: a file holds each once.
  using Key = std::array<double, 3>;
  const auto key = [](const Eigen::Vector3d& v) { return Key{v.x(), v.y(), v.z()}; };
  std::map<std::tuple<int, Key, Key>, int> times;
  const auto each = [&](auto&& visit) {
    for (const auto& piece : walls) {
      const auto n = piece.corners.size();
      for (std::size_t i = 0; i < (n == 2 ? 1 : n); ++i) {
        const auto &a = piece.corners[i], &b = piece.corners[(i + 1) % n];
        auto low = key(a), high = key(b);
        if (high < low) std::swap(low, high);
        visit(std::tuple(piece.wall, low, high), a, b);
      }
    }
  };
  each([&](const auto& edge, const auto&, const auto&) { ++times[edge]; });
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> alone;
  each([&](const auto& edge, const auto& a, const auto& b) {
    if (times[edge] == 1) alone.emplace_back(a, b);
  });
  return alone;
}

bool has_round_wall(std::span<const read::WallPiece> walls) {
  for (const auto& [wall, faces] : by_wall(walls))
    if (faces.size() >= faces_of_a_round_wall) return true;
  return false;
}

bool stand_around(std::span<const read::WallPiece> walls, const Eigen::AlignedBox3d& seen) {
  constexpr std::size_t sides = 4;
  constexpr double nearly = 0.9;
  Eigen::AlignedBox3d all;
  std::size_t flat = 0;
  for (const auto& [wall, faces] : by_wall(walls)) {
    if (faces.size() >= faces_of_a_round_wall) continue;
    ++flat;
    for (const auto* face : faces)
      for (const auto& corner : face->corners) all.extend(corner);
  }
  return flat >= sides && (all.sizes().array() >= nearly * seen.sizes().array()).all();
}

void include_walls(Survey& survey, std::span<const read::WallPiece> walls) {
  const Eigen::Rotation2Dd turn(survey.turn);
  const Eigen::Array3d grains = survey.bounds.sizes().array();
  for (const auto& [wall, faces] : by_wall(walls)) {
    const double growth = faces.size() < faces_of_a_round_wall ? most_growth : most_growth_round;
    auto bounds = survey.bounds;
    auto turned = survey.turned;
    for (const auto* face : faces)
      for (const auto& corner : face->corners) {
        bounds.extend(corner);
        turned.extend(turn * corner.head<2>());
      }
    const Eigen::Array3d most = growth * grains + 1e-9 * bounds.sizes().norm();
    if ((bounds.sizes().array() > most).any()) continue;
    survey.bounds = bounds;
    if (survey.dimensions == 2) survey.turned = turned;
  }
}

}  // namespace chute::view
