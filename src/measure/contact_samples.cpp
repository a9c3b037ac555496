#include "measure/contact_samples.hpp"

#include <algorithm>
#include <cmath>

namespace chute::measure {

std::optional<std::vector<Contact>> ContactSamples::take(const Look& look) {
  if (!hard_) return look.engine.contacts();
  const double now = look.engine.time(), interval = now - begun_;
  const bool first = begun_ < 0;
  begun_ = now;
  if (first || !(interval > 0)) return {};
  std::vector<Contact> contacts;
  std::swap(contacts, gathered_);
  for (auto& c : contacts) {
    for (double& f : c.force) f /= interval;
    c.normal_force /= interval;
    c.shear_force /= interval;
  }
  return contacts;
}

std::vector<Contact> joined_by_pair(const std::vector<Contact>& contacts) {
  std::vector<Contact> sorted = contacts, joined;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Contact& a, const Contact& b) {
    return std::pair(a.a, a.b) < std::pair(b.a, b.b);
  });
  for (const auto& c : sorted) {
    if (joined.empty() || joined.back().a != c.a || joined.back().b != c.b) {
      joined.push_back(c);
      continue;
    }
    Contact& all = joined.back();
    const double before = all.normal_force, sum = before + c.normal_force;
    for (std::size_t k = 0; k < 3; ++k) {  // places of several collisions: weighted by what passed there
      const double part = sum > 0 ? c.normal_force / sum : 0.5;
      all.point[k] += part * (c.point[k] - all.point[k]);
      all.normal[k] += part * (c.normal[k] - all.normal[k]);
      all.branch[k] += part * (c.branch[k] - all.branch[k]);
      all.force[k] += c.force[k];
    }
    all.normal_force = sum;
    all.shear_force += c.shear_force;
  }
  return joined;
}

}  // namespace chute::measure
