#include "replay/touching.hpp"

#include <limits>

#include "core/pair_contact.hpp"
#include "search/pairs.hpp"

namespace chute::replay {

template <int D>
std::vector<Contact> touching(const Grains<D>& grains, const Domain<D>& domain, double gap) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<Contact> contacts;
  if (grains.size() == 0) return contacts;
  search::PairNames pairs;
  search::CellGrid<D>().find(grains, domain, gap, pairs);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    Contact contact = pair_contact(grains, domain, static_cast<std::size_t>(pairs.i[p]),
                                   static_cast<std::size_t>(pairs.j[p]));
    contact.force = {unknown, unknown, D == 3 ? unknown : 0};
    contact.normal_force = contact.shear_force = unknown;
    contacts.push_back(contact);
  }
  return contacts;
}

template std::vector<Contact> touching(const Grains<2>&, const Domain<2>&, double);
template std::vector<Contact> touching(const Grains<3>&, const Domain<3>&, double);

}  // namespace chute::replay
