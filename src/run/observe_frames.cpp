#include <fmt/format.h>

#include "common/atomic_file.hpp"
#include "run/observer.hpp"

namespace chute::run {
namespace {

/// The grains, and when asked for the contact network, one file per time; frames.pvd tells the times.
class Frames final : public Remembering<Frames> {
 public:
  explicit Frames(const RunContext& run)
      : run_(run), due_(run.schedule(run.scene.output.frames->from, run.scene.output.frames->every)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }

  void look(const Look& look) override {
    const auto k = due_.index_at(look.engine.step());
    if (k < 0) return;
    const GrainsView grains = look.engine.grains();
    write_file("frames", k, io::grains_vtp(grains, run_.facts));
    if (run_.scene.output.contacts)
      write_file("contacts", k, io::contacts_vtp(grains, look.engine.contacts(), run_.facts));
    times_.push_back(look.engine.time());
  }

  void write(const measure::Flow&) const override {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < times_.size(); ++k)
      names.push_back(name("frames", static_cast<std::int64_t>(k)));
    write_atomically(run_.directory.file("frames.pvd"), io::pvd(times_, names));
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(times_);
  }

 private:
  const RunContext& run_;
  Schedule due_;
  std::vector<double> times_;

  static std::string name(const char* folder, std::int64_t k) {
    return fmt::format("{}/{:06}.vtp", folder, k);
  }
  void write_file(const char* folder, std::int64_t k, const std::string& bytes) const {
    std::filesystem::create_directories(run_.directory.file(folder));
    write_atomically(run_.directory.file(name(folder, k)), bytes);
  }
};

}  // namespace

std::unique_ptr<Observer> observe_frames(const RunContext& run) {
  return run.scene.output.frames ? std::make_unique<Frames>(run) : nullptr;
}

}  // namespace chute::run
