#include "app/input.hpp"

#include <iostream>
#include <iterator>

#include "common/atomic_file.hpp"

namespace chute::app {

Input read_input(const std::string& file) {
  if (file != standard_input) return {file, read_file(file)};
  return {standard_input_name, std::string(std::istreambuf_iterator<char>(std::cin), {})};
}

}  // namespace chute::app
