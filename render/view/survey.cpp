#include "view/survey.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <limits>
#include <numbers>

#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/grain_frame.hpp"
#include "read/network.hpp"

namespace chute::view {
namespace {

/// More different values than this are numbers to be ordered, not kinds to be told apart by colour.
constexpr std::size_t most_kinds = kind_color_count;

/// Rounds away from zero to a plain number, a tenth larger on average: the ends of a colour bar should be
/// readable.
double round_up(double x) {
  if (x == 0 || !std::isfinite(x)) return x;
  const double power = std::pow(10, std::floor(std::log10(std::abs(x)))), leading = std::abs(x) / power;
  const double step = leading <= 2 ? 0.2 : leading <= 5 ? 0.5 : 1;
  const double rounded = std::copysign(std::ceil(leading / step - 1e-9) * step * power, x);
  return std::isfinite(rounded) && power > 0 ? rounded : x;  // at either end of what doubles can hold
}

/// Decimals that tell the times of frames as they are, at most `most`. Times that are a whole number of steps, and so a little
/// off a round one, are told as that: to a thousandth of what lies between two frames.
int decimals_for(const std::vector<double>& times, int most) {
  constexpr double part = 1e-3;
  double between = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i] > times[i - 1]) between = std::min(between, times[i] - times[i - 1]);
  const double slack = std::isfinite(between) ? part * between : 0;
  for (int decimals = 0; decimals < most; ++decimals) {
    const double unit = std::pow(10.0, -decimals);
    const bool enough = std::all_of(times.begin(), times.end(), [&](double v) {
      return std::abs(v - unit * std::round(v / unit)) <= slack + 1e-6 * unit + 1e-12 * std::abs(v);
    });
    if (enough) return decimals;
  }
  return most;
}

}  // namespace

void Surveyor::Sample::add(double value) {
  if (!std::isfinite(value)) return;
  lowest = seen ? std::min(lowest, value) : value;
  highest = seen ? std::max(highest, value) : value;
  if (seen++ % stride) return;
  values.push_back(value);
  if (values.size() < 4'000'000) return;
  for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
  values.resize((values.size() + 1) / 2);
  stride *= 2;
}

