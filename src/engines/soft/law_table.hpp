#pragma once
#include <cstdint>
#include <variant>
#include <vector>

#include "core/by_pair.hpp"
#include "engines/soft/contact_ends.hpp"
#include "laws/list.hpp"

namespace chute::soft {

/// One law, whatever the contact.
template <class OneOf>
struct SameLaw {
  using Law = OneOf;
  Law law;
  const Law& operator()(std::size_t) const { return law; }
};
/// A law with parameters by contact.
template <class OneOf>
struct LawByContact {
  using Law = OneOf;
  const Law* laws;
  const std::int32_t* which;
  const Law& operator()(std::size_t c) const { return laws[which[c]]; }
};

/// What contacts act by: the same laws for all, or one of several with other parameters for each, as Contacts::law says. The loops
/// over contacts are compiled for both, so that those who have one material pay nothing for those who have several.
class LawTable {
 public:
  LawTable(const laws::ContactLaws& all) : LawTable(std::vector{all}, 0) {}
  /// Of grains with each other: by the materials of both.
  LawTable(const ByPair<laws::ContactLaws>& pairs) : LawTable(pairs.values(), pairs.materials()) {}
  /// Of grains with a wall: by the material of the grain.
  explicit LawTable(const std::vector<laws::ContactLaws>& by_grain) : LawTable(by_grain, 0) {}

  /// Types, and what all have in common.
  const laws::ContactLaws& first() const { return laws_.front(); }
  bool several() const { return laws_.size() > 1; }
  bool needs_radius() const;
  /// The law of two materials.
  std::int32_t of(int a, int b) const {
    return static_cast<std::int32_t>(static_cast<std::size_t>(a) * materials_ + static_cast<std::size_t>(b));
  }
  void know_time_step(double time_step, const EndWeights& ends);
  const EndWeights& ends() const { return ends_; }

  /// visit(choice): SameLaw or LawByContact of the type that the laws are of.
  template <class Visit>
  void normal(const std::int32_t* which, const Visit& visit) const {
    visit_one_of(normal_, which, visit);
  }
  template <class Visit>
  void shear(const std::int32_t* which, const Visit& visit) const {
    visit_one_of(shear_, which, visit);
  }

 private:
  template <class Laws>
  struct Lists;
  template <class... Law>
  struct Lists<std::variant<Law...>> {
    using Type = std::variant<std::vector<Law>...>;
  };
  std::vector<laws::ContactLaws> laws_;
  std::size_t materials_;
  EndWeights ends_;
  Lists<laws::Normal>::Type normal_;  // the same once more, by their type
  Lists<laws::Shear>::Type shear_;

  LawTable(const std::vector<laws::ContactLaws>& laws, std::size_t materials);
  void sort_by_type();
  template <class List, class Visit>
  static void visit_one_of(const List& lists, const std::int32_t* which, const Visit& visit) {
    std::visit(
        [&]<class Law>(const std::vector<Law>& laws) {
          if (laws.size() == 1)
            visit(SameLaw<Law>{laws.front()});
          else
            visit(LawByContact<Law>{laws.data(), which});
        },
        lists);
  }
};

}  // namespace chute::soft
