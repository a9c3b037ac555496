#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engines/hard/flight.hpp"

namespace chute::event {

using hard::Flight;

/// Who may meet whom: every moving grain's list of those near it. A grain has a post, a place that stays, and a list
/// holds all whose posts are so near that they can touch while neither is farther than the `leash` from its own. When a
/// grain comes to the end of its leash, which is known ahead, it gets a new post where it is: only then cells are
/// looked at, which hold posts and so never change in between.
///
/// Where the domain is not periodic the outermost cells reach to infinity.
template <int D>
class NearGrains {
 public:
  /// `image`: by how many periods the other's post must be moved to be seen from one's own.
  struct Near {
    std::int32_t other;
    std::array<std::int8_t, D> image;
    bool operator==(const Near&) const = default;
  };

  /// Lays the cells around the grains' places at time `now`, and gives each a post. No period may be shorter than twice
  /// the largest R_i + R_j of a pair that feels each other. The first `moving` grains move; where they are
  /// `independent`, they do not feel each other.
  void build(const std::vector<Flight<D>>& flights, const Domain<D>& domain, std::size_t moving,
             bool independent, double now);

  std::span<const Near> of(std::size_t i) const {
    return {near_.data() + posts_[i].begin, static_cast<std::size_t>(posts_[i].count)};
  }
  /// By how many periods the other's flight must be moved to be seen from i's; mostly by none.
  bool is_shifted(std::size_t i, const Near& near) const {
    int image = 0;  // in so many words: compilers call a function to compare these few bytes
    for (const auto periods : near.image) image |= periods;
    return (image | lapped_[i] | lapped_[static_cast<std::size_t>(near.other)]) != 0;
  }
  std::array<int, D> shift(std::size_t i, const Near& near) const {
    std::array<int, D> s;
    const auto &mine = posts_[i].laps, &theirs = posts_[static_cast<std::size_t>(near.other)].laps;
    for (std::size_t k = 0; k < D; ++k) s[k] = near.image[k] + mine[k] - theirs[k];
    return s;
  }

  /// A time up to which grain i surely stays on its leash; not before `now`.
  double leaves(std::size_t i, const Flight<D>& flight, double now) const;
  /// At that time: a new post, unless the grain turned out to be well inside. Tells whether the list is another.
  bool follow(std::size_t i, const Flight<D>& flight, double now);
  /// To be called with what Flight::move_to took off.
  void unwind(std::size_t i, const std::array<int, D>& periods) {
    if (periods == std::array<int, D>{}) return;
    for (std::size_t k = 0; k < D; ++k) posts_[i].laps[k] -= periods[k];
    lapped_[i] = posts_[i].laps != std::array<int, D>{};
  }

  /// Whether so many moving grains left the box that the cells should be laid anew: results do not depend on
  /// it, cost does.
  bool outgrown(const std::vector<Flight<D>>& flights, double now) const;
  double leash() const { return leash_; }

 private:
  using Cell = std::array<int, D>;
  struct alignas(64) Post {
    Vec<D> place{};             // inside the domain
    std::array<int, D> laps{};  // periods from there to where the flight is
    std::int32_t cell = 0;
    std::size_t begin = 0;  // of its list, if it moves
    std::int32_t count = 0, room = 0;
  };
  static constexpr std::int32_t none = -1;

  Domain<D> domain_;
  std::size_t moving_ = 0;
  bool independent_ = false;
  double leash_ = 0, widest_ = 0;  // `widest`: the largest radius
  std::vector<double> radius_;
  std::vector<Post, CacheAligned<Post>> posts_;
  std::vector<std::uint8_t> lapped_;  // is any of its laps not 0?
  std::vector<Near> near_;            // the lists, each with room to grow
  Vec<D> lower_{}, width_{};
  Cell count_{};
  std::vector<std::int32_t> first_, next_, previous_;  // grains of a cell, chained

  void lay_cells();
  void fill(std::size_t expected);
  double reach(std::size_t i, std::size_t j) const;
  Vec<D> from_post(std::size_t i, const Flight<D>& flight, double now) const;
  void put_post(std::size_t i, const Flight<D>& flight, double now);
  Cell cell_at(const Vec<D>& place) const;
  std::size_t flat(const Cell& c) const {
    std::size_t n = 0;
    for (std::size_t k = 0; k < D; ++k)
      n = n * static_cast<std::size_t>(count_[k]) + static_cast<std::size_t>(c[k]);
    return n;
  }
  void insert(std::size_t i);
  void remove(std::size_t i);
  void add(std::size_t i, const Near& near);
  template <class Visit>
  void around(std::size_t i, const Visit& visit) const;
};

}  // namespace chute::event