double Surveyor::Sample::quantile(double q) {
  if (values.empty()) return 0;
  const auto k = static_cast<std::ptrdiff_t>(std::lround(q * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

std::vector<double> copy_shifts(const FrameStyle& style, double period) {
  std::vector<double> shifts;
  for (int k = 1; k <= static_cast<int>(std::ceil(style.copy_reach)); ++k)
    shifts.push_back(-k * period), shifts.push_back(k * period);
  return shifts;
}

double beyond_domain(const Eigen::AlignedBox3d& domain, double x, double reach) {
  const double from = domain.min().x(), to = domain.max().x();
  return std::max(from - x, x - to) / (reach * (to - from));
}

Surveyor::Surveyor(const FrameStyle& style) : style_(style) {
  style_.check();
  found_.has_times = true;
}

void Surveyor::see(const read::GrainFrame& frame, std::optional<double> time) {
  auto& s = found_;
  s.left_out += frame.left_out;
  s.has_times = s.has_times && (time || frame.time);
  s.times.push_back(time ? *time : frame.time.value_or(static_cast<double>(s.times.size())));
  if (frame.size() == 0) {  // grains that are still to come, or have left
    if (style_.camera.follow) path_.see(frame, style_.camera.follow->id, s.times.back());
    return;
  }
  if (first_) {
    first_ = false;
    plane_ = frame.z.front();
    s.dimensions = frame.dimensions;
    s.units = frame.units, s.clock = frame.clock, s.domain = frame.domain, s.gravity = frame.gravity;
    s.lattice = frame.lattice;
    s.field = find_field(style_.color, frame);
    const auto& g = s.gravity;
    s.up_axis = s.dimensions == 2 || std::abs(g[1]) > std::abs(g[2]) ? 1 : 2;
    const double down = -g[static_cast<std::size_t>(s.up_axis)];
    if (down > 0) s.slope = std::atan2(g[0], down);
    s.turn = style_.tilt ? -s.slope : 0;
    if (style_.up && style_.up->head<2>().norm() > 0)
      s.turn = std::numbers::pi / 2 - std::atan2(style_.up->y(), style_.up->x());
  }
  // a plane that moves from frame to frame is a layer in space
  s.dimensions = std::max(s.dimensions, frame.z.front() == plane_ ? frame.dimensions : 3);

  const Eigen::Rotation2Dd turn(s.turn);
  const double period = style_.copies ? s.domain.sizes().x() : 0;
  const auto shifts = copy_shifts(style_, period);
  const auto values = s.field.values(frame);
  const auto* velocity = frame.find(fields::velocity.name);
  bool any_moving = false, any_fixed = false;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const double r = frame.radius[i];
    const Eigen::Vector3d centre = frame.centre(i);
    if (period > 0) {
      const auto see_copy = [&](double shift) {
        const Eigen::Vector2d seen = turn * Eigen::Vector2d(centre.x() + shift, centre.y());
        copies_.extend((seen.array() - r).matrix()).extend((seen.array() + r).matrix());
      };
      see_copy(0);
      for (const double shift : shifts)
        if (beyond_domain(s.domain, centre.x() + shift, style_.copy_reach) < 1) see_copy(shift);
    }
    const bool fixed = frame.is_fixed(i);
    (fixed ? any_fixed : any_moving) = true;
    extent_.add(centre, r, fixed);
    ++all_, all_diameters_ += 2 * r;
    if (fixed) continue;
    ++moving_, diameters_ += 2 * r;
    values_.add(values[i]);
    if (velocity && velocity->components == 3)
      speeds_.add(std::hypot(velocity->at(i, 0), velocity->at(i, 1), velocity->at(i, 2)));
  }
  if (s.field.kinds) see_kinds(frame, values);
  s.has_fixed = s.has_fixed || (any_fixed && any_moving);
  if (style_.camera.follow) path_.see(frame, style_.camera.follow->id, s.times.back());
}

void Surveyor::see_kinds(const read::GrainFrame& frame, const std::vector<double>& values) {
  const auto* array = frame.find(found_.field.array);
  const auto* names = frame.find("species");
  const bool named = names && names != array && !names->words.empty();
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (frame.is_fixed(i)) continue;
    if (array && !array->words.empty()) {
      if (const double word = array->at(i); std::isfinite(word))
        ++words_[array->words[static_cast<std::size_t>(word)]];
    } else if (std::isfinite(values[i]) && kinds_.size() <= most_kinds) {
      const auto kind = std::llround(values[i]);
      kinds_.insert(kind);
      if (named && std::isfinite(names->at(i)))
        kind_names_.emplace(kind, names->words[static_cast<std::size_t>(names->at(i))]);
    }
  }
}

void Surveyor::choose_kinds() {
  auto& s = found_;
  if (!words_.empty()) {
    std::vector<std::pair<std::size_t, std::string>> often;
    for (const auto& [word, count] : words_) often.emplace_back(count, word);
    s.other_kinds = often.size() > most_kinds;
    if (s.other_kinds) {  // the most frequent ones, and of those that are as frequent the first by name
      std::stable_sort(often.begin(), often.end(),
                       [](const auto& a, const auto& b) { return a.first > b.first; });
      often.resize(most_kinds);
    }
    for (auto& [count, word] : often) s.field.words.push_back(std::move(word));
    std::sort(s.field.words.begin(), s.field.words.end());
    for (std::size_t i = 0; i < s.field.words.size(); ++i) s.categories.push_back(static_cast<long long>(i));
    s.kind_names = s.field.words;
  } else if (!kinds_.empty() && kinds_.size() <= most_kinds) {
    s.categories.assign(kinds_.begin(), kinds_.end());
    if (!kind_names_.empty())
      for (const auto kind : s.categories)
        s.kind_names.push_back(kind_names_.contains(kind) ? kind_names_[kind] : std::to_string(kind));
  }
  if (style_.species.empty()) return;
  if (s.categories.empty())
    throw InputError(
        "species: the grains are not coloured by kinds that could have names; --color type does that");
  if (style_.species.size() != s.categories.size())
    throw InputError(fmt::format("species: {} name{}, but there are {} kinds: {}", style_.species.size(),
                                 style_.species.size() == 1 ? "" : "s", s.categories.size(),
                                 s.kind_names.empty() ? fmt::format("{}", fmt::join(s.categories, ", "))
                                                      : fmt::format("{}", fmt::join(s.kind_names, ", "))));
  s.kind_names = style_.species;
}

void Surveyor::choose_up() {
  auto& s = found_;
  if (s.dimensions == 3 && s.up_axis == 1 && std::abs(s.gravity[1]) <= std::abs(s.gravity[2])) s.up_axis = 2;
  if (s.dimensions == 3 && s.gravity.isZero(0) && extent_.thinnest() >= 0) s.up_axis = extent_.thinnest();
  s.up = Eigen::Vector3d::Unit(s.up_axis);
  if (!s.gravity.isZero(0) && s.gravity[s.up_axis] > 0) s.up = -s.up;
  if (!style_.up) return;
  s.up = style_.up->normalized();
  Eigen::Index axis = 0;
  s.up.cwiseAbs().maxCoeff(&axis);
  s.up_axis = static_cast<int>(axis);
}

void Surveyor::choose_view() {
  auto& s = found_;
  const bool all = style_.camera.all || style_.copies;
  auto view = extent_.view(s.up_axis, Eigen::Matrix3d::Identity(), 0, all);
  s.bounds = view.box;
  if (s.dimensions == 2) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(s.turn).toRotationMatrix();
    if (s.turn == 0) turn.setIdentity();
    view = extent_.view(1, turn, static_cast<double>(style_.width) / style_.height, all);
    s.turned = {view.box.min().head<2>(), view.box.max().head<2>()};
    if (!copies_.isEmpty()) s.turned = copies_;
  }
  s.outside = view.outside, s.about = view.about, s.cropped = view.cropped;
}

