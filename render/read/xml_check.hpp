#pragma once
#include <string>
#include <string_view>

namespace chute::read {

/// What is wrong with the elements of a VTK XML file, empty if nothing is. VTK's own reader takes some things
/// on trust (the types of arrays, how many values there are) and crashes or fills the memory where they are
/// damaged; it also reads a file whose end is missing.
std::string xml_fault(std::string_view text);

}  // namespace chute::read
