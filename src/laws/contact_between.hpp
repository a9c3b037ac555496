#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/keys.hpp"

namespace chute::laws {

/// Numbers of a law, by their keys.
struct OwnNumbers {
  std::string table;  ///< contact.normal or contact.tangential, whose law they belong to
  std::map<std::string, double> values;
};

/// [[contact.between]]: what is two materials' own where they meet; all else is as [contact] has it. The short forms are those
/// that [[wall]] has, and all methods know them; the numbers in `normal` and `tangential` take the place of those of the laws.
struct ContactBetween {
  std::vector<std::string> materials;  ///< their names: two, or one twice
  std::optional<double> restitution, friction, static_friction, tangential_restitution;
  std::optional<OwnNumbers> normal, tangential;
};

void describe(TomlReader& a, ContactBetween& between);
void describe(TomlWriter& a, ContactBetween& between);
void describe(KeyLister& a, ContactBetween& between);

struct ContactSpec;

/// Puts what is the pair's own in the place of what `contact` says. A short form that the law has no key for is left to methods of
/// hard grains. What is wrong, with a key inside of [[contact.between]], if anything is.
std::optional<Refusal> put_in(ContactSpec& contact, const ContactBetween& own);

}  // namespace chute::laws
