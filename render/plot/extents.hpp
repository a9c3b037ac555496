#pragma once
#include <vector>

#include "plot/figure.hpp"
#include "plot/scale.hpp"

/// How much of each axis series take up.
namespace chute::plot {

inline bool has_line(Kind kind) { return kind == Kind::line || kind == Kind::both || kind == Kind::band; }
inline bool has_markers(Kind kind) { return kind == Kind::markers || kind == Kind::both; }
inline bool has_bins(Kind kind) { return kind == Kind::steps || kind == Kind::bars; }

/// Unknown where a series has no errors.
inline double error_at(const std::vector<double>& errors, std::size_t i) {
  return i < errors.size() ? errors[i] : unknown;
}

/// Edges of a histogram's bins from their centres: halfway between neighbours, the outer ones as wide inside as out.
std::vector<double> bin_edges(const std::vector<double>& x);

/// What each axis must show of these series.
struct Extents {
  Extent x, y, right, top;
};
/// InputError if a series' columns differ in length.
Extents extents_of(const Plot& plot);

}  // namespace chute::plot
