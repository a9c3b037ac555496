#pragma once
#include <cstdint>
#include <vector>

#include "beds/tessellation.hpp"

namespace chute::beds {

/// Discs on a sheet while a plane is made: they are pushed about until the plane is as its recipe wants it.
class Crowd {
 public:
  Crowd(double length, double width) : sheet_{length, width, {}} {}

  void add(const std::array<double, 2>& place, double radius) {
    sheet_.place.push_back(sheet_.wrapped(place));
    radius_.push_back(radius);
  }
  const Sheet& sheet() const { return sheet_; }
  std::size_t size() const { return radius_.size(); }

  /// Pushes overlapping discs apart, each by half, until none overlaps by more than a thousandth of its size, or until
  /// that has been tried long enough: a plane may be too full for it.
  void push_apart() { push_apart(1, most_pushes); }

  /// Draws the discs around every hole wider than `reach` towards its middle and pushes overlapping ones apart, in turn,
  /// until there are neither holes nor overlaps. False if that does not come to an end: the plane is too empty.
  bool draw_in(double reach);

  /// All discs get this radius.
  void resize(double radius) { radius_.assign(radius_.size(), radius); }

  /// Adds discs of this radius in the largest holes, as many as asked for, pushing apart after each.
  void add_in_holes(std::size_t count, double radius);

 private:
  Sheet sheet_;
  std::vector<double> radius_;

  /// So often discs are pushed apart before it is taken for hopeless. Planes as full as the thesis's need some dozens.
  static constexpr int most_pushes = 2000;

  /// How deep the deepest overlap was in the last round, as a part of the two radii.
  double push_apart(double room, int most);

  struct Pair {
    std::size_t a, b;
  };
  std::vector<Pair> close_pairs(double skin) const;
  std::vector<std::array<double, 2>> largest_holes(const Tessellation& t, double reach, double apart,
                                                   std::size_t most) const;
  double widest() const;
};

}  // namespace chute::beds
