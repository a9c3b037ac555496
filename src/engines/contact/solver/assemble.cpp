#include "engines/contact/solver/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"

namespace chute::contact {
namespace {

struct Place {
  std::uint32_t row, column;
  auto operator<=>(const Place&) const = default;  // NOLINT(modernize-use-nullptr): there is none
};

template <int D>
bool finite(const Block<D>& block) {
  return std::ranges::all_of(block.c, [](double x) { return std::isfinite(x); });
}

/// By Gauss's elimination of the symmetric part: all pivots positive, and not by rounding only.
template <int D>
bool positive_definite(const Block<D>& block) {
  constexpr double least = 1e-12;  // of the same diagonal element before: a pivot of rounding errors
  Block<D> s;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) s(i, j) = (block(i, j) + block(j, i)) / 2;
  for (int k = 0; k < D; ++k) {
    if (!(s(k, k) > least * std::abs(block(k, k)))) return false;
    for (int i = k + 1; i < D; ++i)
      for (int j = k + 1; j < D; ++j) s(i, j) -= s(i, k) / s(k, k) * s(k, j);
  }
  return true;
}

}  // namespace

// It is moved from below, which the check does not see in a template.
template <int D>
// NOLINTNEXTLINE(performance-unnecessary-value-param)
Problem<D> assemble(std::span<const Entry> entries, std::vector<Vec<D>> q, std::vector<double> friction) {
  const auto m = q.size();
  const auto place = [](const Entry& e) {
    return Place{static_cast<std::uint32_t>(e.row / D), static_cast<std::uint32_t>(e.column / D)};
  };
  std::vector<Place> places;
  places.reserve(2 * entries.size() / D + m);
  for (const auto& e : entries)
    if (const auto p = place(e); places.empty() || places.back() != p) places.push_back(p);
  const auto given = places.size();
  for (std::size_t k = 0; k < given; ++k) places.push_back({places[k].column, places[k].row});
  for (std::uint32_t i = 0; i < m; ++i) places.push_back({i, i});
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());

  Problem<D> problem;
  problem.q = std::move(q);
  problem.friction = std::move(friction);
  problem.row_starts.assign(m + 1, 0);
  for (const auto& p : places) {
    ++problem.row_starts[p.row + 1];
    problem.columns.push_back(p.column);
  }
  for (std::size_t i = 0; i < m; ++i) problem.row_starts[i + 1] += problem.row_starts[i];
  problem.blocks.resize(places.size());
  for (const auto& e : entries) {
    const auto k = static_cast<std::size_t>(std::ranges::lower_bound(places, place(e)) - places.begin());
    problem.blocks[k](static_cast<int>(e.row % D), static_cast<int>(e.column % D)) += e.value;
  }
  return problem;
}

template <int D>
void check(const Problem<D>& problem) {
  for (std::size_t i = 0; i < problem.size(); ++i) {
    const auto complain = [i](const char* what) { throw InputError(fmt::format("contact {}: {}", i, what)); };
    for (int k = 0; k < D; ++k)
      if (!std::isfinite(problem.q[i][k])) complain("q is not a finite number");
    if (!(problem.friction[i] >= 0 && std::isfinite(problem.friction[i])))
      complain("the coefficient of friction must be finite and not negative");
    for (auto k = problem.row_starts[i]; k < problem.row_starts[i + 1]; ++k)
      if (!finite(problem.blocks[k])) complain("its row of W has a number that is not finite");
    if (!positive_definite(problem.blocks[problem.diagonal(i)]))
      complain("its own block of W must be positive definite");
  }
}

template Problem<2> assemble(std::span<const Entry>, std::vector<Vec<2>>, std::vector<double>);
template Problem<3> assemble(std::span<const Entry>, std::vector<Vec<3>>, std::vector<double>);
template void check(const Problem<2>&);
template void check(const Problem<3>&);

}  // namespace chute::contact
