#include "engines/restructuring/placing.hpp"

#include <numbers>

namespace chute::restructuring {
namespace {

/// Below this sine a direction is level: no way down is preferred, or a contact carries nothing.
constexpr double level = 1e-9;

template <int D>
Vec<D> unit(const Vec<D>& v) {
  return (1 / norm(v)) * v;
}
template <int D>
Vec<D> downwards() {
  Vec<D> v{};
  v[D - 1] = -1;
  return v;
}

}  // namespace

template <int D>
Vec<D> Placer<D>::Arc::at(const Turn& t) const {
  return centre + radius * unit(direction(t));
}

template <int D>
bool Placer<D>::touches(const Placed<D>& grain) const {
  for (const auto& t : touching_)
    if (t.grain.id == grain.id && t.grain.place == grain.place) return true;
  return false;
}

template <int D>
Placed<D> Placer<D>::drum() const {
  Placed<D> wall;
  for (int k = 0; k < 2; ++k) wall.place[k == 0 ? 0 : D - 1] = bounds_.drum->centre[k];
  wall.radius = bounds_.drum->radius, wall.id = drum_id;
  return wall;
}

/// Is the wall, whose normal this is, so level here that it holds the grain alone?
template <int D>
bool Placer<D>::held_by_drum(const Vec<D>& normal) const {
  return normal[D - 1] > 0 && std::abs(normal[0]) <= bounds_.drum->steepest * normal[D - 1] + level;
}

/// From no higher than the drum's wall above it. Where grains lie up to there, one that is to fall comes in nearer to the
/// drum's top instead: along the wall, at the first place where it has room; then it touches what was in its way.
template <int D>
typename Placer<D>::Entry Placer<D>::enter_drum(double& from) {
  const Vec<D> middle = drum().place;
  const double rho = room();
  place_[0] = std::clamp(place_[0], middle[0] - rho, middle[0] + rho);
  const double aside = place_[0] - middle[0], side = aside < 0 ? -1 : 1;
  double angle = std::acos(std::min(1.0, std::abs(aside) / rho));  // above the horizontal
  const double ceiling = middle[D - 1] + rho * std::sin(angle);
  if (from < ceiling) return Entry::free;
  place_[D - 1] = from = ceiling;
  for (int tries = 0; tries < most_events; ++tries) {
    double next = angle;
    Placed<D> blocking;
    columns_.near({place_, 0}, radius_, [&](const Placed<D>& grain) {
      const Vec<D> way = grain.place - middle;
      const double q = norm(way), contact = reach(grain);
      if (norm(place_ - grain.place) >= (1 - yielding) * contact || q == 0) return;
      const double cosine = (rho * rho + q * q - contact * contact) / (2 * rho * q);
      const double beyond = std::atan2(way[D - 1], side * way[0]) + std::acos(std::clamp(cosine, -1.0, 1.0));
      if (beyond > next) next = beyond, blocking = grain;
    });
    if (next == angle) return tries == 0 ? Entry::free : Entry::wedged;
    if (next > std::numbers::pi / 2) return Entry::full;
    angle = next;
    place_ = middle;
    place_[0] += side * rho * std::cos(angle), place_[D - 1] += rho * std::sin(angle);
    touching_ = {{blocking}, {drum()}};
  }
  return Entry::full;
}

/// Height of the drum's wall below the grain, for its centre.
template <int D>
double Placer<D>::drum_below() const {
  const double aside = place_[0] - bounds_.drum->centre[0];
  return bounds_.drum->centre[1] - std::sqrt(std::max(0.0, room() * room() - aside * aside));
}

/// Falls to the first contact below `from`; past those that it touches, whose equators it has reached.
template <int D>
bool Placer<D>::fall(double from) {
  Placed<D> hit;
  if (bounds_.drum) {
    const auto entry = enter_drum(from);
    if (entry != Entry::free) return entry == Entry::wedged;
  }
  const double slack = level * radius_;
  const double height = columns_.highest_contact(
      place_, radius_, from + slack, [this](const Placed<D>& grain) { return !touches(grain); }, hit);
  touching_.clear();
  if (bounds_.drum) {
    place_[D - 1] = std::max(height, drum_below());
    touching_.push_back({height > drum_below() ? hit : drum()});
    return true;
  }
  place_[D - 1] = std::max(height, bounds_.floor + radius_);
  if (height <= bounds_.floor + radius_) return false;
  touching_.push_back({hit});
  return true;
}

/// Does going along v part from all other contacts, or at least not run into them?
template <int D>
bool Placer<D>::allowed(const Vec<D>& v, std::initializer_list<std::size_t> among, const Touching* lost,
                        double slack) const {
  for (std::size_t k = 0; k < touching_.size(); ++k)
    if (&touching_[k] != lost && std::find(among.begin(), among.end(), k) == among.end() &&
        dot(v, touching_[k].normal) < -slack)
      return false;
  return true;
}

/// Exactly on top of one, or in the saddle on two: any way off that the other contacts leave open. False: there is none,
/// and it is stable.
template <int D>
bool Placer<D>::nudge(Random& random) {
  const Vec<D>& n = touching_[on_[0]].normal;
  const auto open = [&](const Vec<D>& v) {
    down_ = unit(v);
    return rolls_on_ == 1 ? allowed(down_, {on_[0]}, nullptr, level)
                          : allowed(down_, {on_[0], on_[1]}, nullptr, level);
  };
  if constexpr (D == 2) {
    const double side = random.uniform() < 0.5 ? 1 : -1;
    return open({{side * n[1], -side * n[0]}}) || open({{-side * n[1], side * n[0]}});
  } else if (rolls_on_ == 2) {
    const Vec<3> along = (random.uniform() < 0.5 ? 1 : -1) * unit(cross(n, touching_[on_[1]].normal));
    return open(along) || open(-1 * along);
  } else {
    const double azimuth = 2 * std::numbers::pi * random.uniform();
    constexpr int ways = 12;
    for (int k = 0; k < ways; ++k) {
      const double a = azimuth + 2 * std::numbers::pi * k / ways;
      Vec<3> v{{std::cos(a), std::sin(a), 0}};
      if (open(v - dot(v, n) * n)) return true;
    }
    return false;
  }
}

/// What the grain does next; `lost` is the contact that just ceased to carry it.
template <int D>
typename Placer<D>::Next Placer<D>::choose(const Touching* lost, Random& random) {
  constexpr int up = D - 1;
  const std::size_t n = touching_.size();
  bool held = false;
  for (auto& t : touching_) {
    t.normal = unit(t.is_drum() ? t.grain.place - place_ : place_ - t.grain.place);
    t.rolling = false;
    // At its equator a grain carries nothing, but along the drum's wall the way leads on.
    held = held || (&t != lost && t.normal[up] > (t.is_drum() ? -level : level));
  }
  if (!held) return Next::fall;
  const auto go = [&](const Vec<D>& v) {
    down_ = v;
    if (norm(v) < level && !nudge(random)) return Next::stable;
    for (int k = 0; k < rolls_on_; ++k) touching_[on_[static_cast<std::size_t>(k)]].rolling = true;
    return Next::roll;
  };
  // Rounding can leave no subset that fits exactly; then a wider one does.
  for (const double slack : {1e-12, 1e-9, 1e-6}) {
    for (std::size_t i = 0; i < n; ++i) {
      const Vec<D>& a = touching_[i].normal;
      if (&touching_[i] == lost || a[up] <= (touching_[i].is_drum() ? -level : 0)) continue;
      const Vec<D> v = downwards<D>() + a[up] * a;
      if (!allowed(v, {i}, lost, slack)) continue;
      on_[0] = i, rolls_on_ = 1;
      if (touching_[i].is_drum() && held_by_drum(a)) {
        touching_[i].rolling = true;
        return Next::stable;
      }
      return go(v);
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) {
        if (&touching_[i] == lost || &touching_[j] == lost) continue;
        const Vec<D>&a = touching_[i].normal, &b = touching_[j].normal;
        const double g = dot(a, b), det = 1 - g * g;
        if (det < level * level) continue;
        const double la = (a[up] - g * b[up]) / det, lb = (b[up] - g * a[up]) / det;
        if (la < -slack || lb < -slack) continue;
        if constexpr (D == 2) {
          // D carry it; in a plane that is two, one on each side.
          touching_[i].rolling = touching_[j].rolling = true;
          return Next::stable;
        } else {
          const Vec<D> v = downwards<D>() + la * a + lb * b;
          if (!allowed(v, {i, j}, lost, slack)) continue;
          on_ = {i, j}, rolls_on_ = 2;
          return go(v);
        }
      }
    if constexpr (D == 3)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j)
          for (std::size_t k = j + 1; k < n; ++k) {
            // z = Σ λ n by Cramer's rule: is "up" between the three?
            const Vec<3>&a = touching_[i].normal, &b = touching_[j].normal, &c = touching_[k].normal;
            const double det = dot(a, cross(b, c));
            if (std::abs(det) < level) continue;
            const double la = cross(b, c)[2] / det, lb = cross(c, a)[2] / det, lc = cross(a, b)[2] / det;
            if (la < -slack || lb < -slack || lc < -slack) continue;
            touching_[i].rolling = touching_[j].rolling = touching_[k].rolling = true;
            return Next::stable;
          }
  }
  return Next::stable;
}