void Surveyor::choose_range() {
  auto& s = found_;
  auto& values_ = s.field.forces ? forces_ : this->values_;
  if (style_.range) {
    std::tie(s.low, s.high) = *style_.range;
    s.diverging = style_.map.empty() ? s.low < 0 && s.high > 0 && s.low == -s.high : false;
  } else if (values_.values.empty() || !s.field.has_bar()) {
    s.low = 0, s.high = 1;
  } else if (s.field.is_signed() || (values_.lowest < 0 && values_.highest > 0)) {
    const double end =
        round_up(std::max(std::abs(values_.quantile(0.0025)), std::abs(values_.quantile(0.9975))));
    s.high = end > 0 ? end : 1, s.low = -s.high, s.diverging = true;
  } else {
    s.high = values_.quantile(0.995), s.low = values_.quantile(0.005);
    const bool from_zero =
        s.field.forces || s.field.part == ColorField::Part::magnitude || (s.low >= 0 && s.low < 0.4 * s.high);
    if (from_zero) s.low = 0, s.high = round_up(s.high);
    if (!(s.high > s.low)) {
      const double beside = std::max(std::abs(s.low) / 2, std::numeric_limits<double>::denorm_min());
      const double most = std::numeric_limits<double>::max();
      if (s.low == 0)
        s.high = 1;
      else
        s.high = std::min(s.low + beside, most), s.low = std::max(s.low - beside, -most);
    }
  }
  const double slack = 1e-9 * s.high - 1e-9 * s.low;
  s.exceeds_low = values_.seen && values_.lowest < s.low - slack;
  s.exceeds_high = values_.seen && values_.highest > s.high + slack;
}

Survey Surveyor::finish() {
  if (first_) throw InputError(found_.times.empty() ? "no frames to draw" : "no frame has a grain");
  auto& s = found_;
  choose_up();
  choose_view();
  choose_range();
  choose_kinds();
  if (style_.camera.follow) s.path = path_.smooth();
  s.diameter =
      moving_ ? diameters_ / static_cast<double>(moving_) : all_diameters_ / static_cast<double>(all_);
  s.speed = speeds_.quantile(0.99);
  s.force = forces_.quantile(0.99);
  s.time_decimals = s.times.size() > 1 ? decimals_for(s.times, 4) : decimals_for(s.times, 2);
  return s;
}

