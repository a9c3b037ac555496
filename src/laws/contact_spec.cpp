#include "laws/contact_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace chute::laws {
namespace {

enum class Which : int {};

/// The alternative of that index, with its defaults, unless it is the present one.
template <class Keys, std::size_t... Index>
void change_to(Keys& keys, std::size_t which, std::index_sequence<Index...>) {
  if (keys.index() != which) ((which == Index ? void(keys.template emplace<Index>()) : void()), ...);
}

}  // namespace

// Outside the unnamed namespace: the archives find these by the type that they describe.

/// A law's table: its word, then its own keys.
template <class Laws>
struct Table {
  typename ListOf<Laws>::Keys& keys;
};

template <class Archive, class Laws>
static void describe(Archive& a, Table<Laws>& table) {
  using Keys = typename ListOf<Laws>::Keys;
  auto which = static_cast<Which>(table.keys.index());
  a.choice("law", which, ListOf<Laws>::names);
  change_to(table.keys, static_cast<std::size_t>(which),
            std::make_index_sequence<std::variant_size_v<Keys>>{});
  std::visit([&](auto& keys) { keys.describe(a); }, table.keys);
}

template <class Archive>
static void describe_contact(Archive& a, ContactSpec& contact) {
  a.value("attraction", contact.attraction);
  Table<Normal> normal{contact.normal};
  Table<Shear> tangential{contact.tangential};
  a.required_section("normal", normal);
  a.required_section("tangential", tangential);
  const bool wants_hertz = ListOf<Shear>::hertz_springs[contact.tangential.index()],
             has_hertz = ListOf<Normal>::hertz_springs[contact.normal.index()];
  const bool relative = std::visit(
      [](const auto& keys) {
        if constexpr (requires { keys.stiffness_ratio; })
          return keys.stiffness_ratio.has_value();
        else
          return false;
      },
      contact.tangential);
  a.check(!relative || wants_hertz == has_hertz, "tangential",
          wants_hertz
              ? "k_s/k_n of this law is a number with Hertz's spring only; give its stiffness (N m^-3/2)"
              : "k_s/k_n is a number with a linear normal spring only; give the stiffness (N/m)");
}

/// What of [[contact.between]] does not go with the laws, or with itself.
static void check_between(TomlReader& a, const ContactSpec& contact) {
  for (std::size_t k = 0; k < contact.between.size(); ++k) {
    const auto& own = contact.between[k];
    const auto key = [&](const std::string& inside) { return fmt::format("between[{}].{}", k, inside); };
    const auto same = [&](const ContactBetween& other) {
      return std::is_permutation(other.materials.begin(), other.materials.end(), own.materials.begin(),
                                 own.materials.end());
    };
    const auto end = contact.between.begin() + static_cast<std::ptrdiff_t>(k);
    a.check(std::find_if(contact.between.begin(), end, same) == end, key("materials"),
            "a pair that was named before: what is its own stands in one table");
    ContactSpec with = contact;
    auto numbers = own;  // what the short forms mean depends on the method
    numbers.restitution.reset(), numbers.friction.reset();
    const auto wrong = put_in(with, numbers);
    a.check(!wrong, wrong ? key(wrong->key) : "", wrong ? wrong->message : "");
  }
}

void describe(TomlReader& a, ContactSpec& contact) {
  describe_contact(a, contact);
  a.sections("between", contact.between);
  check_between(a, contact);
}
void describe(TomlWriter& a, ContactSpec& contact) {
  describe_contact(a, contact);
  a.sections("between", contact.between);
}
void describe(KeyLister& a, ContactSpec& contact) {
  describe_contact(a, contact);
  a.sections("between", contact.between);
}

namespace {

template <class Laws, std::size_t... Index>
void add_law_keys(const char* table, std::vector<LawKeys>& all, std::index_sequence<Index...>) {
  const auto add = [&]<std::size_t I>(std::integral_constant<std::size_t, I>) {
    KeyLister lister;
    std::variant_alternative_t<I, typename ListOf<Laws>::Keys> keys{};
    keys.describe(lister);
    all.push_back({table, std::string(ListOf<Laws>::names[I]), lister.keys()});
  };
  (add(std::integral_constant<std::size_t, Index>{}), ...);
}

}  // namespace

std::vector<LawKeys> all_law_keys() {
  std::vector<LawKeys> all;
  add_law_keys<Normal>("contact.normal", all, std::make_index_sequence<std::variant_size_v<Normal>>{});
  add_law_keys<Shear>("contact.tangential", all, std::make_index_sequence<std::variant_size_v<Shear>>{});
  return all;
}

std::optional<double> ContactSpec::at_velocity() const {
  return std::visit(
      [](const auto& keys) -> std::optional<double> {
        if constexpr (requires { keys.at_velocity; })
          return keys.at_velocity;
        else
          return {};
      },
      normal);
}

NormalImpact ContactSpec::impact(Pair reference, Pair pair) const {
  return normal_impact(laws(reference), at_velocity().value_or(1), pair);
}

void check_contact_time(const ContactSpec& contact, Pair pair, const TomlReader& reader) {
  const auto impact = contact.impact(pair);
  if (impact.restitution > 0 && std::isfinite(impact.contact_time)) return;
  reader.fail("contact", contact.at_velocity()
                             ? "the damping is too strong: grains that meet at_velocity would never part"
                             : "the damping is over-critical: grains would stick together and never part");
}

}  // namespace chute::laws
