#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/figure_table.hpp"
#include "figures/data_recipe.hpp"

/// What figures of hard grains take from runs: cooling gases, accelerations, angles of tilting, networks of forces, and
/// stresses in silos.
namespace chute::figures {

/// A gas that cools: √(T_0/T) or a_2 of moments.csv against t/τ with Haff's time of the run's own T_0 (1 = m = d). Runs are
/// averaged at the first one's times, linearly between their own.
std::vector<FigureRow> cooling(const Curve& curve, std::span<const std::filesystem::path> runs);

/// Mean rate of change of a column of series.csv, from its first row to its last: one point.
std::vector<FigureRow> rate(const Curve& curve, std::span<const std::filesystem::path> runs);

/// A number of run.json, `column` being the way to it: "tilting/start_angle". Runs in which it is null do not count.
std::vector<FigureRow> record(const Curve& curve, std::span<const std::filesystem::path> runs);

/// The network of contacts in the last frame of the first run. Column "place": their points; "branch": from centre to
/// centre, as x and y, at walls twice the way to the surface; "force": number from 1 and normal force.
std::vector<FigureRow> network(const Curve& curve, std::span<const std::filesystem::path> runs);

/// A column of profiles.csv against the depth below the surface, which is where η falls below half of its largest value.
std::vector<FigureRow> depth(const Curve& curve, std::span<const std::filesystem::path> runs);

/// Janssen's σ = σ_∞ (1 − exp(−z/λ)) fitted to that by least squares.
struct Janssen {
  double stress, length;  ///< σ_∞, λ
  double largest;         ///< depth that it was fitted to
};
Janssen fit_janssen(const std::vector<FigureRow>& rows);
std::vector<FigureRow> janssen(const Curve& curve, std::span<const std::filesystem::path> runs);
/// What the fit gave, as a comment.
std::string janssen_note(const Curve& curve, std::span<const std::filesystem::path> runs);

}  // namespace chute::figures
