#pragma once
#include <cereal/types/vector.hpp>

#include "engines/automaton/model.hpp"

namespace chute::automaton {

struct PileSetup {
  std::int64_t length = 64;      ///< L
  int low = 1, high = 2;         ///< thresholds that are drawn
  double probability_low = 0.5;  ///< of the lower one
  std::uint64_t seed = 1;
};

/// The Oslo model of a rice pile (Christensen, Corral, Frette, Feder & Jøssang, Phys. Rev. Lett. 77, 107 (1996)): slopes z_i
/// of a pile between a wall at the left and an edge at the right. An update adds a grain at the wall; every site steeper
/// than its threshold topples, z_i −= 2, z_{i±1} += 1, and draws a new threshold, until all are stable. At i = 1 z_1 −= 2 and
/// z_2 += 1; at i = L z_L −= 1 and z_{L−1} += 1. The order of topplings does not matter; the numbers of a threshold belong to
/// its site and to how often that toppled, so they do not depend on it either.
class Pile final : public SavedModel<Pile> {
 public:
  explicit Pile(const PileSetup& setup);

  void update(std::int64_t update) override;
  void show(Grains<2>& grains) const override;
  std::vector<std::pair<std::string, double>> tells() const override;
  std::vector<Avalanche> take_avalanches() override { return std::exchange(avalanches_, {}); }

  std::size_t length() const { return sites_.size(); }
  int slope(std::size_t i) const { return sites_[i].z; }
  int threshold(std::size_t i) const { return sites_[i].z_c; }
  std::int64_t topplings() const { return topplings_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(kept(sites_), kept(drawn_), topplings_, last_);
  }

 private:
  PileSetup setup_;
  struct Site {
    int z = 0, z_c = 0;
    std::uint64_t bits = 1;  // random bits still to be used, the next one lowest, below a leading 1
    template <class Archive>
    void serialize(Archive& archive) {
      archive(z, z_c, bits);
    }
  };
  std::vector<Site> sites_;
  std::vector<std::int64_t> drawn_;   // random words that each site has taken
  std::vector<std::uint32_t> steep_;  // sites above their thresholds, each once
  std::int64_t topplings_ = 0, last_ = 0;
  std::vector<Avalanche> avalanches_;

  void draw(std::size_t i);
  void take_word(std::size_t i);
  std::int64_t relax();
};

}  // namespace chute::automaton
