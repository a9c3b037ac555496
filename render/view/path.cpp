#include "view/path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "common/fields.hpp"

namespace chute::view {

void PathFinder::see(const read::GrainFrame& frame, std::optional<long long> id, double time) {
  const auto* ids = frame.find(fields::id.name);
  const auto* velocities = frame.find(fields::velocity.name);
  const bool has_velocity = velocities && velocities->components == 3;
  if (id && !ids) throw InputError(frame.file.string() + ": no ids, so no grain can be followed");
  std::unordered_map<long long, Known> now;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moved = Eigen::Vector3d::Zero();
  double both = 0;  // grains that this frame shares with the one before
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const long long name = ids ? std::llround(ids->at(i)) : static_cast<long long>(i);
    if (id ? name != *id : frame.is_fixed(i)) continue;
    Known known{frame.centre(i), Eigen::Vector3d::Zero()};
    if (has_velocity) known.velocity = {velocities->at(i, 0), velocities->at(i, 1), velocities->at(i, 2)};
    sum += known.place;
    if (const auto old = before_.find(name); old != before_.end()) {
      // of all periodic images, the one nearest to where its velocity would have taken it
      const Eigen::Vector3d guess = (time - time_) * (known.velocity + old->second.velocity) / 2;
      Eigen::Vector3d way = known.place - old->second.place;
      for (int c = 0; c < 3; ++c)
        if (const double period = frame.period(c); period > 0)
          way[c] -= period * std::round((way[c] - guess[c]) / period);
      moved += way, both += 1;
    }
    now.emplace(name, known);
  }
  if (now.empty())
    throw InputError(id ? fmt::format("{}: no grain has the id {}, which the camera is to follow",
                                      frame.file.string(), *id)
                        : frame.file.string() + ": no grain moves that the camera could follow");
  if (path_.empty() || both == 0)
    path_.push_back(sum / static_cast<double>(now.size()));
  else
    path_.push_back(path_.back() + moved / both);
  before_ = std::move(now), time_ = time;
}

std::vector<Eigen::Vector3d> PathFinder::smooth() const {
  constexpr std::size_t most =
      4;  // frames on either side; fewer near the ends, so that steady motion stays so
  std::vector<Eigen::Vector3d> result;
  for (std::size_t i = 0; i < path_.size(); ++i) {
    const std::size_t reach = std::min({most, i, path_.size() - 1 - i});
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t k = i - reach; k <= i + reach; ++k) sum += path_[k];
    result.push_back(sum / static_cast<double>(2 * reach + 1));
  }
  return result;
}

}  // namespace chute::view