template <int D>
typename Placer<D>::Arc Placer<D>::arc() const {
  Arc arc;
  const Touching& a = touching_[on_[0]];
  if (a.is_drum() && rolls_on_ == 1) {
    arc.centre = a.grain.place;
    arc.radius = room();
    arc.from = -1 * a.normal;
    arc.ahead = unit(down_ - dot(down_, arc.from) * arc.from);
    return arc;
  }
  if (rolls_on_ == 1) {
    arc.centre = a.grain.place;
    arc.radius = reach(a.grain);
    arc.from = a.normal;
    arc.ahead = unit(down_ - dot(down_, arc.from) * arc.from);
    return arc;
  }
  if constexpr (D == 3) {
    const Touching& b = touching_[on_[1]];
    const Vec<3> line = b.grain.place - a.grain.place;
    const double length = norm(line), ra = reach(a.grain), rb = reach(b.grain);
    const Vec<3> axis = (1 / length) * line;
    const double s = (length * length + ra * ra - rb * rb) / (2 * length);
    arc.centre = a.grain.place + s * axis;
    arc.radius = std::sqrt(std::max(0.0, ra * ra - s * s));
    const Vec<3> out = place_ - arc.centre;
    arc.from = unit(out - dot(out, axis) * axis);
    arc.ahead = cross(axis, arc.from);
    if (dot(arc.ahead, down_) < 0) arc.ahead = -1 * arc.ahead;
  }
  return arc;
}

