#include "replay/measure_frames.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/error.hpp"
#include "common/fields.hpp"
#include "common/new_folder.hpp"
#include "common/pvd.hpp"
#include "io/run_files.hpp"
#include "measure/series.hpp"
#include "replay/frame_outputs.hpp"
#include "replay/replay_engine.hpp"

namespace chute::replay {
namespace fs = std::filesystem;
namespace {

double mean_diameter(const Snapshot& frame, bool of_bed) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < frame.size(); ++i)
    if ((!frame.fixed.empty() && frame.fixed[i]) == of_bed) sum += 2 * frame.radius[i], ++count;
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

/// Length along an axis that layers are averaged over: the period, or as far as the grains reach.
double extent(const Snapshot& frame, std::size_t k) {
  const double period = frame.domain[2 * k + 1] - frame.domain[2 * k];
  if (period > 0) return period;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    low = std::min(low, frame.place[i][k] - frame.radius[i]);
    high = std::max(high, frame.place[i][k] + frame.radius[i]);
  }
  return high - low;
}

/// Nominal way from bead to bead: the mean one along the line that they make, or a bead's diameter.
double bead_spacing(const Snapshot& frame, double diameter) {
  std::vector<double> along;
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (!frame.fixed.empty() && frame.fixed[i]) along.push_back(frame.place[i][0]);
  const double period = frame.domain[1] - frame.domain[0];
  if (frame.dimensions == 2 && along.size() > 1 && period > 0)
    return period / static_cast<double>(along.size());
  return diameter;
}

std::size_t species_that_move(const Snapshot& frame) {
  std::set<int> species;
  for (std::size_t i = 0; i < frame.material.size(); ++i)
    if (frame.fixed.empty() || !frame.fixed[i]) species.insert(frame.material[i]);
  return species.size();
}

class Measuring {
 public:
  explicit Measuring(const MeasureJob& job) : job_(job), folder_(job.folder, is_measured) {}

  MeasureReport go() {
    choose_frames();
    auto first = job_.read(chosen_.front());
    folder_.make();
    set_up(first);
    play(std::move(first));
    write();
    folder_.keep();
    tell_what_is_missing();
    return report_;
  }

 private:
  const MeasureJob& job_;
  NewFolder folder_;  // emptied last, after those who write into it
  MeasureReport report_;
  std::vector<std::size_t> chosen_;
  double between_ = 1;
  measure::RunContext run_;
  std::unique_ptr<ReplayEngine> engine_;
  std::vector<Chosen<measure::Output>> outputs_;
  std::vector<std::unique_ptr<measure::Observer>> observers_;
  measure::SeriesObserver* series_ = nullptr;
  std::set<std::string> late_species_;  // that the first frame has not
  bool forces_ = true, network_ = false, masses_ = true, velocities_ = true, spins_ = true;

