#include "laws/list.hpp"

namespace chute::laws {

ContactLaws make_contact(const NormalKeys& normal, const ShearKeys& shear, const Reference& reference,
                         KeepLaw keep) {
  ContactLaws contact;
  contact.attraction = reference.attraction;
  contact.normal = std::visit(
      [&](const auto& keys) -> Normal {
        if constexpr (requires { keys.make(reference); })
          return keys.make(reference);
        else
          return keys;
      },
      normal);
  contact.shear = std::visit(
      [&]<class Keys>(const Keys& keys) -> Shear {
        if constexpr (requires(PairCoefficient k) { keys.make(k); })
          return keys.make(
              std::visit([](const auto& law) { return law.stiffness_coefficient(); }, contact.normal));
        else
          return keys;
      },
      shear);
  if (const double* mu = friction(contact.shear); mu && *mu == 0 && keep == KeepLaw::no)
    contact.shear = Frictionless{};
  return contact;
}

}  // namespace chute::laws
