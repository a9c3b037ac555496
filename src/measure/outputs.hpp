#pragma once
#include "measure/observer.hpp"

/// What a scene can ask for in [output]: keys, defaults and needs of every observer. What they do stands in the file of
/// each.
namespace chute::measure {

/// [output.series]. Always there: the verdict about the flow is made of it.
class SeriesOutput final : public Described<Output, SeriesOutput> {
 public:
  static constexpr std::string_view word = "series", text = "means over all grains and the energy account";
  Every series;

  template <class Archive>
  void describe(Archive& a) {
    a.section(word, series);
  }
  bool wanted() const override { return true; }
  void drop() override {}
  void before_reading(const Scales& scales) override;
  double rhythm() const override { return series.every; }
  std::vector<std::string> may_change() const override { return {"every", "from"}; }
  std::vector<std::string> files() const override { return {"series.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

/// [output.frames], and with `contacts = true` the contact network beside every frame.
class FramesOutput final : public Described<Output, FramesOutput> {
 public:
  static constexpr std::string_view word = "frames",
                                    text = "the grains, as VTK files; with contacts their network";
  std::optional<Every> frames;
  bool contacts = false;

  template <class Archive>
  void describe(Archive& a) {
    a.section(word, frames);
    a.value("contacts", contacts, "the contact network beside every frame");
    a.check(!contacts || frames, "contacts",
            "the contact network is written beside frames; ask for frames = { every = … }");
  }
  bool wanted() const override { return frames.has_value(); }
  void drop() override { frames.reset(), contacts = false; }
  Needs needs() const override { return {.contacts = contacts}; }
  double rhythm() const override { return frames ? frames->every : std::numeric_limits<double>::infinity(); }
  std::vector<std::string> may_change() const override { return {"every", "from", "contacts"}; }
  std::vector<std::string> files() const override {
    return {"frames.pvd", "frames", "contacts", "walls.vtp"};
  }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

/// Where averages begin: empty, written "steady": from when the flow settled, found from the run itself.
using From = std::optional<double>;

struct ProfileSpec {
  From from = 0;
  double bin = 0;
  std::optional<double> fine, every;
};
template <class Archive>
void describe(Archive& a, ProfileSpec& spec) {
  a.number_or_word("from", spec.from, "steady", non_negative,
                   "averages begin; \"steady\": when the flow settled");
  a.value("bin", spec.bin, non_negative, "height of a layer; default a bead's diameter");
  a.value("fine", spec.fine, positive, "height of the layers of a second table, profiles_fine.csv");
  a.value("every", spec.every, positive, "time between samples; default 0.02 √(d/g)");
}
/// [output.profiles]
class ProfilesOutput final : public TableOutput<ProfilesOutput, ProfileSpec> {
 public:
  static constexpr std::string_view word = "profiles", text = "averages over layers at each height";
  Needs needs() const override { return {.contacts = true}; }
  void fill(const Scales& scales) override;
  std::vector<std::string> files() const override { return {"profiles.csv", "profiles_fine.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

struct FieldSpec {
  From from = 0;
  double width = 0;
  std::optional<double> every;
};
template <class Archive>
void describe(Archive& a, FieldSpec& spec) {
  a.number_or_word("from", spec.from, "steady", non_negative,
                   "averages begin; \"steady\": when the flow settled");
  a.value("width", spec.width, non_negative, "of the smoothing kernel; default a bead's diameter");
  a.value("every", spec.every, positive, "time between samples; default 0.02 √(d/g)");
}
/// [output.fields]
class FieldsOutput final : public TableOutput<FieldsOutput, FieldSpec> {
 public:
  static constexpr std::string_view word = "fields",
                                    text = "fields coarse-grained over the height, without bins";
  Needs needs() const override { return {.contacts = true}; }
  void fill(const Scales& scales) override;
  std::vector<std::string> files() const override { return {"fields.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

struct HeightSpec {
  double from = 0, every = 0;
};
template <class Archive>
void describe(Archive& a, HeightSpec& spec) {
  a.value("from", spec.from, non_negative, "averages begin");
  a.required("every", spec.every, positive, "time between samples");
}
/// [output.heights]
class HeightsOutput final : public TableOutput<HeightsOutput, HeightSpec> {
 public:
  static constexpr std::string_view word = "heights", text = "the mean height of every single grain";
  Needs needs() const override { return {.same_grains = true}; }
  std::vector<std::string> files() const override { return {"heights.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

struct SegregationSpec {
  From from = 0;
  double every = 0, bin = 0;
};
template <class Archive>
void describe(Archive& a, SegregationSpec& spec) {
  a.required("every", spec.every, positive, "time between rows of segregation.csv, and between samples");
  a.number_or_word("from", spec.from, "steady", non_negative,
                   "averages of species.csv begin; \"steady\": when the flow settled");
  a.value("bin", spec.bin, non_negative, "height of a layer; default a bead's diameter");
}
/// [output.segregation]
class SegregationOutput final : public TableOutput<SegregationOutput, SegregationSpec> {
 public:
  static constexpr std::string_view word = "segregation",
                                    text = "how materials part, and what each does at each height";
  void fill(const Scales& scales) override;
  std::vector<std::string> files() const override { return {"segregation.csv", "species.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

struct ImpactSpec {
  double from = 0;
};
template <class Archive>
void describe(Archive& a, ImpactSpec& spec) {
  a.value("from", spec.from, non_negative, "impacts after this time");
}
/// [output.impacts]
class ImpactsOutput final : public TableOutput<ImpactsOutput, ImpactSpec> {
 public:
  static constexpr std::string_view word = "impacts", text = "every impact, as a point where surfaces met";
  Needs needs() const override { return {.impacts = true}; }
  std::vector<std::string> files() const override { return {"impacts.vtp"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

struct ImpactHistogramSpec {
  From from = 0;
  std::int64_t angles = 90, velocities = 100;
  double fastest = 0;
};
template <class Archive>
void describe(Archive& a, ImpactHistogramSpec& spec) {
  a.number_or_word("from", spec.from, "steady", non_negative,
                   "impacts count; \"steady\": when the flow settled");
  a.value("angles", spec.angles, between(1, 10000), "bins of γ mod π");
  a.value("velocities", spec.velocities, between(1, 10000), "bins of |v_n|");
  a.value("fastest", spec.fastest, non_negative, "end of the last of them; default 2 √(gd)");
}
/// [output.impact_histograms]
class ImpactHistogramsOutput final : public TableOutput<ImpactHistogramsOutput, ImpactHistogramSpec> {
 public:
  static constexpr std::string_view word = "impact_histograms",
                                    text = "statistics of impacts, gathered in the run";
  Needs needs() const override { return {.impacts = true}; }
  void fill(const Scales& scales) override;
  std::vector<std::string> files() const override { return {"impact_histograms.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

}  // namespace chute::measure
