#include "app/input.hpp"

#include <fmt/format.h>

#include <iostream>
#include <iterator>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/toml_reader.hpp"

namespace chute::app {

Input read_input(const std::string& file) {
  if (file != standard_input) return {file, read_file(file)};
  return {standard_input_name, std::string(std::istreambuf_iterator<char>(std::cin), {})};
}

void refuse_recipe(const Input& input) {
  const auto table = parse_toml(input.text, input.name);
  if (table.contains("plot") || table.contains("data"))
    throw InputError(
        fmt::format("{}: the recipe of a figure, not a scene: chute figure {}", input.name, input.name));
}

}  // namespace chute::app
