#include <fmt/format.h>

#include "common/pvd.hpp"
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
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto k = static_cast<std::int64_t>(times_.size());  // on, where the interval changed meanwhile
    const GrainsView grains = look.engine.grains();
    const auto facts = facts_at(look.engine.time());
    run_.write_once(name("frames", k), io::grains_vtp(look.engine.drawn(), facts));
    if (with_contacts_) {
      auto contacts = contacts_.take(look).value_or(std::vector<Contact>{});
      if (run_.offers.collisions) contacts = joined_by_pair(contacts);
      run_.write_once(name("contacts", k), io::contacts_vtp(grains, contacts, facts));
    }
    times_.push_back(look.engine.time());
  }

  void write(const Flow&) const override {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < times_.size(); ++k)
      names.push_back(name("frames", static_cast<std::int64_t>(k)));
    run_.write("frames.pvd", pvd(times_, names));
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

  io::RunFacts facts_at(double time) const {
    io::RunFacts facts = run_.facts;
    facts.gravity = run_.gravity_at(time);
    return facts;
  }
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
