#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chute::view {

/// A colour, red green blue in 0 … 1 as on the screen (sRGB).
struct Rgb {
  double r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

/// `t` = 0 gives a, 1 gives b.
Rgb mix(Rgb a, Rgb b, double t);

/// How bright a colour looks, 0 … 1 (luma).
double brightness(Rgb color);

/// A perceptually even map from 0 … 1 to colours, readable for the colour-blind.
class ColorMap {
 public:
  /// InputError with the nearest known name if there is no such map. `NAME_r` is the reversed map.
  explicit ColorMap(std::string_view name);

  /// Values outside 0 … 1 get the colour of that end.
  Rgb at(double t) const;

  /// The same map, all colours mixed with `ground`: 0 leaves them, 1 is all ground.
  ColorMap faded(Rgb ground, double share) const;

  /// Light in the middle, made for values of both signs.
  bool is_diverging() const;

  static std::vector<std::string> names();

  struct Stop {
    int place;  ///< 0 … 255
    Rgb color;
  };

 private:
  std::string_view name_;
  std::span<const Stop> stops_;
  bool reversed_ = false;
  Rgb ground_{};
  double fade_ = 0;
};

}  // namespace chute::view
