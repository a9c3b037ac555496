#pragma once
#include <filesystem>
#include <optional>

#include "sweep/follow.hpp"

namespace chute::sweep {

/// Finished points of sweeps, one small file each, so that an interrupted sweep goes on, and several
/// processes can share one folder. A point is known by its complete scene and the build that made it.
class PointStore {
 public:
  /// WorkError if the folder cannot be made.
  explicit PointStore(std::filesystem::path folder);

  /// Nothing if the point is not there, is another build's, or cannot be read.
  std::optional<Outcome> find(const scene::Scene& scene) const;
  void put(const scene::Scene& scene, const Outcome& outcome) const;

  /// The point from the store, or else followed now and stored.
  Outcome get(const scene::Scene& scene, const Report& progress) const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path file_of(const std::string& scene) const;
};

}  // namespace chute::sweep
