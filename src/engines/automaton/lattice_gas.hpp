#pragma once
#include <cereal/types/vector.hpp>

#include "core/team.hpp"
#include "engines/automaton/links.hpp"
#include "engines/automaton/model.hpp"
#include "engines/automaton/philox_row.hpp"
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
/// Sites are bytes, rows lie with a column of the other end's sites on both sides, and an update goes over them twice: in
/// place through the table, and on to the second array. Rows are shared out among threads; the random words of a row are a
/// function of row and update.
class LatticeGas final : public SavedModel<LatticeGas> {
 public:
  explicit LatticeGas(const LatticeGasSetup& setup);

  void update(std::int64_t update) override;
  void show(Grains<2>& grains) const override;
  std::vector<std::pair<std::string, double>> tells() const override;
  Energy energy() const override;

  const Lattice& lattice() const { return setup_.lattice; }
  Site at(int x, int y) const { return now_[row(y) + static_cast<std::size_t>(x) + edge]; }
  void set(int x, int y, Site site) { now_[row(y) + static_cast<std::size_t>(x) + edge] = site; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(kept(now_), lost_, crossed_);
  }

 private:
  static constexpr std::size_t edge = 1;
  LatticeGasSetup setup_;
  Isa isa_ = best_isa();
  SiteTable table_;
  Links links_;
  std::size_t stride_;
  std::vector<Site> now_, next_, empty_;  // the last: what lies beyond closed ends
  std::vector<std::vector<Site>> kept_;   // what walls send back, for each site of links_.of_row
  std::vector<std::int64_t> row_lost_, row_crossed_;
  std::int64_t lost_ = 0;     // movers brought to rest so far
  std::int64_t crossed_ = 0;  // of the last update: grains that went over x = 0 downhill, less those uphill
  std::vector<std::vector<std::uint32_t>> words_;  // of each thread
  Team team_;

  std::size_t row(int y) const { return static_cast<std::size_t>(y) * stride_; }
  void fill();
  void collide_row(int y, std::int64_t update, std::span<std::uint32_t> words);
  void turn_back(int y, std::int64_t update);
  void stream_row(int y);
};

}  // namespace chute::automaton
