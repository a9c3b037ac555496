#include "view/following.hpp"

#include <algorithm>
#include <cmath>

namespace chute::view {

Following::Following(const Survey& survey) : survey_(survey) {
  follows_[0] = true;
  for (int c = 0; c < 3; ++c)
    follows_[static_cast<std::size_t>(c)] =
        follows_[static_cast<std::size_t>(c)] || survey.domain.sizes()[c] > 0;
  follows_[static_cast<std::size_t>(survey.up_axis)] = false;
}

Survey Following::around_focus() const {
  Survey seen = survey_;
  const double height = survey_.bounds.sizes()[survey_.up_axis];
  for (int c = 0; c < 3; ++c) {
    if (!follows_[static_cast<std::size_t>(c)]) continue;
    // without an end that comes back: three times as long as high, but not longer than the whole run
    const double period = survey_.domain.sizes()[c];
    const double length = period > 0 ? period : std::min(3 * height, survey_.bounds.sizes()[c]);
    seen.bounds.min()[c] = -length / 2, seen.bounds.max()[c] = length / 2;
    if (period > 0) seen.domain.min()[c] = -period / 2, seen.domain.max()[c] = period / 2;
  }
  seen.seen = seen.bounds;
  return seen;
}

Eigen::Vector3d Following::image(Eigen::Vector3d place, const Eigen::Vector3d& focus) const {
  for (int c = 0; c < 3; ++c) {
    if (!follows_[static_cast<std::size_t>(c)]) continue;
    place[c] -= focus[c];
    if (const double period = survey_.domain.sizes()[c]; period > 0)
      place[c] -= period * std::floor(place[c] / period + 0.5);
  }
  return place;
}

read::GrainFrame Following::image(const read::GrainFrame& frame, const Eigen::Vector3d& focus) const {
  read::GrainFrame result = frame;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Eigen::Vector3d place = image(frame.centre(i), focus);
    result.x[i] = place.x(), result.y[i] = place.y(), result.z[i] = place.z();
  }
  return result;
}

FrameData Following::moved(const FrameData& data) {
  const auto& focus = data.focus;
  frame_ = image(data.frame, focus);
  earlier_.clear(), earlier_places_.clear();
  for (const auto* earlier : data.earlier) earlier_.push_back(image(*earlier, focus));
  for (const auto& earlier : earlier_) earlier_places_.push_back(&earlier);
  links_.assign(data.links.begin(), data.links.end());
  for (auto& link : links_) {
    const Eigen::Vector3d branch = link.to - link.from;
    link.from = image(link.from, focus), link.to = link.from + branch;
  }
  impacts_.assign(data.impacts.begin(), data.impacts.end());
  for (auto& impact : impacts_) impact.place = image(impact.place, focus);
  // Along periodic axes walls look the same everywhere: they stay about the middle.
  walls_.assign(data.walls.begin(), data.walls.end());
  for (auto& wall : walls_)
    for (auto& corner : wall.corners)
      for (int c = 0; c < 3; ++c)
        if (follows_[static_cast<std::size_t>(c)])
          corner[c] -= survey_.domain.sizes()[c] > 0 ? survey_.domain.center()[c] : focus[c];
  return {frame_, data.time, links_, earlier_places_, walls_, impacts_, Eigen::Vector3d::Zero()};
}

}  // namespace chute::view
