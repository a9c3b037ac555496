#pragma once
#include "starts/start.hpp"

namespace chute::starts {

/// The grains as another run, another engine, or a file left them: places, velocities, spins, orientations, sizes,
/// masses, materials of its moving grains. The bed is the scene's own. Those above a height can get a push downhill: a
/// flow that begins on grains at rest, which is a bed that erodes.
class FromFile final : public Described<Start, FromFile> {
 public:
  static constexpr std::string_view word = "from", text = "what another run or a file left";
  std::string from;                   ///< a run directory, or a VTK file of grains
  std::optional<std::int64_t> frame;  ///< of the run; default its last checkpoint
  std::optional<double> time;         ///< or the frame at this time
  double velocity = 0;                ///< downhill, on top of what they have
  std::optional<double> above;        ///< for those whose centres are higher; default all

  template <class Archive>
  void describe(Archive& a) {
    a.required("from", from, "a run directory (its last checkpoint), or a VTK file of grains");
    a.value("frame", frame, non_negative, "that frame of the run instead, counted from 0");
    a.value("time", time, "or the frame at that time");
    a.check(!frame || !time, "time", "give either frame or time");
    a.value("velocity", velocity, "added downhill to what the grains have");
    a.value("above", above, "but only to grains whose centres are higher than this; default all");
    a.check(!above || velocity != 0, "above", "says where velocity is added; give that, too");
  }
  bool brings_grains() const override { return true; }
  std::optional<Refusal> misfit(const Opening& opening) const override;
  std::vector<Launch> begin(const Opening& opening) const override;
};

}  // namespace chute::starts
