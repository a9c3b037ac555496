#pragma once
#include <vector>

#include "view/frame_data.hpp"
#include "view/survey.hpp"

namespace chute::view {

/// Takes a frame to where the camera that follows something is: its focus to the origin, along the slope and along
/// what is periodic, and everything to the periodic image nearest to it. So bed and grains pass by, and nothing
/// jumps at the ends.
class Following {
 public:
  explicit Following(const Survey& survey);

  /// What is then seen of the run: bounds and domain about the origin.
  Survey around_focus() const;
  /// The data moved; valid until the next call.
  FrameData moved(const FrameData& data);

 private:
  const Survey& survey_;
  std::array<bool, 3> follows_{};  ///< axes
  read::GrainFrame frame_;
  std::vector<read::GrainFrame> earlier_;
  std::vector<const read::GrainFrame*> earlier_places_;
  std::vector<read::ForceLink> links_;
  std::vector<read::WallPiece> walls_;
  std::vector<read::Impact> impacts_;

  Eigen::Vector3d image(Eigen::Vector3d place, const Eigen::Vector3d& focus) const;
  read::GrainFrame image(const read::GrainFrame& frame, const Eigen::Vector3d& focus) const;
};

}  // namespace chute::view
