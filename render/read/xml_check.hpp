#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chute::read {

/// What is wrong with the elements of a VTK XML file, empty if nothing is. VTK's own reader takes some things
/// on trust (the types of arrays, how many values there are) and crashes or fills the memory where they are
/// damaged; it also reads a file whose end is missing.
std::string xml_fault(std::string_view text);

/// Up to the end of the element VTKFile: programs pad files with blanks, zero bytes or lines of their own. Whole if there
/// is no such end.
std::string_view without_tail(std::string_view text);

struct XmlHead {
  bool is_vtk = false;  ///< the outermost element is VTKFile
  std::string type;     ///< its attribute, "PolyData"
};
/// What an XML file says first, however it is written: comments, blanks, single quotes and other attributes.
XmlHead xml_head(std::string_view text);

/// The files that an index of parts names (.pvtp, .pvtu, .vtm, .vtpd, .vtpc); nothing if the text is no such index.
std::optional<std::vector<std::string>> part_sources(std::string_view text);

/// All files that an index of whatever kind names, in its order; none of a text that holds its data itself.
std::vector<std::string> named_files(std::string_view text);

}  // namespace chute::read
