#include "engines/automaton/bit_planes.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/random.hpp"
#include "engines/automaton/lattice.hpp"

namespace chute::automaton {
namespace {

/// A bit for each site of a block. A vector of the compiler's, so that one line is one instruction where the processor has
/// registers so wide.
using Bits = std::uint64_t __attribute__((vector_size(8 * words_of_block), aligned(8), may_alias));

constexpr Bits none{};

inline bool any(const Bits& b) {
  return ((b[0] | b[1]) | (b[2] | b[3]) | (b[4] | b[5]) | (b[6] | b[7])) != 0;
}
inline std::int64_t count(const Bits& b) {
  std::int64_t sum = 0;
  for (std::size_t w = 0; w < words_of_block; ++w) sum += std::popcount(b[w]);
  return sum;
}

/// Random bits, four blocks of them at a time: sixteen Philox blocks side by side. Salmon et al. 2011: ten rounds of two
/// multiplications, whose upper halves are mixed with the other words and the key, which grows by constants.
class BitSource {
 public:
  explicit BitSource(const RowChances& of)
      : key0_(static_cast<std::uint32_t>(of.seed)),
        key1_(static_cast<std::uint32_t>(of.seed >> 32)),
        row_(of.row),
        step_(static_cast<std::uint32_t>(of.step)),
        last_(static_cast<std::uint32_t>(of.step >> 32) << 8 | static_cast<std::uint32_t>(Purpose::engine)) {}

  Bits operator()() {
    if (left_ == 0) draw();
    return made_[--left_];
  }

 private:
  static constexpr std::size_t lanes = 16, words = 4;
  std::uint32_t key0_, key1_, row_, step_, last_;
  std::uint32_t number_ = 0;
  std::size_t left_ = 0;
  alignas(64) Bits made_[words] = {};

  void draw() {
    constexpr std::uint32_t m0 = 0xD2511F53u, m1 = 0xCD9E8D57u, w0 = 0x9E3779B9u, w1 = 0xBB67AE85u;
    alignas(64) std::uint32_t a[lanes], b[lanes], c[lanes], d[lanes];
    for (std::uint32_t k = 0; k < lanes; ++k) a[k] = number_ + k, b[k] = row_, c[k] = step_, d[k] = last_;
    number_ += lanes;
    std::uint32_t k0 = key0_, k1 = key1_;
    for (int round = 0; round < 10; ++round, k0 += w0, k1 += w1) {
      CHUTE_VECTOR_LOOP
      for (std::size_t k = 0; k < lanes; ++k) {
        const std::uint64_t p0 = std::uint64_t{m0} * a[k], p1 = std::uint64_t{m1} * c[k];
        a[k] = static_cast<std::uint32_t>(p1 >> 32) ^ b[k] ^ k0;
        c[k] = static_cast<std::uint32_t>(p0 >> 32) ^ d[k] ^ k1;
        b[k] = static_cast<std::uint32_t>(p1);
        d[k] = static_cast<std::uint32_t>(p0);
      }
    }
    std::memcpy(&made_[0], a, sizeof a);
    std::memcpy(&made_[1], b, sizeof b);
    std::memcpy(&made_[2], c, sizeof c);
    std::memcpy(&made_[3], d, sizeof d);
    left_ = words;
  }
};

/// Which of these sites an event of probability below/2³² happens at: a random number is compared with `below`, bit by bit
/// from the highest, until no site is in doubt.
inline Bits happens(std::uint64_t below, const Bits& where, BitSource& source) {
  if (below >> 32) return where;
  Bits yes = none, open = where;
  for (auto rest = static_cast<std::uint32_t>(below); rest != 0 && any(open); rest <<= 1) {
    const Bits drawn = source();
    if (rest >> 31) {
      yes |= open & ~drawn;
      open &= drawn;
    } else {
      open &= ~drawn;
    }
  }
  return yes;
}

/// Counts up to 15 in binary, site by site.
struct Counter {
  Bits ones = none, twos = none, fours = none, eights = none;
  void add(const Bits& b) {
    const Bits to_twos = ones & b;
    ones ^= b;
    const Bits to_fours = twos & to_twos;
    twos ^= to_twos;
    eights |= fours & to_fours;
    fours ^= to_fours;
  }
};

/// A number evenly from 0 to n − 1 at each of these sites, n ≥ 1 being counted: three bits are drawn, of them as many
/// as n − 1 has are kept, and drawn again where they make more than that.
struct Rank {
  Bits ones = none, twos = none, fours = none;

