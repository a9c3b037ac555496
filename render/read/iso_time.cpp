#include "read/iso_time.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "read/number.hpp"

namespace chute::read {
namespace {

/// Takes `digits` digits from the front; nothing if there are fewer.
std::optional<int> take_digits(std::string_view& text, std::size_t digits) {
  if (text.size() < digits) return {};
  int value = 0;
  for (std::size_t i = 0; i < digits; ++i) {
    if (text[i] < '0' || text[i] > '9') return {};
    value = 10 * value + (text[i] - '0');
  }
  text.remove_prefix(digits);
  return value;
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

constexpr double day = 86'400, hour = 3600, minute = 60;

/// `HH:MM` or `HHMM`, as seconds.
std::optional<double> take_hours(std::string_view& text) {
  const auto hours = take_digits(text, 2);
  take(text, ':');
  const auto minutes = hours ? take_digits(text, 2) : std::nullopt;
  if (!minutes || *hours > 24 || *minutes > 59) return {};
  return hour * *hours + minute * *minutes;
}

/// What `Z`, `+01:00`, `-0330` or `+02` at the end of a time add to universal time, in seconds; 0 of nothing.
std::optional<double> offset_in(std::string_view text) {
  if (text.empty() || text == "Z" || text == "z") return 0;
  const bool ahead = take(text, '+');
  if (!ahead && !take(text, '-')) return {};
  std::optional<double> offset;
  if (text.size() == 2) {
    const auto hours = take_digits(text, 2);
    if (hours) offset = hour * *hours;
  } else {
    offset = take_hours(text);
  }
  if (!offset || !text.empty() || *offset >= day) return {};
  return ahead ? *offset : -*offset;
}

/// The time of day with what follows it, as seconds in universal time.
std::optional<double> take_time(std::string_view text) {
  const auto minutes = take_hours(text);
  if (!minutes) return {};
  double seconds = 0;
  if (take(text, ':')) {
    const auto end = text.find_first_not_of("0123456789.,");
    std::string part(text.substr(0, end));
    if (const auto comma = part.find(','); comma != std::string::npos) part[comma] = '.';
    const auto value = part.size() >= 2 && part.find('.') != 0 ? number_in(part) : std::nullopt;
    if (!value || *value >= minute + 1) return {};
    seconds = *value;
    text.remove_prefix(part.size());
  }
  const auto offset = offset_in(text);
  if (!offset) return {};
  const double universal = *minutes - *offset;
  // Leap seconds are at the end of a day of universal time; clocks of computers, which have none, show the next day's begin.
  const bool is_last_minute = std::fmod(universal + day, day) == day - minute;
  if (seconds >= minute ? !is_last_minute : *minutes + seconds > day) return {};
  return universal + seconds;
}

}  // namespace

std::optional<double> iso_time(std::string_view text) {
  text = trimmed(text);
  const auto year = take_digits(text, 4);
  const auto month = year && take(text, '-') ? take_digits(text, 2) : std::nullopt;
  const auto day = month && take(text, '-') ? take_digits(text, 2) : std::nullopt;
  if (!day) return {};
  using namespace std::chrono;
  const year_month_day date{std::chrono::year{*year}, std::chrono::month{static_cast<unsigned>(*month)},
                            std::chrono::day{static_cast<unsigned>(*day)}};
  if (!date.ok()) return {};
  const auto days = static_cast<double>(sys_days{date}.time_since_epoch().count());
  if (text.empty()) return 86400 * days;
  if (!take(text, 'T') && !take(text, 't') && !take(text, ' ')) return {};
  const auto seconds = take_time(text);
  return seconds ? std::optional(86400 * days + *seconds) : std::nullopt;
}

std::string iso_text(double seconds) {
  // of the years 0 to 9999, which four digits tell
  constexpr double microseconds = 1e6, first_day = -719'528, end_day = 2'932'897;
  double days = std::floor(seconds / day);
  if (!(days >= first_day && days < end_day)) return "";
  auto rest = std::llround((seconds - days * day) * microseconds);
  if (rest == std::llround(day * microseconds)) rest = 0, days += 1;
  if (days == end_day) return "";
  using namespace std::chrono;
  const year_month_day date{sys_days{std::chrono::days{static_cast<int>(days)}}};
  auto text = fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()),
                          static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  if (rest == 0) return text;
  const auto clock = rest / 1'000'000, part = rest % 1'000'000;
  text += fmt::format("T{:02}:{:02}:{:02}", clock / 3600, clock / 60 % 60, clock % 60);
  if (part == 0) return text;
  text += fmt::format(".{:06}", part);
  return text.erase(text.find_last_not_of('0') + 1);
}

}  // namespace chute::read