  void choose_frames() {
    for (std::size_t k = 0; k < job_.times.size(); ++k)
      if (job_.times[k] >= job_.from && job_.times[k] <= job_.until) chosen_.push_back(k);
    if (chosen_.empty())
      throw InputError(fmt::format("--from, --until: no frame lies there; times are {:.6g} to {:.6g}",
                                   job_.times.front(), job_.times.back()));
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < chosen_.size(); ++k) {
      const double way = job_.times[chosen_[k]] - job_.times[chosen_[k - 1]];
      if (!(way > 0))
        throw InputError(fmt::format("frame {}: its time {:.6g} is not after that of the frame before",
                                     chosen_[k], job_.times[chosen_[k]]));
      shortest = std::min(shortest, way);
    }
    if (std::isfinite(shortest)) between_ = shortest;
    constexpr double countable = 9e15;  // beyond it doubles miss some whole numbers
    for (const std::size_t k : chosen_)
      if (!(std::abs(job_.times[k] / between_) < countable))
        throw InputError(
            fmt::format("frame {}: its time {:.6g} is no multiple of {:.3g}, the shortest time between "
                        "frames, that can be counted",
                        k, job_.times[k], between_));
  }

  /// A step is the shortest time between frames.
  std::int64_t step_of(double time) const {
    const auto step = std::llround(time / between_);
    return step == 0 && time != 0 ? 1 : step;  // step 0 is at time 0
  }

  void set_up(const Snapshot& first) {
    if (first.size() == 0) throw InputError(first.name + ": holds no grains");
    const double moving = mean_diameter(first, false), bed = mean_diameter(first, true);
    const double length = bed > 0 ? bed : moving;
    const double widest = 2 * *std::max_element(first.radius.begin(), first.radius.end());
    if (!(job_.gap >= 0 && job_.gap <= widest))  // nor is there memory for all pairs of grains
      throw InputError(fmt::format(
          "--gap {:g}: must be from 0 to the largest diameter, {:g}: grains farther apart do not touch",
          job_.gap, widest));
    const double g = std::hypot(first.gravity[0], first.gravity[1], first.gravity[2]);
    run_.title = job_.title;
    run_.made_by = (first.units.empty() ? "" : fmt::format("units: {}; ", first.units)) + job_.made_by;
    run_.facts.units = first.units;
    run_.facts.dimensions = first.dimensions;
    run_.facts.domain = first.domain;
    run_.facts.gravity = first.gravity;
    run_.frame.dimensions = first.dimensions;
    run_.frame.bead_spacing = bead_spacing(first, length);
    run_.frame.footprint = extent(first, 0) * (first.dimensions == 3 ? extent(first, 1) : 1);
    run_.offers.contacts = true;
    for (const auto word : fields::clocks)
      if (word == first.clock) run_.offers.clock = run_.facts.clock = word;
    run_.gravity = g;
    run_.diameter = moving;
    run_.time_step = between_;
    run_.duration = job_.times[chosen_.back()];
    run_.files = std::make_shared<io::RunFiles>(job_.folder);
    engine_ = ReplayEngine::make(first.dimensions, job_.gap);
    const std::size_t dimensions = static_cast<std::size_t>(first.dimensions);
    bool closed = true;
    for (std::size_t k = 0; k < dimensions; ++k) closed &= first.domain[2 * k + 1] > first.domain[2 * k];
    run_.materials = first.materials;
    const FrameScales scales{{run_.duration, length, g > 0 ? std::sqrt(g * length) : 1, between_},
                             between_,
                             closed,
                             !first.velocity.empty(),
                             first.contacts.has_value(),
                             species_that_move(first) > 1};
    outputs_ = frame_outputs(scales, job_.from, job_.only, job_.settings);
    for (const auto& output : outputs_) {
      if (output->needs().closed_box && !closed)
        throw InputError(first.name + ": " + output.word() +
                         " needs a domain that repeats in all directions");
      if (output.word() == "segregation" && first.materials.empty())
        throw InputError(fmt::format("{}: no array {}, type or species, of which segregation tells",
                                     first.name, fields::material.name));
      for (auto& observer : output->make(run_)) {
        if (auto* series = dynamic_cast<measure::SeriesObserver*>(observer.get())) series_ = series;
        observers_.push_back(std::move(observer));
      }
    }
  }

  void play(Snapshot frame) {
    std::vector<double> times;
    std::vector<std::string> networks;
    for (std::size_t k = 0; k < chosen_.size(); ++k) {
      if (k > 0) frame = job_.read(chosen_[k]);
      if (frame.dimensions != run_.frame.dimensions && frame.size() > 0)
        throw InputError(fmt::format("{}: has {} dimensions, the first frame {}", frame.name,
                                     frame.dimensions, run_.frame.dimensions));
      frame.dimensions = run_.frame.dimensions;
      const double time = job_.times[chosen_[k]];
      number_species(frame);
      engine_->show(frame, step_of(time), time);
      note_what_is_there(frame);
      if (frame.velocity.empty() && frame.size() > 0)
        for (const auto& output : outputs_)
          if (needs_velocities(output.word()))
            throw InputError(fmt::format("{}: no array {}, of which {} tells", frame.name,
                                         fields::velocity.name, output.word()));
      for (const auto& observer : observers_) observer->look({*engine_, {}, {}});
      if (job_.network && !frame.contacts) {
        const auto name = fmt::format("contacts/{:06}.vtp", k);
        run_.write_once(name, io::contacts_vtp(engine_->grains(), engine_->contacts(), run_.facts));
        times.push_back(time), networks.push_back(name);
        network_ = true;
      }
      ++report_.frames;
      if (job_.progress && !job_.progress(report_.frames, chosen_.size()))
        throw WorkError("stopped; nothing was measured");
    }
    if (network_) run_.write("contacts.pvd", pvd(times, networks));
  }

  /// As the first frame numbers them, whatever this one has.
  void number_species(Snapshot& frame) {
    std::vector<int> number;
    for (const auto& name : frame.materials) {
      const auto known = std::ranges::find(run_.materials, name);
      number.push_back(static_cast<int>(known - run_.materials.begin()));
      if (known == run_.materials.end()) late_species_.insert(name);
    }
    for (int& material : frame.material) material = number[static_cast<std::size_t>(material)];
  }

  void note_what_is_there(const Snapshot& frame) {
    if (frame.size() == 0) return;
    forces_ &= engine_->knows_forces();
    masses_ &= !frame.mass.empty();
    velocities_ &= !frame.velocity.empty();
    spins_ &= !frame.spin.empty();
  }

  void write() {
    const auto flow = series_ && series_->rows() > 0 ? series_->flow() : measure::Flow{};
    for (const auto& observer : observers_) observer->write(flow);
    run_.files->commit();
    for (const auto& output : outputs_)
      for (const auto& name : output->files())
        if (fs::exists(job_.folder / name)) report_.written.push_back(name);
    if (network_) report_.written.emplace_back("contacts");
  }

  void tell_what_is_missing() {
    if (!late_species_.empty())
      report_.notes.push_back(
          fmt::format("the first frame has no grains of {}: tables of species leave them out",
                      fmt::join(late_species_, ", ")));
    const auto lacks = [&](bool there, std::string_view array, const char* what) {
      if (!there) report_.notes.push_back(fmt::format("no array {}: {}", array, what));
    };
    lacks(velocities_, fields::velocity.name, "velocities, temperatures and kinetic stresses are empty");
    lacks(spins_, fields::angular_velocity.name, "omega and rotation are empty");
    lacks(masses_, fields::mass.name, "densities, kinetic stresses and energies are empty");
    lacks(
        forces_, fields::normal_force.name,
        "contacts are those whose surfaces overlap, and contact stresses are empty; a run writes forces with "
        "output.contacts = true");
  }
};

}  // namespace

bool is_measured(const fs::path& name) {
  const auto files = measure::all_files();
  return name == "contacts" || name == "contacts.pvd" || std::ranges::count(files, name.string()) > 0;
}

MeasureReport measure_frames(const MeasureJob& job) { return Measuring(job).go(); }

}  // namespace chute::replay
