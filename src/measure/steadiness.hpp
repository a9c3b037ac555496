#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "core/estimate.hpp"

namespace chute::measure {

/// What became of a flow, or of a single ball, by the end of a run.
enum class Verdict {
  stopped,       ///< it rests
  steady,        ///< it forgot its start, and its mean velocity no longer changes
  accelerating,  ///< its velocity grows without a sign of a limit (region C of thesis 4.1)
  runaway,       ///< it kept a velocity for a while, then left it for good (thesis fig. 5.6)
  unsettled      ///< none of these: the run is too short to say
};
/// Name of a verdict, as run.json has it.
std::string_view name(Verdict verdict);
/// The verdict of that name, or nothing.
std::optional<Verdict> verdict_named(std::string_view name);

/// Time series of a run, equally long. Where rows come in two different intervals, those that lie as far apart as the
/// longer one are judged.
struct FlowSeries {
  std::span<const double> time;
  std::span<const double> x;        ///< mean place along the incline, counted on through the periods
  std::span<const double> omega;    ///< mean spin
  std::span<const double> kinetic;  ///< kinetic energy of translation and rotation, per mass
};

/// What is long and fast for the grains.
struct FlowScales {
  double length;   ///< way from bead to bead of the bed
  double gravity;  ///< g
};

/// The verdict with the means that it allows. Where nothing settled there are no errors, and the means are
/// those of the last quarter of the run.
struct Flow {
  Verdict verdict;
  double from;   ///< the means count from this time to the end
  Estimate v_x;  ///< way over time, which is exact
  Estimate omega, kinetic;
};

/// Tells what became of a flow. The record is cut into 64 blocks of time; the velocity of a block is the way
/// made over the time. In this order:
///
/// - `stopped`: during the last 10 √(length/g) the kinetic energy per mass stays under 10⁻³ g·length and the
///   mean place within half a length. Counts from when that became so.
/// - `steady`: after the transient that MSER removes (what is left has nearly the least squared standard
///   error of the mean velocity), or after three fifths of the run if that is earlier, at least 20 lengths
///   are made; the linear trend over twelve stretches of that time changes the velocity by less than a tenth,
///   or by less than three of its standard errors, which must not exceed 0.15 of the velocity; and the last
///   eighth of the run lies within 15 % of the mean, or within four standard deviations of the stretches.
/// - `runaway`: three eighths of the run in a row were a plateau (means of the eighths within 15 %), the last
///   eighth is at least 1.3 times as fast and beyond the plateau's mean by four standard deviations of the blocks up to the
///   plateau's end (but the first eighth of the run), and the velocity still grows: over the last quarter by more than three
///   standard errors of its trend, and the last sixteenth is the fastest of all. A flow that recovers before the end, or strays
///   no farther than it did before, is none.
/// - `accelerating`: over the last three quarters of the run the velocity grows by a fifth or more and by more than three
///   standard errors of its trend, the growth from the second of these quarters to the third is at least 0.8 of that from the
///   first to the second, and the last sixteenth is slower than the fastest by no more than sixteenths scatter about the trend.
///   An approach to some velocity within a time shorter than the run slows down more than that.
/// - `unsettled`: everything else, and less than 64 rows. `runaway` and `accelerating` need a record of 20 √(length/g).
///
/// Errors are standard errors over twelve stretches, enlarged by √((1+r)/(1−r)) where neighbouring stretches
/// are correlated, r > 0.
Flow judge_flow(const FlowSeries& series, const FlowScales& scales);

/// Several starts together: the verdict that most of them have, and the means over those with the errors of their
/// scatter, from when the last of them settled.
Flow joined(std::span<const Flow> starts);

}  // namespace chute::measure
