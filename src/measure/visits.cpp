#include <algorithm>

#include "measure/ball_outputs.hpp"
#include "measure/standstill.hpp"

namespace chute::measure {
namespace {

/// What passed between a grain and one bead.
struct Visit {
  std::int64_t bead = -1;
  double begin = 0, v_n_first = 0;  ///< first onset, and v_n just before it
  double onset = 0, end = 0;        ///< of the latest contact
  double v_n_last = 0;              ///< just after the latest contact
  double stay = unknown;            ///< until the first onset on the next new bead
  double hits = 0;
  bool touching = false, rolled = false;

  template <class Archive>
  void serialize(Archive& a) {
    a(bead, begin, v_n_first, onset, end, v_n_last, stay, hits, touching, rolled);
  }
};

/// The visits of grains to beads. A bead is new to a grain if it is neither the one that it visits nor the one before: a
/// grain that lies between two touches them in turn, and that is one visit to each. A visit is over when the second new bead
/// after it is hit. Thesis figs. 4.35 and 4.36.
class Visits final : public Remembering<Visits> {
 public:
  Visits(const RunContext& run, const BeadSpec& spec)
      : run_(run),
        first_(run.schedule(spec.from, 0).step_of(0)),
        rest_(run.frame.bead_spacing, run.gravity),
        kept_(spec.most) {}

  std::int64_t next_after(std::int64_t step) const override {
    return first_ > step ? first_ : std::numeric_limits<std::int64_t>::max();
  }
  bool wants_impacts(std::int64_t step) const override { return step >= first_; }

  void look(const Look& look) override {
    if (look.engine.step() < first_) return;
    const auto grains = look.engine.grains();
    rest_.note(grains);
    const double from = static_cast<double>(first_) * run_.time_step;
    // Both are in order of time; where times are equal, hard grains part in the collision that the impact tells of.
    auto parting = look.partings.begin();
    for (const auto& impact : look.impacts) {
      for (; parting != look.partings.end() && parting->time < impact.time; ++parting) part(*parting);
      if (impact.time > from) hit(impact, grains.moving);
    }
    for (; parting != look.partings.end(); ++parting) part(*parting);
    pending_.release(grains.time, rest_, [&](std::size_t i, double, const Visit& v) {
      kept_.add({static_cast<double>(i), static_cast<double>(v.bead), v.begin, v.v_n_first,
                 v.rolled ? 0 : v.v_n_last, static_cast<double>(v.rolled), v.hits, v.stay, v.end - v.begin});
    });
  }
  void write(const Flow&) const override {
    io::Csv csv(
        run_.comments(
            "visits of grains to beads: v_n just before the first impact, just after the last (0 where the "
            "grain rolled off: its last contact lasted longer than 2 t_n, or, of hard grains, was a train of "
            "collisions); stay: from the first onset to that on the next new bead; contact: to the end of "
            "the last contact"),
        {"grain", "bead", "time", "v_n_first", "v_n_last", "rolled", "hits", "stay", "contact"});
    for (const auto& row : kept_.kept()) {
      const std::vector<io::Csv::Cell> cells(row.begin(), row.end());
      csv.row(cells);
    }
    run_.write("beads.csv", csv.text());
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(rest_, latest_, pending_, kept_);
  }

 private:
  const RunContext& run_;
  std::int64_t first_;
  Standstill rest_;
  std::vector<std::array<Visit, 2>> latest_;  // of each grain: the current one, and the one before
  Pending<Visit> pending_;
  Thinned<std::array<double, 9>> kept_;

  Visit* visit_to(std::int64_t grain, std::int64_t bead) {
    const auto i = static_cast<std::size_t>(grain);
    if (latest_.size() <= i) latest_.resize(i + 1);
    for (Visit& visit : latest_[i])
      if (visit.hits > 0 && visit.bead == bead) return &visit;
    return nullptr;
  }
  void hit(const Impact& impact, std::size_t moving) {
    if (is_wall(impact.bead) || impact.bead < static_cast<std::int64_t>(moving)) return;  // no bead
    Visit* known = visit_to(impact.grain, impact.bead);
    if (!known) {
      auto& [now, before] = latest_[static_cast<std::size_t>(impact.grain)];
      if (before.hits > 0 && !before.touching)
        pending_.add(static_cast<std::size_t>(impact.grain), before.begin, before);
      now.stay = impact.time - now.begin;
      before = now;
      now = {};
      now.bead = impact.bead, now.begin = impact.time, now.v_n_first = impact.v_n;
      known = &now;
    }
    known->hits += 1;
    known->onset = impact.time;
    known->touching = true;
  }
  void part(const Parting& parting) {
    constexpr double rolling = 2;  // t_n: no bounce lasts as long
    Visit* visit = visit_to(parting.grain, parting.bead);
    if (!visit) return;
    visit->touching = false;
    visit->end = parting.time;
    visit->v_n_last = parting.v_n;
    visit->rolled = parting.rolling || parting.time - visit->onset > rolling * run_.contact_time;
  }
};

}  // namespace

std::vector<std::unique_ptr<Observer>> BeadsOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<Visits>(run, *spec));
  return observers;
}

}  // namespace chute::measure
