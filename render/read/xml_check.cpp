#include "read/xml_check.hpp"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <memory>

namespace chute::read {
namespace {

constexpr std::string_view types[] = {"Int8",  "UInt8",  "Int16",   "UInt16",  "Int32",  "UInt32",
                                      "Int64", "UInt64", "Float32", "Float64", "String", "Bit"};
// zlib packs at most about a thousand bytes into one
constexpr std::uint64_t densest = 1100;

struct Check {
  std::uint64_t most = 0;  ///< more values than this the file cannot hold
  std::string fault;
};

void on_element(void* user, const XML_Char* name, const XML_Char** attributes) {
  auto& check = *static_cast<Check*>(user);
  if (!check.fault.empty()) return;
  const std::string_view element = name;
  const bool is_array = element == "DataArray" || element == "Array";
  bool has_type = false;
  for (; *attributes; attributes += 2) {
    const std::string_view key = attributes[0], value = attributes[1];
    if (is_array && key == "type") {
      has_type = true;
      if (std::find(std::begin(types), std::end(types), value) == std::end(types))
        check.fault = fmt::format("an array of unknown type \"{}\"", value);
    } else if (key.starts_with("NumberOf")) {
      std::uint64_t count = 0;
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), count);
      if (error != std::errc() || count > check.most) check.fault = fmt::format("{} is \"{}\"", key, value);
    }
  }
  if (is_array && !has_type) check.fault = "an array without a type";
}

}  // namespace

std::string xml_fault(std::string_view text) {
  // the appended part may be raw bytes, which are no XML
  const auto appended = text.find("<AppendedData");
  const bool whole = appended == std::string_view::npos;
  const auto head = text.substr(0, appended);
  Check check{densest * text.size(), {}};
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr),
                                                                            XML_ParserFree);
  XML_SetUserData(parser.get(), &check);
  XML_SetStartElementHandler(parser.get(), on_element);
  if (XML_Parse(parser.get(), head.data(), static_cast<int>(head.size()), whole) != XML_STATUS_OK)
    return fmt::format("line {}: {}", XML_GetCurrentLineNumber(parser.get()),
                       XML_ErrorString(XML_GetErrorCode(parser.get())));
  if (!check.fault.empty()) return check.fault;
  const auto tail = text.substr(text.size() - std::min<std::size_t>(text.size(), 256));
  return tail.find("</VTKFile") == std::string_view::npos ? "its end is missing" : "";
}

}  // namespace chute::read
