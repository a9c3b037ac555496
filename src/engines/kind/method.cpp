#include "engines/kind/method.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace chute::engines {
namespace {

/// One of a pair, as its laws see it.
struct Partner {
  double radius, mass;  // 0 of what does not move, or is flat
};
laws::Pair pair_of(Partner a, Partner b) {
  const double m_eff = a.mass == 0 ? b.mass : b.mass == 0 ? a.mass : a.mass * b.mass / (a.mass + b.mass);
  const double r_eff = a.radius == 0   ? b.radius
                       : b.radius == 0 ? a.radius
                                       : a.radius * b.radius / (a.radius + b.radius);
  return {m_eff, r_eff};
}

}  // namespace

std::vector<MeetingMaterials> Setting::meetings() const {
  std::vector<MeetingMaterials> all;
  laws::ContactSpec same = contact;
  same.between.clear();
  for (int a = 0; a < static_cast<int>(materials.size()); ++a)
    for (int b = a; b < static_cast<int>(materials.size()); ++b) {
      const auto &first = materials[static_cast<std::size_t>(a)],
                 &second = materials[static_cast<std::size_t>(b)];
      if (!first.grains && !second.grains) continue;
      const std::array names{first.name, second.name};
      const auto own = std::ranges::find_if(contact.between, [&](const laws::ContactBetween& between) {
        return std::is_permutation(between.materials.begin(), between.materials.end(), names.begin(),
                                   names.end());
      });
      const bool named = own != contact.between.end();
      auto with = same;
      if (named) laws::put_in(with, *own);
      const auto mean = pair_of({first.radius, first.mass}, {second.radius, second.mass});
      const auto stiffest = pair_of({first.smallest_radius, first.smallest_mass},
                                    {second.smallest_radius, second.smallest_mass});
      // What has no numbers of its own is as [contact] has it, for that reference.
      all.push_back({a, b, first.name + "-" + second.name, with, named ? mean : reference(), mean, stiffest,
                     named ? &*own : nullptr, static_cast<std::size_t>(own - contact.between.begin())});
    }
  return all;
}

double step_dividing(double between_outputs, double longest) {
  return between_outputs / std::ceil(between_outputs / longest);
}

}  // namespace chute::engines