  Rank(const Counter& n, const Bits& where, BitSource& source) {
    const Bits d0 = ~n.ones, d1 = n.twos ^ d0, d2 = n.fours ^ (~n.twos & d0);  // n − 1
    const Bits two_bits = d2 | d1, one_bit = two_bits | d0;
    for (Bits open = where & one_bit; any(open);) {
      const Bits r0 = source();
      Bits r1 = none, r2 = none;
      if (any(open & two_bits)) r1 = source() & two_bits;
      if (any(open & d2)) r2 = source() & d2;
      ones = (ones & ~open) | (r0 & open), twos = (twos & ~open) | (r1 & open);
      fours = (fours & ~open) | (r2 & open);
      open &= (r2 & ~d2) | (~(r2 ^ d2) & ((r1 & ~d1) | (~(r1 ^ d1) & (r0 & ~d0))));
    }
  }
  /// Those of `here` that it falls on; elsewhere where something is it counts down. A site is hit once: its rank is then
  /// below 0, which is far from 0.
  Bits hits(const Bits& here) {
    const Bits hit = here & ~(ones | twos | fours);
    const Bits from_twos = here & ~ones, from_fours = from_twos & ~twos;
    ones ^= here, twos ^= from_twos, fours ^= from_fours;
    return hit;
  }
};

}  // namespace

/// One row. Directions count modulo 6.
struct PlaneKernel {
  const PlaneRule& rule;
  const PlaneRow& row;
  const RowChances& chances;
  std::int64_t* lost;

  struct Sites {
    Bits m[directions];
    Bits r0, r1;  // how many rest: r0 + 2 r1
    Bits& mover(int k) { return m[(k + directions) % directions]; }
    void rests_more(const Bits& where) {
      r1 ^= where & r0;
      r0 ^= where;
    }
    void rests_fewer(const Bits& where) {
      r0 = (r0 & ~where) | (r1 & where);
      r1 &= ~where;
    }
  };

  /// Seen as three pairs of opposite directions, of which each has both movers, none, or one: momentum and number stay
  /// where "both" and "none" change places among the pairs, and where three single movers 120° apart all turn back.
  static void collide(Sites& s, BitSource& source) {
    auto& m = s.m;
    const Bits both[3] = {m[0] & m[3], m[1] & m[4], m[2] & m[5]};
    const Bits free[3] = {~(m[0] | m[3]), ~(m[1] | m[4]), ~(m[2] | m[5])};
    Bits swap[3];  // pairs beside a single mover j, one full and one free
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t a = (j + 1) % 3, b = (j + 2) % 3;
      swap[j] = ~(both[j] | free[j]) & ((both[a] & free[b]) | (free[a] & both[b]));
    }
    const Bits turn =
        (m[0] & m[2] & m[4] & ~(m[1] | m[3] | m[5])) | (m[1] & m[3] & m[5] & ~(m[0] | m[2] | m[4]));
    if (any(swap[0] | swap[1] | swap[2] | turn)) {
      const Bits half = source();
      const Bits back = turn & half;
      for (std::size_t j = 0; j < 3; ++j) {
        const Bits flip = back | (half & (swap[(j + 1) % 3] | swap[(j + 2) % 3]));
        m[j] ^= flip, m[j + 3] ^= flip;
      }
    }
    const Bits one_full =
        (both[0] & free[1] & free[2]) | (free[0] & both[1] & free[2]) | (free[0] & free[1] & both[2]);
    const Bits one_free =
        (free[0] & both[1] & both[2]) | (both[0] & free[1] & both[2]) | (both[0] & both[1] & free[2]);
    const Bits three = one_full | one_free;
    if (!any(three)) return;
    // Which of the three pairs is the odd one: two bits, drawn again where they make 3.
    Bits b0 = none, b1 = none;
    for (Bits open = three; any(open);) {
      const Bits d0 = source(), d1 = source();
      b0 = (b0 & ~open) | (d0 & open), b1 = (b1 & ~open) | (d1 & open);
      open &= d0 & d1;
    }
    const Bits odd[3] = {~(b0 | b1), b0, b1};
    for (std::size_t j = 0; j < 3; ++j) {
      const Bits full = (one_full & odd[j]) | (one_free & ~odd[j]);
      m[j] = (m[j] & ~three) | full, m[j + 3] = (m[j + 3] & ~three) | full;
    }
  }

