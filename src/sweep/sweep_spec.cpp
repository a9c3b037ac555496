#include "sweep/sweep_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <string>

#include "common/keys.hpp"

namespace chute::sweep {
namespace {

constexpr double most_places = 1e6;  // runs that a sweep may ask for

template <class Archive>
void describe_axis(Archive& a, Axis& axis) {
  constexpr bool all = !std::same_as<Archive, TomlWriter>;
  a.required("key", axis.key, "the scene's key that changes");
  a.value("values", axis.values, "its values, ascending");
  if (all || axis.values.empty()) {
    a.value("from", axis.from, "the first value, instead");
    a.value("to", axis.to, "the last value");
    a.value("count", axis.count, between(0, most_places), "of values, evenly");
    a.value("quick_count", axis.quick_count, at_least(2), "of a quick figure");
  }
  if (all || !axis.unit.empty()) a.value("unit", axis.unit, "of the values: angles have \"deg\"");
  a.check(axis.values.empty() != (axis.count < 2), axis.values.empty() ? "count" : "values",
          "give either values = [ … ] or from, to and count (at least 2)");
  a.check(axis.values.empty() ? axis.from < axis.to : std::ranges::is_sorted(axis.values),
          axis.values.empty() ? "to" : "values", "must ascend");
}

template <class Archive>
void describe_boundary(Archive& a, BoundarySpec& spec) {
  a.required_section("axis", spec.axis);
  a.required("tolerance", spec.tolerance, positive, "boundaries are found to plus or minus half of this");
  a.value("velocities", spec.velocities, "launches, slowest first; B needs them to end alike");
  a.value("alike", spec.alike, Range{0, 1, true, true}, "difference of medians that counts as alike");
  a.check(std::ranges::is_sorted(spec.velocities), "velocities", "must ascend: slow starts first");
}

template <class Archive>
void describe_sweep(Archive& a, SweepSpec& spec) {
  a.value("seeds", spec.seeds, between(1, 1e6));
  a.sections("axis", spec.axes);
  a.section("boundary", spec.boundary);
  a.check(!spec.axes.empty() || spec.boundary, "axis", "a sweep needs an axis or a boundary");
  double places = 1;
  for (const auto& axis : spec.axes)
    places *=
        static_cast<double>(axis.values.empty() ? static_cast<std::size_t>(axis.count) : axis.values.size());
  a.check(
      places * static_cast<double>(spec.seeds) <= most_places, "axis",
      fmt::format("{:.3g} places of {} seeds are more runs than {:.0e}", places, spec.seeds, most_places));
}

}  // namespace

void describe(TomlReader& a, Axis& axis) { describe_axis(a, axis); }
void describe(TomlWriter& a, Axis& axis) { describe_axis(a, axis); }
void describe(KeyLister& a, Axis& axis) { describe_axis(a, axis); }
void describe(TomlReader& a, BoundarySpec& spec) { describe_boundary(a, spec); }
void describe(TomlWriter& a, BoundarySpec& spec) { describe_boundary(a, spec); }
void describe(KeyLister& a, BoundarySpec& spec) { describe_boundary(a, spec); }
void describe(TomlReader& a, SweepSpec& spec) { describe_sweep(a, spec); }
void describe(TomlWriter& a, SweepSpec& spec) { describe_sweep(a, spec); }

std::vector<double> Axis::points(bool quick) const {
  if (!values.empty()) return values;
  const auto n = quick ? quick_count.value_or(count) : count;
  std::vector<double> points;
  for (std::int64_t i = 0; i < n; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(n - 1);
    points.push_back(std::stod(fmt::format("{:.12g}", from + part * (to - from))));  // no 0.12000000000000001
  }
  return points;
}

std::string Axis::setting(double value) const {
  return unit.empty() ? fmt::format("{}={}", key, value) : fmt::format("{}=\"{} {}\"", key, value, unit);
}

}  // namespace chute::sweep
