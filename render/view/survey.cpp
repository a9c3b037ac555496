#include "view/survey.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/contacts.hpp"
#include "read/grain_frame.hpp"

namespace chute::view {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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

double beyond_domain(const std::array<double, 6>& domain, double x) {
  return std::max(domain[0] - x, x - domain[1]) / (copy_reach * (domain[1] - domain[0]));
}

Surveyor::Surveyor(const FrameStyle& style) : style_(style) {
  style_.check();
  found_.bounds = {infinity, -infinity, infinity, -infinity, infinity, -infinity};
  found_.turned = {infinity, -infinity, infinity, -infinity};
}

void Surveyor::see(const read::GrainFrame& frame, std::optional<double> time) {
  auto& s = found_;
  if (first_) {
    first_ = false;
    s.dimensions = frame.dimensions;
    s.units = frame.units, s.domain = frame.domain, s.gravity = frame.gravity;
    s.field = find_field(style_.color, frame);
    s.has_times = true;
    const auto& g = s.gravity;
    s.up_axis = s.dimensions == 2 || std::abs(g[1]) > std::abs(g[2]) ? 1 : 2;
    const double down = -g[static_cast<std::size_t>(s.up_axis)];
    if (down > 0) s.slope = std::atan2(g[0], down);
  }
  s.dimensions = std::max(s.dimensions, frame.dimensions);
  s.has_times = s.has_times && (time || frame.time);
  s.times.push_back(time ? *time : frame.time.value_or(static_cast<double>(s.times.size())));

  const double turn = style_.tilt ? s.slope : 0, cosine = std::cos(turn), sine = std::sin(turn);
  const double period = style_.copies ? s.domain[1] - s.domain[0] : 0;
  const auto shifts = period > 0 ? std::vector<double>{0, -period, period} : std::vector<double>{0};
  const auto values = s.field.values(frame);
  const auto* velocity = frame.find(fields::velocity.name);
  bool any_moving = false, any_fixed = false;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const double r = frame.radius[i], position[3] = {frame.x[i], frame.y[i], frame.z[i]};
    for (std::size_t c = 0; c < 3; ++c) {
      s.bounds[2 * c] = std::min(s.bounds[2 * c], position[c] - r);
      s.bounds[2 * c + 1] = std::max(s.bounds[2 * c + 1], position[c] + r);
    }
    const double u = cosine * frame.x[i] + sine * frame.y[i], v = cosine * frame.y[i] - sine * frame.x[i];
    for (const double shift : shifts) {
      if (shift != 0 && beyond_domain(s.domain, frame.x[i] + shift) >= 1) continue;
      const double a = u + cosine * shift, b = v - sine * shift;
      s.turned = {std::min(s.turned[0], a - r), std::max(s.turned[1], a + r), std::min(s.turned[2], b - r),
                  std::max(s.turned[3], b + r)};
    }
    const bool fixed = frame.is_fixed(i);
    (fixed ? any_fixed : any_moving) = true;
    ++all_, all_diameters_ += 2 * r;
    if (fixed) continue;
    ++moving_, diameters_ += 2 * r;
    values_.add(values[i]);
    if (velocity && velocity->components == 3)
      speeds_.add(std::hypot(velocity->at(i, 0), velocity->at(i, 1), velocity->at(i, 2)));
  }
  s.has_fixed = s.has_fixed || (any_fixed && any_moving);
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
    const bool from_zero = s.field.part == Field::Part::magnitude || (s.low >= 0 && s.low < 0.4 * s.high);
    if (from_zero) s.low = 0, s.high = round_up(s.high);
    if (!(s.high > s.low))
      s.high = s.low != 0 ? s.low + std::abs(s.low) / 2 : 1, s.low -= s.low != 0 ? std::abs(s.low) / 2 : 0;
  }
  const double slack = 1e-9 * (s.high - s.low);
  s.exceeds_low = values_.seen && values_.lowest < s.low - slack;
  s.exceeds_high = values_.seen && values_.highest > s.high + slack;
}

Survey Surveyor::finish() {
  if (first_) throw InputError("no frames to draw");
  auto& s = found_;
  if (s.dimensions == 3 && s.up_axis == 1 && std::abs(s.gravity[1]) <= std::abs(s.gravity[2])) s.up_axis = 2;
  choose_range();
  s.diameter =
      moving_ ? diameters_ / static_cast<double>(moving_) : all_diameters_ / static_cast<double>(all_);
  s.speed = speeds_.quantile(0.99);
  s.force = forces_.quantile(0.99);
  s.time_decimals = s.times.size() > 1 ? decimals_for(s.times, 4) : decimals_for(s.times, 2);
  return s;
}

std::string Survey::describe() const {
  return fmt::format(
      "{} {} {} bounds={} turned={} domain={} gravity={} units={} field={}:{}:{} range={}:{} {:d}{:d}{:d} "
      "diameter={} speed={} force={} fixed={:d} decimals={} times={:d}",
      dimensions, up_axis, slope, fmt::join(bounds, ","), fmt::join(turned, ","), fmt::join(domain, ","),
      fmt::join(gravity, ","), units, field.array, static_cast<int>(field.part), field.component, low, high,
      diverging, exceeds_low, exceeds_high, diameter, speed, force, has_fixed, time_decimals, has_times);
}

Survey survey(const std::vector<read::FrameFile>& frames, const FrameStyle& style,
              std::optional<double> radius, const std::function<void(std::size_t)>& tell) {
  Surveyor surveyor(style);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    surveyor.see(read::read_frame(frames[i].path, radius), frames[i].time);
    if (style.chains && !frames[i].contacts.empty())
      for (const auto& contact : read::read_contacts(frames[i].contacts)) surveyor.see_force(contact.force);
    if (tell) tell(i + 1);
  }
  return surveyor.finish();
}

}  // namespace chute::view
