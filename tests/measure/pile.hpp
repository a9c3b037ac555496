#pragma once
#include <cmath>
#include <vector>

#include "core/engine.hpp"
#include "core/frame.hpp"

namespace chute::test {

/// Discs and contacts given one by one, on a line of length 10 without gravity of its own.
struct Pile {
  std::vector<double> x, y, v_x, v_y, spin, radius, mass;
  std::vector<Contact> contacts;
  std::size_t moving = 0;

  std::size_t add(double place, double height, double m, double vx = 0, double vy = 0, double R = 0.5) {
    x.push_back(place), y.push_back(height), v_x.push_back(vx), v_y.push_back(vy), spin.push_back(0);
    radius.push_back(R), mass.push_back(m);
    return moving++;
  }
  /// The bed comes after all that moves.
  std::size_t add_fixed(double place, double height) {
    const auto id = add(place, height, 1);
    --moving;
    return id;
  }
  void touch(std::size_t i, std::size_t j, double normal, double shear = 0) {
    Contact contact;
    contact.a = static_cast<std::int64_t>(i), contact.b = static_cast<std::int64_t>(j);
    const auto way = at(0).way(i, j);
    const Vec<2> branch{{way[0], way[1]}}, n = (1 / norm(branch)) * branch;
    contact.branch = way;
    set_force<2>(contact, n, normal * n + shear * Vec<2>{{n[1], -n[0]}});
    contacts.push_back(contact);
  }
  static Frame frame() { return {.dimensions = 2, .footprint = 10, .bead_spacing = 1}; }
  GrainsView at(double time) const {
    GrainsView view;
    view.time = time;
    view.moving = moving;
    view.position = {x, y, std::span<const double>{}};
    view.velocity = {v_x, v_y, std::span<const double>{}};
    view.spin[0] = spin;
    view.radius = radius;
    view.mass = mass;
    view.period = {10, 0, 0};
    return view;
  }
};

/// Four discs of different mass, one on the other on a bed disc: under gravity 1 each contact carries what
/// lies above.
inline Pile column() {
  Pile pile;
  const double masses[] = {1, 2, 0.5, 1.5};
  double above = 0;
  for (const double m : masses) above += m;
  for (int k = 0; k < 4; ++k) pile.add(9.9, 0.95 * (k + 1), masses[k]);
  const auto bed = pile.add_fixed(9.9, 0);
  pile.touch(0, bed, above);
  for (std::size_t k = 0; k < 3; ++k) pile.touch(k, k + 1, above -= masses[k]);
  return pile;
}
inline double weight_above(const Pile& pile, double h) {
  double weight = 0;
  for (std::size_t i = 0; i < pile.moving; ++i) weight += pile.y[i] > h ? pile.mass[i] : 0;
  return weight;
}

}  // namespace chute::test
