#pragma once
#include <cereal/types/vector.hpp>

#include "core/team.hpp"
#include "engines/automaton/bit_planes.hpp"
#include "engines/automaton/links.hpp"
#include "engines/automaton/model.hpp"
#include "engines/automaton/site_rule.hpp"

namespace chute::automaton {

/// What a lattice gas starts from.
struct LatticeGasSetup {
  Lattice lattice;
  std::vector<Wall<2>> walls;
  SiteRule rule;
  double reversal =
      0.5;  ///< b: at walls all movers of a site turn back with this probability, else they are mirrored
  double density = 1;  ///< mean movers of a site at the start, at most 6, with random directions
  double fill_low = 0, fill_high = 1e300;  ///< heights between which sites are filled
  std::uint64_t seed = 1;
  int threads = 1;
};

/// Grains that move on a triangular lattice, lose energy when they meet, and are pulled by gravity: the lattice gas of Peng
/// and Herrmann, Phys. Rev. E 49, R1796 (1994). An update collides, dissipates and accelerates at every site (site_rule.hpp),
/// and then all movers go on to the next sites; walls send them back.
///
/// Sites are bits of planes (bit_planes.hpp), and an update goes over them twice: in place through the rule, and on to the
/// second array. Rows are shared out among threads; the random bits of a row are a function of row and update, and of what
/// is in it.
class LatticeGas final : public SavedModel<LatticeGas> {
 public:
  explicit LatticeGas(const LatticeGasSetup& setup);

  void update(std::int64_t update) override;
  void show(Grains<2>& grains) const override;
  std::vector<std::pair<std::string, double>> tells() const override;
  Energy energy() const override;

  const Lattice& lattice() const { return setup_.lattice; }
  Site at(int x, int y) const {
    unsigned site = 0;
    for (int k = 0; k < planes; ++k) site |= static_cast<unsigned>(*plane(y, k, x) >> (x & 63) & 1) << k;
    return static_cast<Site>(site);
  }
  void set(int x, int y, Site site) {
    for (int k = 0; k < planes; ++k) {
      auto& word = now_[index(y, k, x)];
      word = (word & ~(std::uint64_t{1} << (x & 63))) | std::uint64_t{site >> k & 1u} << (x & 63);
    }
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(kept(now_), lost_, crossed_);
  }

 private:
  LatticeGasSetup setup_;
  Isa isa_ = best_isa();
  PlaneRule rule_;
  Links links_;
  std::size_t stride_;  // words of a row's plane, whole blocks
  std::vector<std::uint64_t> now_, next_,
      empty_;                            // by row, plane, place; the last: what lies beyond closed ends
  std::vector<std::vector<Site>> kept_;  // what walls send back, for each site of links_.of_row
  std::vector<std::int64_t> row_lost_, row_crossed_;
  std::int64_t lost_ = 0;     // movers brought to rest so far
  std::int64_t crossed_ = 0;  // of the last update: grains that went over x = 0 downhill, less those uphill
  Team team_;

  std::size_t index(int y, int k, int x) const {
    return (static_cast<std::size_t>(y) * planes + static_cast<std::size_t>(k)) * stride_ +
           static_cast<std::size_t>(x) / sites_of_word;
  }
  const std::uint64_t* plane(int y, int k, int x = 0) const { return &now_[index(y, k, x)]; }
  bool has(int x, int y, int k) const { return *plane(y, k, x) >> (x & 63) & 1; }
  struct Totals {
    std::int64_t moving = 0, resting = 0;
    Vec<2> momentum{};
  };
  Totals totals() const;
  void fill();
  void collide_row(int y, std::int64_t update);
  void turn_back(int y, std::int64_t update);
  void stream_row(int y);
};

}  // namespace chute::automaton