/// The turn in [0, π) at which f = a sin + b cos − c falls through 0; f ≥ 0 before.
template <int D>
std::optional<typename Placer<D>::Turn> Placer<D>::root(double a, double b, double c) const {
  const double square = a * a + b * b, under = square - c * c;
  if (b <= c && a < 0) return Turn{};
  if (under <= 0) return {};
  const double w = std::sqrt(under);
  const Turn turn{(a * c + b * w) / square, (b * c - a * w) / square};
  if (turn.sin < 0) return {};  // beyond half a turn, or over
  return turn;
}

/// The second root of f = a sin + b (cos − 1), f > 0 before it: the first, at 0, is a contact that the grain has now. It lies
/// where tan(turn/2) = a/b.
template <int D>
std::optional<typename Placer<D>::Turn> Placer<D>::meeting_again(double a, double b) {
  if (b <= 0) return {};
  const double tan = std::max(a, 0.0) / b;
  return Turn{2 * tan / (1 + tan * tan), (1 - tan * tan) / (1 + tan * tan)};
}

/// Where on the arc the grain meets the drum: where its centre is as far from the drum's as it may be.
template <int D>
std::optional<typename Placer<D>::Turn> Placer<D>::meeting_drum(const Arc& arc) const {
  if (!bounds_.drum) return {};
  const Vec<D> q = arc.centre - drum().place;
  const double a = -2 * arc.radius * dot(q, arc.ahead), b = -2 * arc.radius * dot(q, arc.from);
  for (const auto& t : touching_)
    if (t.is_drum()) return t.rolling ? std::nullopt : meeting_again(a, b);
  return root(a, b, arc.radius * arc.radius + dot(q, q) - room() * room());
}

/// Where on the arc the grain meets that one.
template <int D>
std::optional<typename Placer<D>::Turn> Placer<D>::meeting(const Arc& arc, const Placed<D>& grain) const {
  const Vec<D> q = arc.centre - grain.place;
  const double a = 2 * arc.radius * dot(q, arc.ahead), b = 2 * arc.radius * dot(q, arc.from);
  for (const auto& t : touching_) {
    if (t.grain.id != grain.id || !(t.grain.place == grain.place)) continue;
    return t.rolling ? std::nullopt : meeting_again(a, b);
  }
  const auto entry = [&](double contact) -> std::optional<Turn> {
    const double c = contact * contact - arc.radius * arc.radius - dot(q, q);
    return c * c > a * a + b * b ? std::nullopt : root(a, b, c);
  };
  const auto inside = entry((1 - yielding) * reach(grain));
  return inside ? entry(reach(grain)) : inside;
}

