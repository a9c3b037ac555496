#pragma once
#include <filesystem>
#include <optional>

#include "sweep/follow.hpp"

namespace chute::sweep {

/// Finished points of sweeps, one small file each, so that an interrupted sweep goes on, and several
/// processes can share one folder. A point is known by its complete scene and the build that made it.
class PointStore {
 public:
  /// Thrown by `get` of a store that must not simulate.
  struct PointIsMissing {};

  /// WorkError if the folder cannot be made.
  explicit PointStore(std::filesystem::path folder);

  /// Nothing if the point is not there, is another build's, or cannot be read.
  std::optional<Followed> find(const scene::Scene& scene) const;
  /// The name of a point's file.
  std::string name_of(const scene::Scene& scene) const {
    return file_of(scene::to_toml(scene)).filename().string();
  }
  void put(const scene::Scene& scene, const Followed& outcome) const;

  /// The same points, and no others: `get` throws PointIsMissing instead of simulating.
  PointStore only_known() const {
    PointStore store = *this;
    store.only_known_ = true;
    return store;
  }
  /// The point from the store, or else followed now and stored.
  Followed get(const scene::Scene& scene, const Report& progress) const;

 private:
  std::filesystem::path folder_;
  bool only_known_ = false;
  std::filesystem::path file_of(const std::string& scene) const;
};

}  // namespace chute::sweep
