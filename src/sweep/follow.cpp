#include "sweep/follow.hpp"

#include <algorithm>

#include "common/error.hpp"
#include "run/session.hpp"

namespace chute::sweep {
namespace {

bool all_stopped(const std::vector<measure::Flow>& flows) {
  return std::ranges::all_of(flows, [](const auto& f) { return f.verdict == measure::Verdict::stopped; });
}

}  // namespace

Followed follow(const scene::Scene& scene, const Report& progress) {
  constexpr std::size_t rows_between_judgements = 100;
  run::Session session(scene, 1);
  session.begin();
  Followed followed;
  while (session.engine().step() < session.last_step()) {
    try {
      session.advance(session.last_step());
    } catch (const WorkError& error) {
      followed.left_physics = error.what();
      break;
    }
    if (session.series().rows() % rows_between_judgements != 0) continue;
    if (!progress(session.part_done())) throw WorkError("stopped");
    if (all_stopped(session.series().starts())) break;
  }
  followed.starts = session.series().starts();
  return followed;
}

}  // namespace chute::sweep
