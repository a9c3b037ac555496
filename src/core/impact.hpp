#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/wrong_state.hpp"
#include "core/vec.hpp"

namespace chute {

/// What is not known: the flight before a grain's first impact.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The begin of a contact, as it was just before any force acted. `bead` is the grain that was hit: the fixed
/// one, of two moving grains the one with the lower id, or a wall (core/contact.hpp: wall_id).
struct Impact {
  double time;
  std::int64_t grain, bead;
  std::array<double, 3> place;  ///< where the surfaces met
  double gamma;  ///< angle between the incline's normal and the line from bead to grain; > 0 downhill
  double phi;    ///< azimuth of that line about the incline's normal; 0 or ±π side in 3D, 0 in 2D
  double v_n;    ///< relative normal velocity (1.13), < 0 on approach
  double v_t;    ///< relative translational velocity along the surface, downhill positive in 2D
  double flight = unknown;        ///< time since the grain lost touch with the last that it touched; 0 if it
                                  ///< touches another grain now; NaN: it touched none yet
  double gamma_before = unknown;  ///< gamma of the same grain's impact before; NaN: this is its first
  bool rolling = false;           ///< rolling contact made up again, not a bounce: see TouchLog

  template <class Archive>
  void serialize(Archive& a) {
    a(time, grain, bead, place, gamma, phi, v_n, v_t, flight, gamma_before, rolling);
  }
};

/// The end of a contact, as it was just after the last force acted; the rest is as in Impact.
struct Parting {
  double time;
  std::int64_t grain, bead;
  double v_n;            ///< > 0: they part
  bool rolling = false;  ///< of hard grains: a collision within a train, so not the end of a bounce
};

/// What geometry tells of an impact: `n` leads from the bead to the grain, `v` is the grain's velocity
/// relative to the bead's, `place` where they meet. In 2D v_t counts along s = (n_y, −n_x): downhill at the
/// top of a bead.
template <int D>
Impact impact_at(double time, const Vec<D>& n, const Vec<D>& v, const Vec<D>& place) {
  Impact impact{};
  impact.time = time;
  for (int k = 0; k < D; ++k) impact.place[static_cast<std::size_t>(k)] = place[k];
  impact.v_n = dot(v, n);
  if constexpr (D == 2) {
    impact.gamma = std::atan2(n[0], n[1]);
    impact.v_t = v[0] * n[1] - v[1] * n[0];
  } else {
    impact.gamma = std::acos(std::clamp(n[2], -1.0, 1.0));
    impact.phi = std::atan2(n[1], n[0]);
    impact.v_t = norm(v - impact.v_n * n);
  }
  return impact;
}

/// Which contacts are one rolling contact, for every engine: two grains that meet again less than this many
/// contact times (t_n of (3.3); t_c of hard grains) after they parted have not bounced; they roll. Such a hop
/// is at most 2 g t_n² high: 20 µm at t_n = 1 ms. Hard grains, whose rolling is a train of collisions, do
/// not even report its members as impacts.
inline constexpr double rolling_ends = 4;

/// Remembers of every moving grain when it last touched something, so that an impact can be told the flight
/// before it, and rolling from bouncing.
class TouchLog {
 public:
  TouchLog() = default;
  /// `contact_time`, s: t_n or t_c; with 0 nothing counts as rolling.
  TouchLog(std::size_t moving, double contact_time) : grains_(moving), contact_time_(contact_time) {}

  /// A contact begins that is no impact: it was there before anybody looked.
  void touch(std::size_t i, std::size_t j) {
    for (const auto k : {i, j})
      if (k < grains_.size()) ++grains_[k].touching;
  }

  /// A contact begins: completes the impact.
  void begin(Impact& impact) {
    const auto grain = static_cast<std::size_t>(impact.grain), bead = static_cast<std::size_t>(impact.bead);
    Grain& g = grains_[grain];
    impact.flight = g.touching > 0 || impact.time < g.held_until ? 0 : impact.time - g.left;
    impact.gamma_before = g.gamma;
    g.gamma = impact.gamma;
    for (const Parting& p : grains_[std::min(grain, bead)].partings)
      if (p.other == std::max(grain, bead)) impact.rolling = impact.time - p.time < reach();
    touch(grain, bead);
  }

  /// The contact of i and j ends at `time`.
  void end(double time, std::size_t i, std::size_t j) {
    for (const auto k : {i, j})
      if (k < grains_.size()) --grains_[k].touching, grains_[k].left = time;
    auto& partings = grains_[std::min(i, j)].partings;
    std::erase_if(partings,
                  [&](const Parting& p) { return !(time - p.time < reach()) || p.other == std::max(i, j); });
    if (contact_time_ > 0) partings.push_back({static_cast<std::uint64_t>(std::max(i, j)), time});
  }

  /// Hard grains that roll: i and j hit each other again at `time`, and are in touch until the train ends.
  void hold(double time, std::size_t i, std::size_t j) {
    for (const auto k : {i, j})
      if (k < grains_.size()) grains_[k].left = time, grains_[k].held_until = time + reach();
  }

  template <class Archive>
  void serialize(Archive& a) {
    const auto grains = grains_.size();
    a(grains_);
    if (grains_.size() != grains) wrong_state();
  }

 private:
  struct Parting {
    std::uint64_t other;  ///< the grain with the higher id
    double time;
    template <class Archive>
    void serialize(Archive& a) {
      a(other, time);
    }
  };
  struct Grain {
    int touching = 0;
    double left = unknown;  ///< when it last lost touch
    double held_until = -std::numeric_limits<double>::infinity();
    double gamma = unknown;  ///< of its last impact
    std::vector<Parting> partings;
    template <class Archive>
    void serialize(Archive& a) {
      a(touching, left, held_until, gamma, partings);
    }
  };
  std::vector<Grain> grains_;
  double contact_time_ = 0;

  double reach() const { return rolling_ends * contact_time_; }
};

}  // namespace chute