Eigen::AlignedBox3d box_of_space(const Survey& survey) {
  Eigen::AlignedBox3d box;
  if (const auto& lattice = survey.lattice) {
    for (int corner = 0; corner < 8; ++corner)
      box.extend(lattice->origin +
                 lattice->edges * Eigen::Vector3d(corner & 1, corner >> 1 & 1, corner >> 2));
    return box;
  }
  box = survey.bounds;
  for (int c = 0; c < 3; ++c)
    if (survey.domain.sizes()[c] > 0)
      box.min()[c] = survey.domain.min()[c], box.max()[c] = survey.domain.max()[c];
  return box;
}

void furnish_space(FrameStyle& style, const Survey& survey) {
  constexpr double much_larger = 1.3;
  const bool fits =
      (box_of_space(survey).sizes().array() <= much_larger * survey.bounds.sizes().array()).all();
  if (!style.outlines) style.outlines = style.furniture;
  if (!style.floor) style.floor = style.furniture;
  if (!style.box) style.box = style.furniture && fits;
}

std::string Survey::describe() const {
  const auto text = [](const Eigen::VectorXd& v) {
    return fmt::format("{},", fmt::join(v.begin(), v.end(), ","));
  };
  return fmt::format(
             "{} {} {} {} bounds={} turned={} domain={} gravity={} units={} field={}:{}:{} range={}:{} {:d}{:d}{:d} "
             "diameter={} speed={} force={} fixed={:d} decimals={} times={:d} categories={}",
             dimensions, text(up), slope, turn, text(bounds.min()) + text(bounds.max()),
             text(turned.min()) + text(turned.max()), text(domain.min()) + text(domain.max()), text(gravity),
             units + clock,
             field.forces     ? "chains"
             : field.sign < 0 ? "-" + field.array
                              : field.array,
             static_cast<int>(field.part), field.component, low, high, diverging, exceeds_low, exceeds_high,
             diameter, speed, force, has_fixed, time_decimals, has_times, fmt::join(categories, ",")) +
         fmt::format(" kinds={}|{}", fmt::join(kind_names, "|"), fmt::join(field.words, "|")) +
         (lattice ? fmt::format(" lattice={}{}", text(lattice->origin), text(lattice->edges.reshaped()))
                  : "");
}

std::vector<std::string> surveyed_arrays(const FrameStyle& style) {
  std::vector<std::string> names{color_array(style.color), std::string(fields::velocity.name)};
  if (style.camera.follow || style.chains) names.emplace_back(fields::id.name);
  return names;
}

Survey survey(const ReadFrame& frame, std::optional<double> time, const FrameStyle& style) {
  Surveyor surveyor(style);
  surveyor.see(frame.frame, time);
  return surveyor.finish();
}

Survey survey(const std::vector<read::FrameFile>& frames, const FrameStyle& style,
              const read::Meanings& meanings, int jobs, const std::function<void(std::size_t)>& tell) {
  const auto wanted = surveyed_arrays(style);
  struct Seen {
    read::GrainFrame frame;
    std::vector<read::ForceLink> links;
  };
  const auto understand = [&](std::size_t i, std::vector<read::FileBytes> files) {
    const bool chains = style.chains && !frames[i].contacts.empty();
    Seen seen{read::parse_frame(std::move(files), meanings, wanted), {}};
    if (chains) seen.links = read::parse_network(read::network_bytes(frames[i]), meanings, &seen.frame);
    return seen;
  };
  Surveyor surveyor(style);
  // The first alone: VTK makes its tables then, which is not for threads. Later ones are read ahead.
  std::deque<std::future<Seen>> ahead;
  for (std::size_t i = 0, next = 1; i < frames.size(); ++i) {
    const Seen seen = i == 0 ? understand(0, read::read_files(frames[0])) : ahead.front().get();
    if (i > 0) ahead.pop_front();
    for (; next < frames.size() && next <= i + static_cast<std::size_t>(jobs); ++next)
      // Bytes are read one frame after the other: places in a packed file are reached in order.
      ahead.push_back(std::async(jobs > 1 ? std::launch::async : std::launch::deferred, understand, next,
                                 read::read_files(frames[next])));
    surveyor.see(seen.frame, frames[i].time);
    for (const auto& link : seen.links) surveyor.see_force(link.force);
    if (tell) tell(i + 1);
  }
  return surveyor.finish();
}

}  // namespace chute::view
