#include "engines/soft/bounce.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engines/soft/soft_engine.hpp"

namespace chute::soft {
namespace {

/// Two grains on a line, in the engine, from shortly before they meet until they have parted.
class Bounce {
 public:
  Bounce(const laws::ContactLaws& contact, const laws::Pair& pair, double speed, double contact_time,
         const Stepping& stepping)
      : pair_(pair), speed_(speed), contact_time_(contact_time), dt_(stepping.time_step) {
    setup_.laws = contact;
    setup_.scheme = stepping.scheme;
    setup_.ends = stepping.ends;
    setup_.time_step = dt_;
    setup_.contact_time = contact_time;
    setup_.deepest_overlap = std::numeric_limits<double>::max();
    setup_.skins = usual_skins<2>(4 * pair.r_eff);
    setup_.many.tiles = false;
  }

  /// e_n if the contact begins that part of a step after one.
  std::optional<double> restitution(double part) const {
    const double radius = 2 * pair_.r_eff, mass = 2 * pair_.m_eff;
    constexpr double steps_before = 3;
    const double way = 2 * radius + speed_ * dt_ * (steps_before + part);
    Grains<2> grains;
    for (const double x : {0.0, way}) grains.add({{x, 0}}, radius, mass, 0.4 * mass * radius * radius, true);
    grains.velocity[0][0] = speed_;
    SoftEngine<2> engine(std::move(grains), setup_);
    constexpr double longest = 4;  // contact times
    const auto most = static_cast<std::int64_t>(longest * contact_time_ / dt_ + 2 * steps_before);
    bool touched = false;
    // gear5's higher derivatives go on changing the velocity for some steps.
    constexpr int steps_after = 8;
    for (int apart = 0; engine.step() < most + steps_after;) {
      engine.advance_to(engine.step() + 1);
      const bool touch = !engine.contacts().empty();
      touched = touched || touch;
      apart = touched && !touch ? apart + 1 : 0;
      if (apart == steps_after) {
        const auto& v = engine.state().velocity[0];
        return (v[1] - v[0]) / speed_;
      }
    }
    return {};
  }

 private:
  laws::Pair pair_;
  double speed_, contact_time_, dt_;
  SoftSetup<2> setup_{};
};

}  // namespace

std::optional<BounceError> bounce_error(const laws::ContactLaws& contact, const laws::Pair& pair,
                                        double speed, const laws::NormalImpact& impact,
                                        const Stepping& stepping) {
  constexpr double most_steps = 1000;
  const double steps = impact.contact_time / stepping.time_step;
  if (!(steps > 1 && steps < most_steps && pair.r_eff > 0)) return {};
  const Bounce bounce(contact, pair, speed, impact.contact_time, stepping);
  constexpr int moments = 16;
  BounceError error{};
  for (int k = 0; k < moments; ++k) {
    const auto e = bounce.restitution((k + 0.5) / moments);
    if (!e) return {};
    error.mean += (*e - impact.restitution) / moments;
    error.worst = std::max(error.worst, std::abs(*e - impact.restitution));
  }
  return error;
}

}  // namespace chute::soft
