#pragma once
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/seed_seq.hpp>
#include <boost/random/uniform_01.hpp>
#include <cstdint>

namespace chute {

/// What a stream of random numbers is for. Each purpose has a stream of its own, so that asking one for more
/// numbers does not change the others: the same seed gives the same bed under another start.
enum class Purpose : std::uint32_t { bed = 1, sizes = 2, start = 3, stochastic = 4, bootstrap = 5 };

/// A stream of random numbers fixed by a scene's seed and a purpose. Boost's distributions, unlike the
/// standard library's, are the same numbers on every platform.
class Random {
 public:
  Random(std::uint64_t seed, Purpose purpose) {
    const auto words = {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                        static_cast<std::uint32_t>(purpose)};
    boost::random::seed_seq sequence(words);
    engine_.seed(sequence);
  }
  double uniform() { return boost::random::uniform_01<double>{}(engine_); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double normal() { return normal_(engine_); }

 private:
  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> normal_;
};

}  // namespace chute
