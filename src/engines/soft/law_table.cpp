#include "engines/soft/law_table.hpp"

#include <algorithm>
#include <cassert>

namespace chute::soft {

LawTable::LawTable(const std::vector<laws::ContactLaws>& laws, std::size_t materials)
    : laws_(laws), materials_(materials) {
  sort_by_type();
}

void LawTable::sort_by_type() {
  const auto collect = [&](const auto& of, auto& lists) {
    std::visit(
        [&]<class Law>(const Law&) {
          std::vector<Law> all;
          for (const auto& laws : laws_) all.push_back(std::get<Law>(of(laws)));
          lists = std::move(all);
        },
        of(laws_.front()));
  };
  collect([](const laws::ContactLaws& laws) -> const laws::Normal& { return laws.normal; }, normal_);
  collect([](const laws::ContactLaws& laws) -> const laws::Shear& { return laws.shear; }, shear_);
}

bool LawTable::needs_radius() const {
  return std::ranges::any_of(laws_, [](const auto& laws) { return laws::needs_radius(laws); });
}

/// Can a pair that does not touch yet, or no more, be given to these laws? What remembers begins with the contact, and Hertz's
/// damping is no number there.
static bool acts_before_contact(const laws::ContactLaws& laws) {
  const bool at_once = std::visit(
      []<class Law>(const Law&) {
        return requires { Law::acts_at_once; };
      },
      laws.normal);
  const bool remembers =
      std::visit([]<class Law>(const Law&) { return laws::ShearWithMemory<Law>; }, laws.shear);
  return at_once && !remembers;
}

void LawTable::know_time_step(double time_step, const EndWeights& ends) {
  ends_ = ends.apart() > 0 && !acts_before_contact(laws_.front()) ? ends.inside_only() : ends;
  for (auto& laws : laws_) laws::know_time_step(laws, time_step);
  sort_by_type();
}

}  // namespace chute::soft
