#include "replay/touching.hpp"

#include <limits>

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
    const auto i = static_cast<std::size_t>(pairs.i[p]), j = static_cast<std::size_t>(pairs.j[p]);
    const Vec<D> way = domain.way(grains.place(i), grains.place(j));
    const double far = norm(way);
    Contact contact;
    contact.a = pairs.i[p], contact.b = pairs.j[p];
    contact.overlap = grains.radius[i] + grains.radius[j] - far;
    const Vec<D> n = far > 0 ? (1 / far) * way : Vec<D>{};
    contact.normal = as_file_vector(n);
    contact.branch = as_file_vector(way);
    contact.point = as_file_vector(grains.place(i) + (grains.radius[i] - 0.5 * contact.overlap) * n);
    contact.force = {unknown, unknown, D == 3 ? unknown : 0};
    contact.normal_force = contact.shear_force = unknown;
    contacts.push_back(contact);
  }
  return contacts;
}

template std::vector<Contact> touching(const Grains<2>&, const Domain<2>&, double);
template std::vector<Contact> touching(const Grains<3>&, const Domain<3>&, double);

}  // namespace chute::replay
