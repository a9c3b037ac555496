#include "app/file_meanings.hpp"

#include <charconv>
#include <cmath>

#include "app/numbers.hpp"
#include "common/error.hpp"

namespace chute::app {
namespace {

/// A number is the same for all grains, anything else the name of an array.
void read_size_of_grains(const std::string& option, const std::string& text, double per_radius,
                         read::Meanings& meanings, std::string& array) {
  if (text.empty()) return;
  if (meanings.radius || !meanings.radius_array.empty() || !meanings.diameter_array.empty())
    throw InputError("--radius and --diameter: one of them says how large grains are");
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) {
    array = text;
    return;
  }
  require(value > 0 && std::isfinite(value), option, text, "a number > 0, or the name of an array");
  meanings.radius = value / per_radius;
}

}  // namespace

void FileMeanings::add_options(CLI::App& verb) {
  verb.add_option("--radius", radius, "array of the radii, or one number for all grains");
  verb.add_option("--diameter", diameter, "array of the diameters, or one number for all grains");
  verb.add_option("--velocity", velocity, "array of the velocities, or its components U,V[,W]");
  verb.add_option("--spin", spin, "array of the angular velocities");
  verb.add_option("--orientation", orientation,
                  "array of angles (plane) or quaternions w x y z (space), which the marks show");
  verb.add_option("--type", type, "array of the species");
  verb.add_option("--id", id, "array of the grains' numbers, for trails and --camera follow");
}

read::Meanings FileMeanings::read() const {
  read::Meanings meanings;
  read_size_of_grains("--radius", radius, 1, meanings, meanings.radius_array);
  read_size_of_grains("--diameter", diameter, 2, meanings, meanings.diameter_array);
  meanings.velocity = velocity, meanings.spin = spin, meanings.orientation = orientation;
  meanings.type = type, meanings.id = id;
  return meanings;
}

}  // namespace chute::app
