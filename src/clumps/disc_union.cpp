#include "clumps/disc_union.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace chute::clumps {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// Angles from `begin` to `end` on a circle, begin ≤ end.
struct Arc {
  double begin, end;
};

/// The arcs of a circle that no other disc covers.
class OpenArcs {
 public:
  /// Takes away what `other` covers of the circle around `own`. Of discs that are the same only the first stays:
  /// `other_goes_first` says whether that is the other one. False: nothing is left.
  bool cover(const Disc& own, const Disc& other, bool other_goes_first) {
    const Vec<2> way = other.centre - own.centre;
    const double d = norm(way), a = own.radius, b = other.radius;
    if (d >= a + b) return true;
    if (d <= b - a) return d == 0 && a == b && !other_goes_first;
    if (d <= a - b) return true;
    // The circles cross at x along the way and h beside it; both discs compute the same h, so that their arcs meet.
    const double x = (d * d + (a - b) * (a + b)) / (2 * d);
    const double h =
        std::sqrt(std::max(0.0, (d + a + b) * (b + (a - d)) * (b - (a - d)) * (d + (a - b)))) / (2 * d);
    const double middle = std::atan2(way[1], way[0]), half = std::atan2(h, x);
    hide({middle - half, middle + half});
    return true;
  }

  /// visit(arc) for what is left.
  template <class Visit>
  void for_each(const Visit& visit) {
    std::sort(hidden_.begin(), hidden_.end(), [](const Arc& a, const Arc& b) { return a.begin < b.begin; });
    double at = 0;
    for (const auto& arc : hidden_) {
      if (arc.begin > at) visit(Arc{at, arc.begin});
      at = std::max(at, arc.end);
    }
    if (at < full_turn) visit(Arc{at, full_turn});
  }

 private:
  std::vector<Arc> hidden_;  // within [0, 2π]

  void hide(Arc arc) {
    const double shift = std::floor(arc.begin / full_turn) * full_turn;
    arc.begin -= shift, arc.end -= shift;
    if (arc.end <= full_turn) return hidden_.push_back(arc);
    hidden_.push_back({arc.begin, full_turn});
    hidden_.push_back({0, arc.end - full_turn});
  }
};

/// ∫ cos^p θ sin^q θ dθ over an arc, by their antiderivatives.
struct TrigonometricIntegrals {
  double c1, s1, c2, s2, cs, c3, s3, ccs, c4, s4, cccs;

  explicit TrigonometricIntegrals(const Arc& arc) : TrigonometricIntegrals() {
    add(arc.end, 1);
    add(arc.begin, -1);
  }

 private:
  TrigonometricIntegrals() : c1(0), s1(0), c2(0), s2(0), cs(0), c3(0), s3(0), ccs(0), c4(0), s4(0), cccs(0) {}
  void add(double t, double sign) {
    const double c = std::cos(t), s = std::sin(t), twice = 2 * s * c, four = 2 * twice * (c * c - s * s);
    c1 += sign * s;
    s1 -= sign * c;
    c2 += sign * (t / 2 + twice / 4);
    s2 += sign * (t / 2 - twice / 4);
    cs += sign * s * s / 2;
    c3 += sign * (s - s * s * s / 3);
    s3 += sign * (c * c * c / 3 - c);
    ccs -= sign * c * c * c / 3;
    c4 += sign * (3 * t / 8 + twice / 4 + four / 32);
    s4 += sign * (3 * t / 8 - twice / 4 + four / 32);
    cccs -= sign * c * c * c * c / 4;
  }
};

/// The part of an arc with (x, y) = (a + R cos θ, b + R sin θ) in ½∮(x dy − y dx), ½∮x² dy, −½∮y² dx, ⅓∮x³ dy,
/// −⅓∮y³ dx and ½∮x² y dy.
void add_arc(const Disc& disc, const Arc& arc, FlatMoments& m) {
  const TrigonometricIntegrals t(arc);
  const double a = disc.centre[0], b = disc.centre[1], R = disc.radius;
  const double x2 = a * a * t.c1 + 2 * a * R * t.c2 + R * R * t.c3;  // ∫ x² cos θ dθ
  m.area += R / 2 * (a * t.c1 + b * t.s1 + R * (arc.end - arc.begin));
  m.first[0] += R / 2 * x2;
  m.first[1] += R / 2 * (b * b * t.s1 + 2 * b * R * t.s2 + R * R * t.s3);
  m.xx += R / 3 * (a * a * a * t.c1 + 3 * a * a * R * t.c2 + 3 * a * R * R * t.c3 + R * R * R * t.c4);
  m.yy += R / 3 * (b * b * b * t.s1 + 3 * b * b * R * t.s2 + 3 * b * R * R * t.s3 + R * R * R * t.s4);
  m.xy += R / 2 * (b * x2 + R * (a * a * t.cs + 2 * a * R * t.ccs + R * R * t.cccs));
}

}  // namespace

FlatMoments union_of(std::span<const Disc> discs) {
  FlatMoments moments;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    OpenArcs open;
    bool any = discs[i].radius > 0;
    for (std::size_t j = 0; j < discs.size() && any; ++j)
      if (j != i) any = open.cover(discs[i], discs[j], j < i);
    if (any) open.for_each([&](const Arc& arc) { add_arc(discs[i], arc, moments); });
  }
  return moments;
}

}  // namespace chute::clumps
