#pragma once
#include <array>
#include <cereal/types/array.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "core/world.hpp"

namespace chute::soft {

/// A grain that comes in now.
template <int D>
struct Arrival {
  Newcomer grain;
  Vec<D> place, velocity;
};

/// Who comes in and who leaves, when, and what they brought and took so far (core/inflow.hpp). Both happen after whole steps that
/// follow from the scene, and what is drawn by chance is a function of seed, grain and step: so the same grains come and go
/// wherever a run was stopped in between.
template <int D>
class Exchange {
 public:
  Exchange(const Surroundings<D>& around, double time_step);

  bool any() const { return inflow_.has_value() || outflow_.has_value(); }
  /// The first step after this one after which somebody may come or go.
  std::int64_t next_after(std::int64_t step) const;
  bool lets_out_after(std::int64_t step) const { return outflow_ && step % steps_out_ == 0; }
  bool lets_in_after(std::int64_t step) const {
    return inflow_ && step % steps_in_ == 0 && waiting(step) > 0;
  }

  bool leaves(const Grains<D>& grains, std::size_t i) const;
  /// Notes that grain i leaves, with what it is and does.
  void let_out(const Grains<D>& grains, std::size_t i);
  /// Those for whom there is room among these grains, after this step; they have come in then.
  std::vector<Arrival<D>> let_in(const Grains<D>& grains, std::int64_t step);

  std::int64_t entered() const { return entered_; }
  /// How many should have come in by now, and have not.
  std::int64_t waiting(std::int64_t step) const;
  /// All of it by name, with how many moving grains there are now.
  std::vector<std::pair<std::string, double>> tells(std::size_t moving, std::int64_t step) const;

  template <class Archive>
  void serialize(Archive& a) {
    a(entered_, left_, mass_in_, mass_out_, momentum_in_, momentum_out_);
  }

 private:
  using Momentum = std::array<double, static_cast<std::size_t>(D)>;
  std::optional<Inflow<D>> inflow_;
  std::optional<Outflow> outflow_;
  Domain<D> domain_;
  std::vector<Wall<D>> walls_;
  double dt_;
  std::int64_t steps_in_ = 1, steps_out_ = 1;
  std::int64_t entered_ = 0, left_ = 0;
  double mass_in_ = 0, mass_out_ = 0;
  Momentum momentum_in_{}, momentum_out_{};

  struct Ball {
    Vec<D> place;
    double radius;
  };
  std::vector<Ball> near_box(const Grains<D>& grains) const;
  std::optional<Vec<D>> find_room(const std::vector<Ball>& near, double radius, double time,
                                  Random& random) const;
};

}  // namespace chute::soft
