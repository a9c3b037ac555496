#pragma once
#include "beds/bed.hpp"

namespace chute::beds {

/// A line of beads along the incline, at height 0; in space it lies at y = 0.
class Line : public Bed {
 public:
  std::int64_t count = 30;

 protected:
  template <class Archive>
  void describe_count(Archive& a) {
    a.required("count", count, between(3, 1e7), "beads");
  }
  /// Beads whose surfaces are 2 gap(i) r apart.
  template <class Gap>
  Ground line(const Gap& gap, double mean_gap, double widest_gap) const {
    Ground ground;
    const double r = diameter / 2;
    double x = r;
    for (std::int64_t i = 0; i < count; ++i) {
      ground.beads.push_back({x, 0, 0, r});
      x += 2 * r * (1 + gap(i));
    }
    ground.length = x - r;
    ground.spacing = diameter * (1 + mean_gap);
    ground.widest_spacing = diameter * (1 + widest_gap);
    return ground;
  }
};

/// The same gap everywhere (thesis 4.2.1).
class Row final : public Described<Line, Row> {
 public:
  static constexpr std::string_view word = "row", text = "a line of beads, all the same distance apart";
  double gap = 0;  ///< ε

  template <class Archive>
  void describe(Archive& a) {
    describe_diameter(a);
    describe_count(a);
    a.value("gap", gap, between(0, 10), "ε: neighbours' surfaces are 2εr apart");
  }
  Ground lay(const Site&) const override {
    return line([this](std::int64_t) { return gap; }, gap, gap);
  }
};

/// Gaps drawn evenly from [0, ε_max] (thesis 4.2.1).
class DisorderedRow final : public Described<Line, DisorderedRow> {
 public:
  static constexpr std::string_view word = "disordered-row", text = "a line of beads with random gaps";
  double gap_max = 0;  ///< ε_max

  template <class Archive>
  void describe(Archive& a) {
    describe_diameter(a);
    describe_count(a);
    a.required("gap_max", gap_max, between(0, 10), "ε_max: gaps are drawn evenly from 0 to this");
  }
  Ground lay(const Site& site) const override;
};

}  // namespace chute::beds
