#pragma once
#include <functional>
#include <string>
#include <vector>

#include "image/compare.hpp"
#include "image/image.hpp"

namespace chute::golden {

/// A small change of what is drawn that the golden must notice.
struct Mutant {
  std::string what;  ///< "error bars 10 % longer"
  std::function<image::Image()> draw;
};

/// An expected picture: golden/NAME.png, and the code that draws it from golden/data.
struct Golden {
  std::string name;
  std::string made_by;  ///< what draws it, from what: goes to the manifest
  std::function<image::Image()> draw;
  image::Tolerance tolerance = image::strict;
  std::vector<Mutant> mutants = {};
};

/// All of them. To add some: a function such as plot_goldens in a file of its own, and one line in
/// goldens.cpp.
std::vector<Golden> all_goldens();

std::vector<Golden> plot_goldens();
std::vector<Golden> frame_goldens();

/// What a referee finds wrong with the plots among them, but for parameters, which samples have none of: a line each.
std::vector<std::string> referee_on_plots();

}  // namespace chute::golden
