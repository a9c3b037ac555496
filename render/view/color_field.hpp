#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "read/grain_frame.hpp"

namespace chute::view {

/// What grains are coloured by: one number per grain, taken from a point array.
struct ColorField {
  enum class Part { scalar, magnitude, component };
  std::string array;  ///< empty: nothing, a plain colour
  Part part = Part::scalar;
  int component = 0;
  bool kinds = false;  ///< its values stand for kinds, such as materials and species, which have no order
  std::vector<std::string> words =
      {};  ///< of a field of words: those that have a colour. Its values count these

  double sign =
      1;  ///< -1: spins of chute's own files in the plane, whose tables count rolling downhill as positive
  bool forces = false;  ///< not grains are coloured but chains, by their forces

  bool is_none() const { return array.empty(); }
  /// Colours mean something.
  bool has_bar() const { return forces || !is_none(); }
  /// One value per grain; not a number for a word that is not among `words`. InputError naming the file if it lacks the array.
  std::vector<double> values(const read::GrainFrame& frame) const;
  /// What the colour bar says, in the plots' TeX: symbol and unit.
  std::string title(const std::string& units) const;
  /// The field is known to take both signs.
  bool is_signed() const;
};

/// The array that `text` names, without the component: of `velocity:x`, velocity.
std::string color_array(std::string_view text);

/// Resolves `velocity`, `velocity:x`, `force:magnitude`, `none`, or nothing (the speed, if there is one, and where time passes; else species, if there are several)
/// against the arrays of a frame. InputError naming the arrays there are, and the nearest, if there is none
/// of that name.
ColorField find_field(std::string_view text, const read::GrainFrame& frame);

/// A name from a file as running text of the plots' TeX.
std::string escaped(std::string_view name);

}  // namespace chute::view
