#pragma once
#include "measure/outputs.hpp"

namespace chute::measure {

/// The pair distribution g of moving grains in a box that repeats in all directions: how many pairs lie at a distance, in
/// units of the distance of contact R_i + R_j, over how many there would be if places were independent. Its value at
/// contact tells the pressure of hard grains, βP/n = 1 + 2φ g (discs), 1 + 4φ g (spheres), all of one size.
class PairDistances {
 public:
  /// Up to `reach` contact distances, in bins of `bin`.
  PairDistances(double reach, double bin, const Window& window);

  void add(const GrainsView& grains);

  struct Row {
    double r;  ///< middle of the bin
    Estimate g;
  };
  std::vector<Row> result(double start) const;

  struct Contact {
    double phi;  ///< packing fraction
    Estimate g;  ///< at contact, from a polynomial in ln g over the distances near it
    Estimate Z;  ///< βP/n
  };
  Contact contact(double start) const;

  template <class Archive>
  void serialize(Archive& a) {
    a(blocks_, phi_, expected_, dimensions_);
  }

 private:
  double reach_, bin_;
  std::size_t bins_;
  double phi_ = 0, expected_ = 0;  // pairs in a unit of r^D, were they independent
  int dimensions_ = 2;
  Blocks<double> blocks_;

  double expected_in(std::size_t bin) const;
  double contact_value(const std::vector<double>& counts, double samples) const;
};

struct PairSpec {
  From from = 0;
  double reach = 4, bin = 0.01, every = 0;
};
template <class Archive>
void describe(Archive& a, PairSpec& spec) {
  a.number_or_word("from", spec.from, "steady", non_negative,
                   "averages begin; \"steady\": when the flow settled");
  a.required("every", spec.every, positive, "time between samples");
  a.value("reach", spec.reach, between(1.3, 50), "farthest distance, in contact distances");
  a.value("bin", spec.bin, between(1e-4, 0.1), "width of a bin, in contact distances");
}
/// [output.pairs]
class PairsOutput final : public TableOutput<PairsOutput, PairSpec> {
 public:
  static constexpr std::string_view word = "pairs",
                                    text = "the pair distribution, and the pressure of hard grains";
  Needs needs() const override { return {.closed_box = true}; }
  double rhythm() const override { return spec ? spec->every : std::numeric_limits<double>::infinity(); }
  std::vector<std::string> files() const override { return {"pairs.csv", "pressure.csv"}; }
  std::vector<std::unique_ptr<Observer>> make(const RunContext& run) const override;
};

}  // namespace chute::measure
