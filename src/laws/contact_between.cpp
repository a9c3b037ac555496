#include "laws/contact_between.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "laws/contact_spec.hpp"

namespace chute::laws {
namespace {

/// The keys of all laws of a table that are numbers.
std::set<std::string> numbers_of(const std::string& table) {
  std::set<std::string> names;
  for (const auto& law : all_law_keys())
    if (law.table == table)
      for (const auto& key : law.keys)
        if (key.type == "number") names.insert(key.key);
  return names;
}

/// Keys that say the same thing in different ways: whoever gives one of them gives none of the others.
struct Rivals {
  std::string_view table;
  std::vector<std::string_view> keys;
};
const std::array<Rivals, 4> rivals{
    {{"contact.normal", {"stiffness", "contact_time", "young"}},
     {"contact.normal", {"stiffness", "contact_time", "poisson"}},
     {"contact.normal", {"restitution", "damping", "relaxation", "unloading_stiffness", "hardening"}},
     {"contact.tangential", {"stiffness", "stiffness_ratio"}}}};

/// Goes over a law's description, as TomlReader does, and puts own numbers in.
class Overlay {
 public:
  static constexpr bool reading = false;
  explicit Overlay(const OwnNumbers& own) : own_(own) {}

  void value(std::string_view key, double& target, Range range = any_number, Text = {}) {
    if (const auto* own = find(key)) {
      if (!range.contains(*own))
        tell(key, fmt::format("{} is not allowed, must be {}", *own, range.describe()));
      target = *own;
    }
  }
  void value(std::string_view key, std::optional<double>& target, Range range = any_number, Text = {}) {
    if (find(key))
      value(key, target.emplace(), range);
    else if (has_rival(key))
      target.reset();
  }
  void value(std::string_view key, double& target, const char*) { value(key, target); }
  void value(std::string_view key, std::optional<double>& target, const char*) { value(key, target); }
  void value(std::string_view, bool&, const char* = "") {}
  template <class T, class... Rule>
  void required(std::string_view key, T& target, Rule... rule) {
    value(key, target, rule...);
  }
  template <class Enum>
  void choice(std::string_view, Enum&, std::span<const std::string_view>, Text = {}) {}
  void check(bool holds, std::string_view key, const std::string& message) {
    if (!holds) tell(key, message);
  }

  /// After the description: what is wrong. `law` names it.
  std::optional<Refusal> wrong(std::string_view law) {
    const auto told = std::exchange(wrong_, {});  // may only follow from a number that the law has not
    for (const auto& [key, number] : own_.values)
      if (!known_.contains(key))
        tell(key, fmt::format("the law {} of [{}] has no such number; it has: {}", law, own_.table,
                              seen_.empty() ? "none" : fmt::format("{}", fmt::join(seen_, ", "))));
    return wrong_ ? wrong_ : told;
  }

 private:
  const OwnNumbers& own_;
  std::set<std::string> known_;
  std::vector<std::string> seen_;
  std::optional<Refusal> wrong_;

  const double* find(std::string_view key) {
    seen_.emplace_back(key);
    const auto found = own_.values.find(std::string(key));
    if (found == own_.values.end()) return nullptr;
    known_.insert(found->first);
    return &found->second;
  }
  bool has_rival(std::string_view key) const {
    return std::ranges::any_of(rivals, [&](const Rivals& r) {
      return r.table == own_.table && std::ranges::find(r.keys, key) != r.keys.end() &&
             std::ranges::any_of(r.keys,
                                 [&](auto other) { return own_.values.contains(std::string(other)); });
    });
  }
  void tell(std::string_view key, const std::string& message) {
    const auto table = own_.table.substr(own_.table.find('.') + 1);
    if (!wrong_) wrong_ = Refusal{fmt::format("{}.{}", table, key), message};
  }
};

/// Puts the numbers of one table in, and the short form where the law has that key.
template <class Laws, class Keys>
std::optional<Refusal> put_in_table(Keys& keys, const char* table, const std::optional<OwnNumbers>& given,
                                    const char* short_key, const std::optional<double>& short_form) {
  OwnNumbers own = given.value_or(OwnNumbers{});
  own.table = table;
  const auto law = ListOf<Laws>::names[keys.index()];
  if (short_form) {
    const auto all = all_law_keys();
    const auto of_law =
        std::ranges::find_if(all, [&](const LawKeys& one) { return one.table == table && one.name == law; });
    if (std::ranges::any_of(of_law->keys, [&](const KeyText& key) { return key.key == short_key; }))
      own.values[short_key] = *short_form;
  }
  if (own.values.empty()) return {};
  Overlay overlay(own);
  std::visit([&](auto& k) { k.describe(overlay); }, keys);
  auto wrong = overlay.wrong(law);
  if (wrong && short_form && wrong->key.ends_with(std::string(".") + short_key)) wrong->key = short_key;
  return wrong;
}

}  // namespace

// Outside the unnamed namespace: the archives find these by the type that they describe.

static void describe(TomlReader& a, OwnNumbers& own) {
  for (const auto& key : numbers_of(own.table)) {
    std::optional<double> number;
    a.value(key, number);
    if (number) own.values[key] = *number;
  }
}
static void describe(TomlWriter& a, OwnNumbers& own) {
  for (const auto& [key, number] : own.values) a.value(key, number);
}

template <class Archive>
static void describe_between(Archive& a, ContactBetween& between) {
  a.required("materials", between.materials,
             "[\"a\", \"b\"]: the two that meet; the same twice for one with itself");
  a.value("restitution", between.restitution, unit_interval, "e_n");
  a.value("friction", between.friction, non_negative, "μ");
  a.value("static_friction", between.static_friction, non_negative, "μ_s of contacts at rest");
  a.value("tangential_restitution", between.tangential_restitution, ::chute::between(-1, 1), "β");
}

static void describe_numbers(TomlReader& a, const char* key, const char* table,
                             std::optional<OwnNumbers>& own) {
  OwnNumbers read{table, {}};
  a.section(key, read);
  if (a.has(key)) own = std::move(read);
}

void describe(TomlReader& a, ContactBetween& between) {
  describe_between(a, between);
  describe_numbers(a, "normal", "contact.normal", between.normal);
  describe_numbers(a, "tangential", "contact.tangential", between.tangential);
  a.check(between.materials.size() == 2, "materials", "names two: those that meet, or one twice");
  const auto twice = [&](const std::optional<double>& short_form, const std::optional<OwnNumbers>& numbers,
                         const char* key) {
    a.check(!(short_form && numbers && numbers->values.contains(key)), key,
            "is given twice, here and among the law's numbers");
  };
  twice(between.restitution, between.normal, "restitution");
  twice(between.friction, between.tangential, "friction");
}
void describe(TomlWriter& a, ContactBetween& between) {
  describe_between(a, between);
  a.section("normal", between.normal);
  a.section("tangential", between.tangential);
}
void describe(KeyLister& a, ContactBetween& between) {
  describe_between(a, between);
  std::optional<double> any;
  a.value("normal.…", any, "any number of the law of [contact.normal], in the place of that");
  a.value("tangential.…", any, "and of the law of [contact.tangential]");
}

std::optional<Refusal> put_in(ContactSpec& contact, const ContactBetween& own) {
  if (auto wrong =
          put_in_table<Normal>(contact.normal, "contact.normal", own.normal, "restitution", own.restitution))
    return wrong;
  return put_in_table<Shear>(contact.tangential, "contact.tangential", own.tangential, "friction",
                             own.friction);
}

}  // namespace chute::laws
