#include <fmt/format.h>

#include "measure/contact_samples.hpp"
#include "measure/outputs.hpp"

namespace chute::measure {
namespace {

/// The grains, and when asked for the contact network, one file per time; frames.pvd tells the times.
class Frames final : public Remembering<Frames> {
 public:
  Frames(const RunContext& run, const FramesOutput& output)
      : run_(run),
        due_(run.schedule(output.frames->from, output.frames->every)),
        with_contacts_(output.contacts),
        contacts_(run, due_.step_of(0)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  bool wants_collisions(std::int64_t step) const override {
    return with_contacts_ && contacts_.wants_collisions(step);
  }

  void look(const Look& look) override {
    if (with_contacts_) contacts_.gather(look);
    const auto k = due_.index_at(look.engine.step());
    if (k < 0) return;
    const GrainsView grains = look.engine.grains();
    run_.write(name("frames", k), io::grains_vtp(grains, run_.facts));
    if (with_contacts_) {
      auto contacts = contacts_.take(look).value_or(std::vector<Contact>{});
      if (run_.offers.collisions) contacts = joined_by_pair(contacts);
      run_.write(name("contacts", k), io::contacts_vtp(grains, contacts, run_.facts));
    }
    times_.push_back(look.engine.time());
  }

  void write(const Flow&) const override {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < times_.size(); ++k)
      names.push_back(name("frames", static_cast<std::int64_t>(k)));
    run_.write("frames.pvd", io::pvd(times_, names));
    if (!run_.facts.walls.empty()) run_.write("walls.vtp", io::walls_vtp(run_.facts));
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(times_, contacts_);
  }

 private:
  const RunContext& run_;
  Schedule due_;
  bool with_contacts_;
  ContactSamples contacts_;
  std::vector<double> times_;

  static std::string name(const char* folder, std::int64_t k) {
    return fmt::format("{}/{:06}.vtp", folder, k);
  }
};

}  // namespace

std::vector<std::unique_ptr<Observer>> FramesOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Frames>(run, *this));
  return observers;
}

}  // namespace chute::measure
