#pragma once
#include <string>

namespace chute::app {

/// A file that a verb is given, as text.
struct Input {
  std::string name;  ///< for messages, and for what is named after it
  std::string text;
};

/// What stands for standard input on the command line, and its name.
inline constexpr const char* standard_input = "-";
inline constexpr const char* standard_input_name = "standard-input";

/// Reads the file, or standard input to its end for `-`. InputError if it cannot be read.
Input read_input(const std::string& file);

/// InputError if it is the recipe of a figure, and so is for another verb than those that take scenes.
void refuse_recipe(const Input& input);

}  // namespace chute::app
