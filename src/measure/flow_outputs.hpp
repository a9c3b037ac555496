#pragma once
#include "measure/outputs.hpp"
#include "measure/surface.hpp"

/// What a scene can ask for about flows between walls, flows that change, and grains that run out: averages across a
/// channel, over the height as time goes on, the number beyond a plane, and the surface of a heap.
namespace chute::measure {

/// Which way strips lie side by side: across the flow, or along it one behind the other.
enum class StripAxis { y, x };

struct AcrossSpec {
  StripAxis axis = StripAxis::y;
  From from = 0;
  double bin = 0, above = 0;
  std::optional<double> every;
};
template <class Archive>
void describe(Archive& a, AcrossSpec& spec) {
  using namespace std::string_view_literals;
  a.choice("axis", spec.axis, std::array{"y"sv, "x"sv},
           "y: strips along the flow, side by side (3D); x: strips across it, one behind the other");
  a.number_or_word("from", spec.from, "steady", non_negative,
                   "averages begin; \"steady\": when the flow settled");
  a.value("bin", spec.bin, non_negative, "width of a strip; default a bead's diameter");
  a.value("above", spec.above, "only grains above this height count");
  a.value("every", spec.every, positive, "time between samples; default 0.02 √(d/g)");
}
/// [output.across]
class AcrossOutput final : public TableOutput<AcrossOutput, AcrossSpec> {
 public:
  static constexpr std::string_view word = "across",
                                    text = "averages over strips, across a channel or along it";
  Needs needs() const override { return {.space = spec && spec->axis == StripAxis::y}; }
  void fill(const Scales& scales) override;
  std::vector<std::string> files() const override { return {"across.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

struct HistorySpec {
  double every = 0, from = 0, bin = 0;
  std::int64_t samples = 1;
  std::optional<std::vector<double>> between;
  bool powers = false;
};
template <class Archive>
void describe(Archive& a, HistorySpec& spec) {
  a.required("every", spec.every, positive, "time from one profile to the next");
  a.value("from", spec.from, non_negative, "time of the first");
  a.value("bin", spec.bin, non_negative, "height of a layer; default a bead's diameter");
  a.value("samples", spec.samples, at_least(1), "looks that a profile averages over, in the time before it");
  a.value("between", spec.between, "[x, x]: only grains there count");
  a.check(!spec.between || (spec.between->size() == 2 && (*spec.between)[0] < (*spec.between)[1]), "between",
          "must be [low, high] with low < high");
  a.value("powers", spec.powers,
          "the energy balance of each layer: what gravity puts in, contacts carry in and take");
  a.check(!spec.powers || !spec.between, "powers", "are of layers all along the flow: leave out between");
}
/// [output.history]
class HistoryOutput final : public TableOutput<HistoryOutput, HistorySpec> {
 public:
  static constexpr std::string_view word = "history",
                                    text = "profiles over the height one after the other, as a flow changes";
  void fill(const Scales& scales) override {
    if (spec && spec->bin == 0) spec->bin = scales.length;
  }
  Needs needs() const override { return {.powers = spec && spec->powers}; }
  double rhythm() const override {
    return spec ? spec->every / static_cast<double>(spec->samples) : std::numeric_limits<double>::infinity();
  }
  std::vector<std::string> files() const override { return {"history.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

struct DischargeSpec {
  double every = 0, below = 0;
};
template <class Archive>
void describe(Archive& a, DischargeSpec& spec) {
  a.required("every", spec.every, positive, "time between looks");
  a.value("below", spec.below, "height of the opening: grains whose centre lies lower have run out");
}
/// [output.discharge]
class DischargeOutput final : public TableOutput<DischargeOutput, DischargeSpec> {
 public:
  static constexpr std::string_view word = "discharge",
                                    text = "how many grains have run out through an opening, in time";
  double rhythm() const override { return spec ? spec->every : std::numeric_limits<double>::infinity(); }
  std::vector<std::string> files() const override { return {"discharge.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

template <class Archive>
void describe(Archive& a, SurfaceSpec& spec) {
  a.required("every", spec.every, positive, "time from one look to the next");
  a.value("from", spec.from, non_negative, "time of the first");
  a.value("bin", spec.bin, non_negative, "width of a strip across x; default a bead's diameter");
  a.value("low", spec.low, unit_interval,
          "a slope ends where the surface is lower than so much of its greatest height");
  a.value("high", spec.high, unit_interval, "and begins where it is no higher than so much of it");
  a.check(spec.low < spec.high, "high", "must be more than low");
}
/// [output.surface]
class SurfaceOutput final : public TableOutput<SurfaceOutput, SurfaceSpec> {
 public:
  static constexpr std::string_view
      word = "surface",
      text = "the free surface along x, and its slopes: of a heap the angle of repose";
  void fill(const Scales& scales) override;
  double rhythm() const override { return spec ? spec->every : std::numeric_limits<double>::infinity(); }
  std::vector<std::string> files() const override { return {"surface.csv", "slopes.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

}  // namespace chute::measure
