#pragma once
#include "beds/bed.hpp"

namespace chute::beds {

/// No bed at all; `length` is that of the periodic domain.
class NoBed final : public Described<Bed, NoBed> {
 public:
  static constexpr std::string_view word = "none", text = "no bed: grains fall for ever, or do not fall";
  std::optional<double> length;

  template <class Archive>
  void describe(Archive& a) {
    describe_diameter(a);
    a.value("length", length, positive, "of the periodic domain along x; or domain.size");
  }
  const char* length_key() const override { return "bed.length"; }
  Ground lay(const Site&) const override { return {{}, length, {}, false}; }
};

/// A smooth plane at height 0: one wall.
class Flat final : public Described<Bed, Flat> {
 public:
  static constexpr std::string_view word = "flat", text = "a smooth plane at height 0";
  std::optional<double> length;

  template <class Archive>
  void describe(Archive& a) {
    describe_diameter(a);
    a.value("length", length, positive, "of the periodic domain along x; or domain.size");
  }
  const char* length_key() const override { return "bed.length"; }
  Ground lay(const Site&) const override { return {{}, length, {}, true}; }
};

}  // namespace chute::beds
