#pragma once
#include "measure/diffusion.hpp"
#include "measure/observer.hpp"

/// What a scene can ask for about single grains on a bed (thesis 4.3): one ball, or many that do not feel each other. All of
/// them leave out what a grain does shortly before it comes to rest (standstill.hpp).
namespace chute::measure {

struct VelocitySpec {
  double from = 0, every = 0, bin = 0;
  std::int64_t most = 50000;
};
template <class Archive>
void describe(Archive& a, VelocitySpec& spec) {
  a.value("from", spec.from, non_negative, "samples count after this time");
  a.required("every", spec.every, positive, "time between samples");
  a.value("bin", spec.bin, non_negative, "width of the bins; default 0.02 √(g d)");
  a.value("most", spec.most, between(10, 1e8), "samples that are kept, evenly taken from all");
}
/// [output.velocities]
class VelocitiesOutput final : public TableOutput<VelocitiesOutput, VelocitySpec> {
 public:
  static constexpr std::string_view word = "velocities",
                                    text = "velocities of single grains, and their distributions";
  Needs needs() const override { return {.same_grains = true}; }
  void fill(const Scales& scales) override;
  double rhythm() const override { return spec ? spec->every : std::numeric_limits<double>::infinity(); }
  std::vector<std::string> files() const override { return {"velocities.csv", "velocity_histograms.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

struct DiffusionSpec {
  double from = 0, every = 0, longest = 0;
};
template <class Archive>
void describe(Archive& a, DiffusionSpec& spec) {
  a.value("from", spec.from, non_negative, "pieces begin after this time");
  a.required("every", spec.every, positive, "time between looks, and the shortest piece");
  a.required("longest", spec.longest, positive, "the longest piece that the run is cut into");
  a.check(spec.longest >= 20 * spec.every, "longest", "must be at least 20 times every");
}
/// [output.diffusion]
class DiffusionOutput final : public TableOutput<DiffusionOutput, DiffusionSpec> {
 public:
  static constexpr std::string_view word = "diffusion",
                                    text = "how grains spread along and across, (4.65) and (4.66)";
  Needs needs() const override { return {.same_grains = true}; }
  double rhythm() const override { return spec ? spec->every : std::numeric_limits<double>::infinity(); }
  std::vector<std::string> files() const override { return {"diffusion.csv", diffusion_coefficients_file}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

struct BeadSpec {
  double from = 0;
  std::int64_t most = 50000;
};
template <class Archive>
void describe(Archive& a, BeadSpec& spec) {
  a.value("from", spec.from, non_negative, "visits that begin after this time");
  a.value("most", spec.most, between(10, 1e8), "visits that are kept, evenly taken from all");
}
/// [output.beads]
class BeadsOutput final : public TableOutput<BeadsOutput, BeadSpec> {
 public:
  static constexpr std::string_view word = "beads",
                                    text = "what passes between a grain and each bead that it visits";
  Needs needs() const override { return {.impacts = true}; }
  std::vector<std::string> files() const override { return {"beads.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

struct TrappingSpec {
  double every = 0, from = 0;
};
template <class Archive>
void describe(Archive& a, TrappingSpec& spec) {
  a.required("every", spec.every, positive, "time between looks");
  a.value("from", spec.from, non_negative,
          "of trapping_rate.csv: grains that move now, and what they do from now on, count");
}
/// [output.trapping]
class TrappingOutput final : public TableOutput<TrappingOutput, TrappingSpec> {
 public:
  static constexpr std::string_view
      word = "trapping",
      text = "which grains came to rest, where, how far they had gone, and how often";
  Needs needs() const override { return {.same_grains = true}; }
  std::vector<std::string> files() const override { return {"trapping.csv", "trapping_rate.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

struct StartingSpec {
  double every = 0;
};
template <class Archive>
void describe(Archive& a, StartingSpec& spec) {
  a.required("every", spec.every, positive, "time between looks");
}
/// [output.starting]
class StartingOutput final : public TableOutput<StartingOutput, StartingSpec> {
 public:
  static constexpr std::string_view word = "starting",
                                    text = "when grains at rest begin to move, on an incline that tilts";
  Needs needs() const override { return {.same_grains = true}; }
  std::vector<std::string> files() const override { return {"starting.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

/// `output.bed = true`
class BedOutput final : public Described<Output, BedOutput> {
 public:
  static constexpr std::string_view word = "bed",
                                    text = "distances between the beads of a plane, and its holes (3D)";
  bool bed = false;

  template <class Archive>
  void describe(Archive& a) {
    if (Archive::reading || bed)
      a.value(word, bed, "distances of neighbouring beads and of the Voronoi vertices from them");
  }
  bool wanted() const override { return bed; }
  void drop() override { bed = false; }
  Needs needs() const override { return {.plane_of_beads = true}; }
  std::vector<std::string> files() const override { return {"bed_neighbours.csv", "bed_vertices.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

}  // namespace chute::measure