/// Where the arc ends if nothing is in the way: on one at its equator, on the drum where that holds the grain, on two where
/// one of them carries nothing.
template <int D>
typename Placer<D>::Turn Placer<D>::own_end(const Arc& arc, End& end) const {
  constexpr int up = D - 1;
  Turn last{level, -1};  // just before half a turn; no arc is so long
  end = End::equator;
  const auto earlier = [&](const std::optional<Turn>& turn, End what) {
    if (turn && turn->before(last)) last = *turn, end = what;
  };
  if (rolls_on_ == 1 && touching_[on_[0]].is_drum()) {
    const double steep = bounds_.drum->steepest, part = 1 / std::hypot(1.0, steep);
    Vec<D> held{};
    held[0] = std::copysign(steep * part, arc.from[0]), held[up] = -part;
    end = End::held;
    return {dot(held, arc.ahead), dot(held, arc.from)};
  }
  if (rolls_on_ == 1) {
    last = {arc.from[up], -arc.ahead[up]};
  } else {
    const auto &a = touching_[on_[0]], &b = touching_[on_[1]];
    const double ra = reach(a.grain), rb = reach(b.grain), g = dot(a.normal, b.normal);
    const double ha = (arc.centre - a.grain.place)[up] / ra, hb = (arc.centre - b.grain.place)[up] / rb;
    const double pa = arc.radius * (1 / ra - g / rb), pb = arc.radius * (1 / rb - g / ra);
    earlier(root(pa * arc.ahead[up], pa * arc.from[up], g * hb - ha), End::loses_first);
    earlier(root(pb * arc.ahead[up], pb * arc.from[up], g * ha - hb), End::loses_second);
  }
  earlier(
      root(arc.radius * arc.ahead[up], arc.radius * arc.from[up], bounds_.floor + radius_ - arc.centre[up]),
      End::floor);
  return last;
}

template <int D>
Rest<D> Placer<D>::rest(bool on_floor, int events) const {
  Rest<D> rest{place_, {}, 0, on_floor, events};
  for (const auto& t : touching_)
    if (t.rolling && rest.count < D) rest.supports[static_cast<std::size_t>(rest.count++)] = t.grain.id;
  return rest;
}

template <int D>
std::optional<Rest<D>> Placer<D>::place(const Vec<D>& lateral, double radius, Random& random, double from) {
  constexpr int up = D - 1;
  place_ = lateral, radius_ = radius;
  touching_.clear();
  bool falls = true;
  const Touching* lost = nullptr;
  for (int event = 1; event <= most_events; ++event) {
    if (falls) {
      if (!fall(from)) {
        if (bounds_.drum || bounds_.floor == -std::numeric_limits<double>::infinity()) return {};
        return rest(true, event);
      }
      falls = false;
    }
    const Next next = choose(lost, random);
    lost = nullptr;
    if (next == Next::stable) {
      if (bounds_.drum && norm(place_ - drum().place) > room() * (1 + level)) return {};  // the drum is full
      return rest(false, event);
    }
    if (next == Next::fall) {
      falls = true, from = place_[up];
      continue;
    }
    const Arc way = arc();
    End end{};
    Turn last = own_end(way, end);
    // All of the arc lies in a ball about its middle.
    const Turn half{std::sqrt(std::max(0.0, (1 - last.cos) / 2)),
                    std::sqrt(std::max(0.0, (1 + last.cos) / 2))};
    const Vec<D> middle = way.centre + way.radius * way.direction(half);
    Placed<D> met;
    columns_.near({middle, norm(place_ - middle)}, radius_, [&](const Placed<D>& grain) {
      const auto turn = meeting(way, grain);
      if (turn && turn->before(last)) last = *turn, end = End::contact, met = grain;
    });
    if (const auto turn = meeting_drum(way); turn && turn->before(last))
      last = *turn, end = End::contact, met = drum();
    const bool moved = last.sin != 0 || last.cos < 0;
    if (moved) place_ = way.at(last);
    if (moved || end != End::contact)
      if (end != End::loses_first && end != End::loses_second)
        std::erase_if(touching_, [](const Touching& t) { return !t.rolling; });
    switch (end) {
      case End::equator:
        falls = true, from = place_[up];
        break;
      case End::held:
        return rest(false, event);
      case End::floor:
        place_[up] = bounds_.floor + radius_;
        return rest(true, event);
      case End::contact:
        touching_.push_back({met});
        break;
      case End::loses_first:
      case End::loses_second: {
        const Touching a = touching_[on_[0]], b = touching_[on_[1]];
        touching_ = {a, b};
        lost = &touching_[end == End::loses_first ? 0 : 1];
        break;
      }
    }
  }
  return {};
}

template class Placer<2>;
template class Placer<3>;

}  // namespace chute::restructuring
