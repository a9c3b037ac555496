#pragma once
#include <array>

#include "engines/dsmc/dsmc_setup.hpp"
#include "engines/kind/walton_keys.hpp"

namespace chute::dsmc {

/// `engine.method = "dsmc"`.
class DsmcMethod final : public Described<engines::Method, DsmcMethod>, public engines::WaltonKeys {
 public:
  static constexpr std::string_view word = "dsmc",
                                    text = "gas of grains that collide by chance, cell by cell (2.3)";
  /// A further thread pays for so many moving grains.
  static constexpr std::int64_t grains_per_thread = 5000;
  std::optional<double> cell;
  double weight = 1, heating = 0;
  Dense dense = Dense::rate;
  static constexpr std::array<std::string_view, 3> dense_words{"none", "rate", "esmc"};

  template <class Archive>
  void describe(Archive& a) {
    describe_walton(a);
    a.value("time_step", time_step, positive, "default 0.2 of the mean time between a grain's collisions");
    a.value("cell", cell, positive,
            "side of a cell; default such that about 20 grains are in it, 1.5 to 3 d or λ/3");
    a.value("weight", weight, positive, "w, real grains that each simulated one stands for");
    a.choice("dense", dense, dense_words,
             "excluded volume: points; collisions more frequent by χ; or partners a diameter away, too");
    a.value("heating", heating, non_negative,
            "ξ², variance per time that white noise gives each velocity component");
    // What only other methods use is understood: a scene changes its method with one key.
    for (const char* other : {"steps_per_contact", "integrator", "deepest_overlap", "contact_time"})
      a.ignored(other);
  }
  Offers offers() const override;
  std::optional<Refusal> refusal(const engines::Setting& setting) const override;
  double step(const engines::Setting& setting) const override;
  std::vector<Fact> facts(const engines::Setting& setting) const override;
  std::vector<std::string> warnings(const engines::Setting& setting) const override;
  double seconds_per_step(const engines::Setting& setting) const override;
  std::unique_ptr<Engine> make(World<2> world, const engines::Setting& setting, int threads) const override;
  std::unique_ptr<Engine> make(World<3> world, const engines::Setting& setting, int threads) const override;

  /// The gas as the scene starts it, where that says enough.
  struct Gas {
    double n = 0, phi = 0, chi = 1;  ///< 0: the room that grains have is not known
    double temperature = 0;          ///< 0: not known
    double rate = 0, path = 0;  ///< collisions of a grain per time, and the way between them; 0: not known
  };
  Gas gas(const engines::Setting& setting) const;
  double cell_side(const engines::Setting& setting) const;
};

}  // namespace chute::dsmc
