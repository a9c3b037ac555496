#pragma once
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "read/run_frames.hpp"
#include "view/color_field.hpp"
#include "view/frame_style.hpp"
#include "view/path.hpp"
#include "view/time_series.hpp"

namespace chute::view {

/// What a first look at all frames of a run tells: everything that must not change from one frame to the
/// next.
struct Survey {
  int dimensions = 2;
  int up_axis = 1;   ///< the incline's normal: 1 (y) in the plane, else where gravity points most, or z
  double slope = 0;  ///< radians: gravity is turned that much from the normal, towards +x
  Eigen::AlignedBox3d bounds;  ///< of all grains, radii included, in the files' frame
  Eigen::AlignedBox3d
      seen;  ///< what the camera shows of them: all but single grains that flew far (Surveyor::choose_view)
  std::size_t outside = 0,
              places = 0;  ///< places of moving grains in all frames that lie outside of it, and all of them
  Eigen::AlignedBox2d turned;  ///< 2D: the same as `seen` in the picture (turned by the slope if tilted;
                               ///< periodic copies included if they are drawn)
  Eigen::AlignedBox3d domain{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};  ///< as in GrainFrame
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::string units, clock;  ///< as in read::GrainFrame
  ColorField field;
  bool diverging = false;                          ///< values of both signs
  double low = 0, high = 1;                        ///< colour range
  bool exceeds_low = false, exceeds_high = false;  ///< some values lie outside
  std::vector<long long> categories;               ///< all values of a field that only names kinds, rising
  double diameter = 1;                             ///< mean of the moving grains (of all, if none moves)
  double speed = 0;                                ///< nearly the largest, for the length of arrows
  double force = 0;           ///< nearly the largest contact force, for the width of chains
  bool has_fixed = false;     ///< a bed, and grains that move over it
  std::vector<double> times;  ///< of each frame
  bool has_times = false;
  std::size_t left_out = 0;  ///< grains of all frames that have no place or no size
  int time_decimals = 2;
  /// What the camera follows at each time, smoothed over some frames; empty: it stands.
  std::vector<Eigen::Vector3d> path;
  TimeSeries series;  ///< plotted beside the grains; empty: no plot

  /// All of the above that decides pixels but the series, as text.
  std::string describe() const;
};

/// How far copies are drawn beyond the periodic ends, in periods.
inline constexpr double copy_reach = 0.16;
/// How far outside `domain` in x, as a share of copy_reach; a copy is drawn if it is below 1.
double beyond_domain(const Eigen::AlignedBox3d& domain, double x);

/// Reads every frame once, `jobs` at a time. `tell` hears how many are done. InputError as read_frame; also if
/// the field is missing.
Survey survey(const std::vector<read::FrameFile>& frames, const FrameStyle& style,
              std::optional<double> radius = {}, int jobs = 1,
              const std::function<void(std::size_t)>& tell = {});

/// Collects frames that are already in memory; what survey() is made of.
class Surveyor {
 public:
  explicit Surveyor(const FrameStyle& style);
  void see(const read::GrainFrame& frame, std::optional<double> time = {});
  void see_force(double force) { forces_.add(force); }
  Survey finish();

 private:
  /// Values in order of arrival, thinned evenly once there are many, so that a long run's quantiles fit in
  /// memory.
  struct Sample {
    std::vector<double> values;
    std::size_t stride = 1, seen = 0;
    double lowest = 0, highest = 0;
    void add(double value);
    double quantile(double q);
  };

  FrameStyle style_;
  Survey found_;
  bool first_ = true;
  double plane_ = 0;  ///< z of the first grain that was seen
  Sample values_, speeds_, forces_;
  // Of moving grains, as they are seen: lower and upper ends along each axis, in step with each other, for `choose_view`.
  std::array<Sample, 3> low_ends_, high_ends_;
  Eigen::AlignedBox3d resting_;  // the bed, as it is seen
  std::set<long long> kinds_;
  PathFinder path_;
  double diameters_ = 0, all_diameters_ = 0;
  std::size_t moving_ = 0, all_ = 0;
  void choose_range();
  void choose_view();
};

}  // namespace chute::view
