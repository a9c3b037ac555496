#pragma once
#include <vector>

#include "measure/observer.hpp"

namespace chute::measure {

/// The contacts that go with a sample, whatever the method. Of soft grains and of contact dynamics: what touches at that
/// instant. Hard grains collide between the samples: every collision since the sample before, its impulse over the time
/// between the two; so the first sample is only where that time begins.
class ContactSamples {
 public:
  ContactSamples() = default;
  /// `from`: the first step at which somebody looks.
  ContactSamples(const RunContext& run, std::int64_t from) : hard_(run.offers.collisions), from_(from) {}

  bool wants_collisions(std::int64_t step) const { return hard_ && step >= from_; }
  /// To be called at every look.
  void gather(const Look& look) {
    if (hard_ && begun_ >= 0)
      gathered_.insert(gathered_.end(), look.collisions.begin(), look.collisions.end());
  }
  /// The contacts of a sample now; nothing where none can be told yet, and the sample should not count.
  std::optional<std::vector<Contact>> take(const Look& look);

  template <class Archive>
  void serialize(Archive& a) {
    a(begun_, gathered_);
  }

 private:
  bool hard_ = false;
  std::int64_t from_ = 0;
  double begun_ = -1;  // time of the sample before, −1: none
  std::vector<Contact> gathered_;
};

/// Contacts of the same pair joined to one: forces add up, the frame is that of the total force's contacts.
std::vector<Contact> joined_by_pair(const std::vector<Contact>& contacts);

}  // namespace chute::measure