  static std::int64_t dissipate(Sites& s, std::uint64_t chance, BitSource& source) {
    const auto& m = s.m;  // of before: ways are computed before any happens
    const Bits at_most_one = ~s.r1, nobody = at_most_one & ~s.r0;
    Bits ways[3 + directions];
    for (std::size_t j = 0; j < 3; ++j) ways[j] = m[j] & m[j + 3] & nobody;
    for (std::size_t k = 0; k < directions; ++k)
      ways[3 + k] = m[(k + 5) % 6] & m[(k + 1) % 6] & ~m[k] & at_most_one;
    Counter n;
    for (const auto& way : ways) n.add(way);
    const Bits where = happens(chance, n.ones | n.twos | n.fours, source);
    if (!any(where)) return 0;
    Rank rank(n, where, source);
    std::int64_t brought_to_rest = 0;
    for (std::size_t way = 0; way < 3 + directions; ++way) {
      const Bits now = rank.hits(ways[way]) & where;
      if (way < 3) {
        s.m[way] ^= now, s.m[way + 3] ^= now;
        s.r1 |= now;
        brought_to_rest += 2 * count(now);
      } else {
        const std::size_t k = way - 3;
        s.m[(k + 5) % 6] ^= now, s.m[(k + 1) % 6] ^= now, s.m[k] ^= now;
        s.rests_more(now);
        brought_to_rest += count(now);
      }
    }
    return brought_to_rest;
  }

  void accelerate(Sites& s, BitSource& source) const {
    if (rule.pulls_.empty()) return;
    Counter n;
    for (const auto& m : s.m) n.add(m);
    n.add(s.r0 | s.r1), n.add(s.r1);
    Bits where = happens(rule.gravity_.below, n.ones | n.twos | n.fours | n.eights, source);
    if (!any(where)) return;
    Rank rank(n, where, source);
    Bits moves[directions];
    for (std::size_t k = 0; k < directions; ++k) moves[k] = rank.hits(s.m[k]) & where;
    const Bits rests = (rank.hits(s.r0 | s.r1) | rank.hits(s.r1)) & where;
    for (const auto& pull : rule.pulls_) {
      const Bits here = happens(pull.chance.below, where, source);
      where &= ~here;
      const int G = pull.direction;
      const auto drawn = [&](int k) {
        return moves[static_cast<std::size_t>((k + directions) % directions)] & here;
      };
      const Bits starts = rests & here & ~s.mover(G);
      s.mover(G) ^= starts;
      s.rests_fewer(starts);
      for (const int side : {1, -1}) {
        const Bits turns = drawn(G + 2 * side) & ~s.mover(G + side);
        s.mover(G + 2 * side) ^= turns, s.mover(G + side) ^= turns;
      }
      const Bits stops = drawn(G + 3) & ~s.r1;
      s.mover(G + 3) ^= stops;
      s.rests_more(stops);
    }
  }

  void operator()() const {
    BitSource source(chances);
    std::int64_t sum = 0;
    for (std::size_t block = 0; block < row.blocks; ++block) {
      const auto at = [&](int k) {
        return reinterpret_cast<Bits*>(row.words + static_cast<std::size_t>(k) * row.stride +
                                       block * words_of_block);
      };
      Sites s;
      for (int k = 0; k < directions; ++k) s.m[static_cast<std::size_t>(k)] = *at(k);
      s.r0 = *at(6), s.r1 = *at(7);
      collide(s, source);
      sum += dissipate(s, rule.dissipation_.below, source);
      accelerate(s, source);
      for (int k = 0; k < directions; ++k) *at(k) = s.m[static_cast<std::size_t>(k)];
      *at(6) = s.r0, *at(7) = s.r1;
    }
    *lost = sum;
  }
};

PlaneRule::PlaneRule(const SiteRule& rule) {
  const auto chance = [](double p) { return Chance{static_cast<std::uint64_t>(std::llround(p * 0x1p32))}; };
  dissipation_ = chance(rule.dissipation), gravity_ = chance(rule.gravity);
  double left = 1;
  for (const auto& pull : rule.pulls) {
    // The last takes all that is left, whatever rounding says.
    pulls_.push_back({pull.direction, chance(&pull == &rule.pulls.back() ? 1 : pull.weight / left)});
    left -= pull.weight;
  }
}

std::int64_t PlaneRule::apply(Isa isa, const PlaneRow& row, const RowChances& chances) const {
  std::int64_t lost = 0;
  run_kernel(isa, PlaneKernel{*this, row, chances, &lost});
  return lost;
}

}  // namespace chute::automaton
