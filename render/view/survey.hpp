#pragma once
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "read/run_frames.hpp"
#include "view/color_field.hpp"
#include "view/extent.hpp"
#include "view/frame_style.hpp"
#include "view/path.hpp"
#include "view/time_series.hpp"

namespace chute::view {

/// What a first look at all frames of a run tells: everything that must not change from one frame to the
/// next.
struct Survey {
  int dimensions = 2;
  /// Upwards, of length 1: as the style says; else the incline's normal, which is y in the plane, else against the axis along
  /// which gravity points most, or where nobody says along that by which grains spread least by far; else z.
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  int up_axis = 1;             ///< the axis nearest to it
  double slope = 0;            ///< radians: gravity is turned that much from the normal, towards +x
  double turn = 0;             ///< 2D, radians: by which the picture is turned
  Eigen::AlignedBox3d bounds;  ///< what is to be seen, radii included, in the files' frame; see Extent
  Eigen::AlignedBox2d
      turned;  ///< 2D: the same as seen in the picture (periodic copies included if they are drawn)
  std::size_t outside = 0;  ///< moving grains of all frames whose centres lie outside of it
  bool about = false;       ///< that number was estimated
  bool cropped = false;     ///< grains or parts of the bed lie outside
  Eigen::AlignedBox3d domain{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};  ///< as in GrainFrame
  std::optional<read::Lattice> lattice;                                          ///< of the first frame
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::string units, clock;  ///< as in read::GrainFrame
  ColorField field;
  bool diverging = false;                          ///< values of both signs
  double low = 0, high = 1;                        ///< colour range
  bool exceeds_low = false, exceeds_high = false;  ///< some values lie outside
  std::vector<long long> categories;               ///< all values of a field that only names kinds, rising
  std::vector<std::string> kind_names;             ///< of `categories`, where names are known
  bool other_kinds = false;                        ///< there are more words than colours: these have none
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

/// How far outside `domain` in x, as a share of the `reach` of copies in periods; a copy is drawn if it is below 1.
double beyond_domain(const Eigen::AlignedBox3d& domain, double x, double reach);

/// By how much copies are shifted along x: whole periods to both sides, as far as they are drawn.
std::vector<double> copy_shifts(const FrameStyle& style, double period);

/// A frame with the files that it was read from.
struct ReadFrame {
  std::vector<read::FileBytes> files;
  read::GrainFrame frame;
};

/// Reads every frame once, `jobs` at a time. `tell` hears how many are done. InputError as read_frame; also if
/// the field is missing.
Survey survey(const std::vector<read::FrameFile>& frames, const FrameStyle& style,
              const read::Meanings& meanings = {}, int jobs = 1,
              const std::function<void(std::size_t)>& tell = {});

/// The same of a frame that was read, with the arrays that a survey looks at, and happens at `time`.
Survey survey(const ReadFrame& frame, std::optional<double> time, const FrameStyle& style);

/// The arrays that a survey looks at.
std::vector<std::string> surveyed_arrays(const FrameStyle& style);

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
  std::set<long long> kinds_;
  std::map<std::string, std::size_t> words_;     ///< of a field of words: how many grains of each
  std::map<long long, std::string> kind_names_;  ///< that the file gives beside a number
  Extent extent_;
  Eigen::AlignedBox2d copies_;  ///< as seen in the picture
  PathFinder path_;
  double diameters_ = 0, all_diameters_ = 0;
  std::size_t moving_ = 0, all_ = 0;
  void see_kinds(const read::GrainFrame& frame, const std::vector<double>& values);
  void choose_kinds();
  void choose_up();
  void choose_view();
  void choose_range();
};

/// The box of a space: that which the file tells; else that in which the run is periodic, and of what is in view along other axes.
Eigen::AlignedBox3d box_of_space(const Survey& survey);

/// What tells depths in a space, as far as the style does not say: silhouettes, a floor with shadows, and the box, unless only the
/// grains are wanted. A box that is much larger than what is in view would make that small, and must be asked for.
void furnish_space(FrameStyle& style, const Survey& survey);

}  // namespace chute::view
