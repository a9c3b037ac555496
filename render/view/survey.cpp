#include "view/survey.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <numbers>

#include "common/error.hpp"
#include "common/fields.hpp"
#include "plot/style.hpp"
#include "read/grain_frame.hpp"
#include "read/network.hpp"

namespace chute::view {
namespace {

/// More different values than this are numbers to be ordered, not kinds to be told apart by colour.
constexpr std::size_t most_kinds = plot::color_count;

/// Rounds away from zero to a plain number, a tenth larger on average: the ends of a colour bar should be
/// readable.
double round_up(double x) {
  if (x == 0 || !std::isfinite(x)) return x;
  const double power = std::pow(10, std::floor(std::log10(std::abs(x)))), leading = std::abs(x) / power;
  const double step = leading <= 2 ? 0.2 : leading <= 5 ? 0.5 : 1;
  return std::copysign(std::ceil(leading / step - 1e-9) * step * power, x);
}

/// Decimals that tell all these numbers apart as they are, at most `most`.
int decimals_for(const std::vector<double>& values, int most) {
  for (int decimals = 0; decimals < most; ++decimals) {
    const double unit = std::pow(10.0, -decimals);
    const bool enough = std::all_of(values.begin(), values.end(), [&](double v) {
      return std::abs(v - unit * std::round(v / unit)) <= 1e-6 * unit + 1e-12 * std::abs(v);
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

double beyond_domain(const Eigen::AlignedBox3d& domain, double x) {
  const double from = domain.min().x(), to = domain.max().x();
  return std::max(from - x, x - to) / (copy_reach * (to - from));
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
    s.field = find_field(style_.color, frame);
    const auto& g = s.gravity;
    s.up_axis = s.dimensions == 2 || std::abs(g[1]) > std::abs(g[2]) ? 1 : 2;
    const double down = -g[static_cast<std::size_t>(s.up_axis)];
    if (down > 0) s.slope = std::atan2(g[0], down);
  }
  // a plane that moves from frame to frame is a layer in space
  s.dimensions = std::max(s.dimensions, frame.z.front() == plane_ ? frame.dimensions : 3);

  const Eigen::Rotation2Dd turn(style_.tilt ? -s.slope : 0);
  const double period = style_.copies ? s.domain.sizes().x() : 0;
  const auto shifts = period > 0 ? std::vector<double>{0, -period, period} : std::vector<double>{0};
  const auto values = s.field.values(frame);
  const auto* velocity = frame.find(fields::velocity.name);
  bool any_moving = false, any_fixed = false;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const double r = frame.radius[i];
    const Eigen::Vector3d centre = frame.centre(i);
    s.bounds.extend((centre.array() - r).matrix()).extend((centre.array() + r).matrix());
    for (const double shift : shifts) {
      if (shift != 0 && beyond_domain(s.domain, centre.x() + shift) >= 1) continue;
      const Eigen::Vector2d seen = turn * Eigen::Vector2d(centre.x() + shift, centre.y());
      s.turned.extend((seen.array() - r).matrix()).extend((seen.array() + r).matrix());
    }
    const bool fixed = frame.is_fixed(i);
    const Eigen::Vector2d shown = turn * Eigen::Vector2d(centre.x(), centre.y());
    const Eigen::Vector3d place(shown.x(), shown.y(), centre.z());
    if (fixed) resting_.extend((place.array() - r).matrix()).extend((place.array() + r).matrix());
    for (std::size_t c = 0; c < 3 && !fixed; ++c) {
      low_ends_[c].add(place[static_cast<Eigen::Index>(c)] - r);
      high_ends_[c].add(place[static_cast<Eigen::Index>(c)] + r);
    }
    (fixed ? any_fixed : any_moving) = true;
    ++all_, all_diameters_ += 2 * r;
    if (fixed) continue;
    ++moving_, diameters_ += 2 * r;
    values_.add(values[i]);
    if (s.field.names_kinds() && kinds_.size() <= most_kinds) kinds_.insert(std::llround(values[i]));
    if (velocity && velocity->components == 3)
      speeds_.add(std::hypot(velocity->at(i, 0), velocity->at(i, 1), velocity->at(i, 2)));
  }
  s.has_fixed = s.has_fixed || (any_fixed && any_moving);
  if (style_.camera.follow) path_.see(frame, style_.camera.follow->id, s.times.back());
}

void Surveyor::choose_range() {
  auto& s = found_;
  if (style_.range) {
    std::tie(s.low, s.high) = *style_.range;
    s.diverging = style_.map.empty() ? s.low < 0 && s.high > 0 && s.low == -s.high : false;
  } else if (values_.values.empty() || s.field.is_none()) {
    s.low = 0, s.high = 1;
  } else if (s.field.is_signed() || (values_.lowest < 0 && values_.highest > 0)) {
    const double end =
        round_up(std::max(std::abs(values_.quantile(0.0025)), std::abs(values_.quantile(0.9975))));
    s.high = end > 0 ? end : 1, s.low = -s.high, s.diverging = true;
  } else {
    s.high = values_.quantile(0.995), s.low = values_.quantile(0.005);
    const bool from_zero =
        s.field.part == ColorField::Part::magnitude || (s.low >= 0 && s.low < 0.4 * s.high);
    if (from_zero) s.low = 0, s.high = round_up(s.high);
    if (!(s.high > s.low))
      s.high = s.low != 0 ? s.low + std::abs(s.low) / 2 : 1, s.low -= s.low != 0 ? std::abs(s.low) / 2 : 0;
  }
  const double slack = 1e-9 * (s.high - s.low);
  s.exceeds_low = values_.seen && values_.lowest < s.low - slack;
  s.exceeds_high = values_.seen && values_.highest > s.high + slack;
}

/// The view of the whole run: along each axis from the half percent of lowest places of moving grains to the half percent of
/// highest, over all frames, with the bed; and farther out to grains that are not far from there, for they cost no size.
void Surveyor::choose_view() {
  auto& s = found_;
  s.seen = s.bounds;
  s.places = low_ends_[0].seen;
  if (style_.camera.all || style_.camera.window || style_.camera.follow || s.places == 0) return;
  constexpr double tail = 0.005;  // of the places, at each end: those of 99 % lie between
  constexpr double near = 0.25;   // of the length in between
  Eigen::AlignedBox3d box;
  const Eigen::Index axes = s.dimensions == 2 ? 2 : 3;
  for (Eigen::Index c = 0; c < axes; ++c) {
    auto lows = low_ends_[static_cast<std::size_t>(c)], highs = high_ends_[static_cast<std::size_t>(c)];
    double low = lows.quantile(tail), high = highs.quantile(1 - tail);
    const double length = high - low;
    const double least = low - near * length, most = high + near * length;
    for (const double v : lows.values)
      if (v >= least) low = std::min(low, v);
    for (const double v : highs.values)
      if (v <= most) high = std::max(high, v);
    if (!resting_.isEmpty()) low = std::min(low, resting_.min()[c]), high = std::max(high, resting_.max()[c]);
    box.min()[c] = low, box.max()[c] = high;
  }
  std::size_t outside = 0;
  for (std::size_t k = 0; k < low_ends_[0].values.size(); ++k) {
    bool out = false;
    for (Eigen::Index c = 0; c < axes; ++c)
      out = out || low_ends_[static_cast<std::size_t>(c)].values[k] < box.min()[c] ||
            high_ends_[static_cast<std::size_t>(c)].values[k] > box.max()[c];
    outside += out;
  }
  s.outside = outside * low_ends_[0].stride;
  if (outside == 0) return;
  if (s.dimensions == 2) {
    // copies beyond the periodic ends stay as they are
    for (const Eigen::Index c : {0, 1}) {
      if (style_.copies && c == 0) continue;
      s.turned.min()[c] = box.min()[c], s.turned.max()[c] = box.max()[c];
    }
  } else {
    for (Eigen::Index c = 0; c < 3; ++c) s.seen.min()[c] = box.min()[c], s.seen.max()[c] = box.max()[c];
  }
}

Survey Surveyor::finish() {
  if (first_) throw InputError(found_.times.empty() ? "no frames to draw" : "no frame has a grain");
  auto& s = found_;
  if (s.dimensions == 3 && s.up_axis == 1 && std::abs(s.gravity[1]) <= std::abs(s.gravity[2])) s.up_axis = 2;
  choose_range();
  choose_view();
  if (!kinds_.empty() && kinds_.size() <= most_kinds) s.categories.assign(kinds_.begin(), kinds_.end());
  if (style_.camera.follow) s.path = path_.smooth();
  s.diameter =
      moving_ ? diameters_ / static_cast<double>(moving_) : all_diameters_ / static_cast<double>(all_);
  s.speed = speeds_.quantile(0.99);
  s.force = forces_.quantile(0.99);
  s.time_decimals = s.times.size() > 1 ? decimals_for(s.times, 4) : decimals_for(s.times, 2);
  return s;
}

std::string Survey::describe() const {
  const auto text = [](const Eigen::VectorXd& v) {
    return fmt::format("{},", fmt::join(v.begin(), v.end(), ","));
  };
  return fmt::format(
      "{} {} {} bounds={} seen={} turned={} domain={} gravity={} units={} field={}:{}:{} range={}:{} {:d}{:d}{:d} "
      "diameter={} speed={} force={} fixed={:d} decimals={} times={:d} categories={}",
      dimensions, up_axis, slope, text(bounds.min()) + text(bounds.max()),
      text(seen.min()) + text(seen.max()), text(turned.min()) + text(turned.max()),
      text(domain.min()) + text(domain.max()), text(gravity), units + clock, field.array,
      static_cast<int>(field.part), field.component, low, high, diverging, exceeds_low, exceeds_high,
      diameter, speed, force, has_fixed, time_decimals, has_times, fmt::join(categories, ","));
}

Survey survey(const std::vector<read::FrameFile>& frames, const FrameStyle& style,
              std::optional<double> radius, int jobs, const std::function<void(std::size_t)>& tell) {
  std::vector<std::string> wanted{color_array(style.color), std::string(fields::velocity.name)};
  if (style.camera.follow) wanted.emplace_back(fields::id.name);
  struct Seen {
    read::GrainFrame frame;
    std::vector<read::ForceLink> links;
  };
  const auto read = [&](std::size_t i) {
    const bool chains = style.chains && !frames[i].contacts.empty();
    return Seen{read::parse_frame(read::read_files(frames[i]), radius, wanted),
                chains ? read::read_network(frames[i].contacts) : std::vector<read::ForceLink>()};
  };
  Surveyor surveyor(style);
  // The first alone: VTK makes its tables then, which is not for threads. Later ones are read ahead.
  std::deque<std::future<Seen>> ahead;
  for (std::size_t i = 0, next = 1; i < frames.size(); ++i) {
    const Seen seen = i == 0 ? read(0) : ahead.front().get();
    if (i > 0) ahead.pop_front();
    for (; next < frames.size() && next <= i + static_cast<std::size_t>(jobs); ++next)
      ahead.push_back(std::async(jobs > 1 ? std::launch::async : std::launch::deferred, read, next));
    surveyor.see(seen.frame, frames[i].time);
    for (const auto& link : seen.links) surveyor.see_force(link.force);
    if (tell) tell(i + 1);
  }
  return surveyor.finish();
}

}  // namespace chute::view
