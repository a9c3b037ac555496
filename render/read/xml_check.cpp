#include "read/xml_check.hpp"

#include <expat.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <memory>

#include "read/number.hpp"

namespace chute::read {
namespace {

constexpr std::string_view types[] = {"Int8",  "UInt8",  "Int16",   "UInt16",  "Int32",  "UInt32",
                                      "Int64", "UInt64", "Float32", "Float64", "String", "Bit"};
constexpr std::string_view end_tag = "</VTKFile";
// zlib packs at most about a thousand bytes into one
constexpr std::uint64_t densest = 1100;

// of elements inside each other: VTK goes down one call each
constexpr int deepest = 64;

/// The first characters of base64 text as bytes, at most `most` of them.
std::string from_base64(std::string_view text, std::size_t most) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    const auto value = digits.find(c);
    if (value == std::string_view::npos) {
      if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
      break;
    }
    bits = bits << 6U | static_cast<unsigned>(value), count += 6;
    if (count >= 8) count -= 8, bytes += static_cast<char>(bits >> count & 255U);
    if (bytes.size() == most) break;
  }
  return bytes;
}

/// What stands before the values of a binary array: their bytes or, of packed ones, blocks and their sizes. VTK's reader trusts
/// it with memory, and divides by it.
class XmlCheck {
 public:
  explicit XmlCheck(std::string_view text) : text_(text) {
    // the appended part may be raw bytes, which are no XML
    const auto appended = text.find("<AppendedData");
    whole_ = appended == std::string_view::npos;
    head_ = text.substr(0, appended);
    if (whole_) return;
    const auto tag_end = text.find('>', appended), mark = text.find('_', tag_end);
    const auto tag = text.substr(appended, tag_end == std::string_view::npos ? 0 : tag_end - appended);
    appended_is_raw_ = tag.find("base64") == std::string_view::npos;
    if (tag_end != std::string_view::npos && mark != std::string_view::npos) data_ = text.substr(mark + 1);
  }

  std::string fault() {
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr),
                                                                              XML_ParserFree);
    XML_SetUserData(parser.get(), this);
    XML_SetElementHandler(
        parser.get(),
        [](void* user, const XML_Char* name, const XML_Char** attributes) {
          static_cast<XmlCheck*>(user)->begin(name, attributes);
        },
        [](void* user, const XML_Char*) { static_cast<XmlCheck*>(user)->end(); });
    XML_SetCharacterDataHandler(parser.get(), [](void* user, const XML_Char* text, int length) {
      static_cast<XmlCheck*>(user)->take({text, static_cast<std::size_t>(length)});
    });
    // in parts, so that what is wrong early ends the work early
    constexpr std::size_t part = 1U << 20U;
    for (std::size_t at = 0; at == 0 || at < head_.size(); at += part) {
      const auto some = head_.substr(at, part);
      const bool last = at + part >= head_.size() && whole_;
      if (XML_Parse(parser.get(), some.data(), static_cast<int>(some.size()), last) != XML_STATUS_OK)
        return fmt::format("line {}: {}", XML_GetCurrentLineNumber(parser.get()),
                           XML_ErrorString(XML_GetErrorCode(parser.get())));
      if (!fault_.empty()) return fault_;
    }
    return fault_;
  }

 private:
  std::string_view text_, head_, data_;
  bool whole_ = true, appended_is_raw_ = true, packed_ = false, big_endian_ = false;
  std::size_t word_ = 4;             ///< bytes of a number in such a header
  int depth_ = 0, array_depth_ = 0;  ///< 0: in no array
  std::string fault_;
  std::map<std::string, std::uint64_t, std::less<>> counts_;  ///< of the piece that is being read
  std::string parent_;                                        ///< of the arrays that are being read
  bool inline_ = false;
  std::string name_, encoded_;

  void begin(std::string_view element, const XML_Char** attributes) {
    if (!fault_.empty()) return;
    if (++depth_ > deepest) {
      fault_ = fmt::format("elements more than {} levels deep", deepest);
      return;
    }
    if (array_depth_ > 0) return;  // what VTK knows of an array stands inside it
    const bool array = is_array(element);
    if (element == "Piece") counts_.clear();
    if (!array) parent_ = element;
    std::string_view type, format, offset;
    std::uint64_t tuples = 0;
    name_.clear();
    for (; *attributes; attributes += 2) {
      const std::string_view key = attributes[0], value = attributes[1];
      if (key == "type") type = value;
      if (key == "format") format = value;
      if (key == "offset") offset = trimmed(value);
      if (key == "Name") name_ = value;
      if (key == "compressor") packed_ = !value.empty();
      if (key == "byte_order") big_endian_ = value == "BigEndian";
      if (key == "header_type") word_ = value == "UInt64" ? 8 : 4;
      if (!key.starts_with("NumberOf")) continue;
      const auto count = whole_number(value);
      if (!count || *count > densest * text_.size())
        fault_ = fmt::format("{} is \"{}\"", key, value);
      else
        (array ? tuples : counts_[std::string(key)]) = *count;
    }
    if (!array) return;
    array_depth_ = depth_;
    if (type.empty())
      fault_ = "an array without a type";
    else if (std::find(std::begin(types), std::end(types), type) == std::end(types))
      fault_ = fmt::format("an array of unknown type \"{}\"", type);
    inline_ = format == "binary";
    encoded_.clear();
    if (format != "appended" || !fault_.empty()) return;
    const auto at = whole_number(offset);
    if (data_.empty())
      fault_ = fmt::format("array \"{}\" is appended, but nothing is", name_);
    else if (!at || *at >= data_.size())
      fault_ = fmt::format("array \"{}\": nothing is at its offset \"{}\"", name_, offset);
    else
      check_header(data_.substr(*at), appended_is_raw_, tuples);
  }

  void take(std::string_view text) {
    constexpr std::size_t enough = 4096;  // for a header
    if (inline_ && depth_ == array_depth_ && encoded_.size() < enough)
      encoded_ += trimmed(text.substr(0, enough));
  }

  void end() {
    if (depth_-- != array_depth_) return;
    if (inline_ && fault_.empty() && !encoded_.empty()) check_header(encoded_, false, 0);
    inline_ = false;
    array_depth_ = 0;
  }

  static bool is_array(std::string_view element) { return element == "DataArray" || element == "Array"; }

  static std::optional<std::uint64_t> whole_number(std::string_view text) {
    const auto digits = trimmed(text);  // Fortran pads numbers
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) return {};
    return value;
  }

  /// Whether there is something to read into the array, as far as the file says.
  bool expects_values(std::uint64_t tuples) const {
    const auto count = [&](std::string_view of) {
      const auto found = counts_.find(of);
      return found == counts_.end() ? 0 : found->second;
    };
    if (parent_ == "FieldData") return tuples > 0;
    if (parent_ == "Points" || parent_ == "PointData") return count("NumberOfPoints") > 0;
    if (parent_ == "Cells") return count("NumberOfCells") > 0;
    if (parent_ == "CellData")
      return std::any_of(counts_.begin(), counts_.end(),
                         [](const auto& c) { return c.first != "NumberOfPoints" && c.second > 0; });
    return count("NumberOf" + parent_) > 0;
  }

  void check_header(std::string_view from, bool raw, std::uint64_t tuples) {
    const std::size_t words = packed_ ? 3 : 1;
    const auto bytes = raw ? std::string(from.substr(0, words * word_)) : from_base64(from, words * word_);
    const auto wrong = [&](const std::string& what) {
      fault_ = fmt::format("array \"{}\": {}", name_, what);
    };
    if (bytes.size() < words * word_) return wrong("its values are cut short");
    std::uint64_t number[3] = {};
    for (std::size_t w = 0; w < words; ++w)
      for (std::size_t i = 0; i < word_; ++i)
        number[w] = number[w] << 8U |
                    static_cast<unsigned char>(bytes[w * word_ + (big_endian_ ? i : word_ - 1 - i)]);
    if (!packed_) {
      if (number[0] > text_.size()) wrong(fmt::format("{} bytes, more than the file has", number[0]));
      return;
    }
    const auto [blocks, size, last] = number;
    if (blocks == 0) {
      if (expects_values(tuples)) wrong("packed into no block");
      return;
    }
    if (size == 0 || last > size)
      return wrong(fmt::format("{} packed blocks of {} bytes, the last of {}", blocks, size, last));
    const std::uint64_t most = densest * text_.size();
    if (blocks > text_.size() || size > most || blocks > most / size + 1)
      wrong(fmt::format("{} packed blocks of {} bytes, more than the file can hold", blocks, size));
  }
};

}  // namespace

std::string xml_fault(std::string_view text) {
  if (auto fault = XmlCheck(text).fault(); !fault.empty()) return fault;
  return text.ends_with('>') && text.rfind(end_tag) != std::string_view::npos ? "" : "its end is missing";
}

std::string_view without_tail(std::string_view text) {
  const auto end = text.rfind(end_tag);
  const auto close = end == std::string_view::npos ? end : text.find('>', end);
  return close == std::string_view::npos ? text : text.substr(0, close + 1);
}

XmlHead xml_head(std::string_view text) {
  XmlHead head;
  if (constexpr std::string_view mark = "\xEF\xBB\xBF"; text.starts_with(mark))
    text.remove_prefix(mark.size());
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (!text.starts_with('<')) return head;
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr),
                                                                            XML_ParserFree);
  struct Root {
    XML_Parser parser;
    XmlHead* head;
  } root{parser.get(), &head};
  XML_SetUserData(parser.get(), &root);
  XML_SetStartElementHandler(parser.get(), [](void* user, const XML_Char* name, const XML_Char** attributes) {
    const auto& [of, into] = *static_cast<Root*>(user);
    into->is_vtk = std::string_view(name) == "VTKFile";
    for (; *attributes; attributes += 2)
      if (std::string_view(attributes[0]) == "type") into->type = trimmed(attributes[1]);
    XML_StopParser(of, XML_FALSE);
  });
  constexpr std::size_t part = 4096;  // the parser keeps a copy of what it gets, and the head is short
  for (std::size_t at = 0; at < text.size(); at += part) {
    const auto some = text.substr(at, part);
    if (XML_Parse(parser.get(), some.data(), static_cast<int>(some.size()), 0) != XML_STATUS_OK) break;
  }
  return head;
}

namespace {

/// Values of the attribute `key` of all these elements.
std::vector<std::string> attributes_in(std::string_view text, std::string_view element,
                                       std::string_view key) {
  struct Wanted {
    std::string_view element, key;
    std::vector<std::string> values;
  } wanted{element, key, {}};
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr),
                                                                            XML_ParserFree);
  XML_SetUserData(parser.get(), &wanted);
  XML_SetStartElementHandler(parser.get(), [](void* user, const XML_Char* name, const XML_Char** attributes) {
    auto& of = *static_cast<Wanted*>(user);
    if (of.element != name) return;
    for (; *attributes; attributes += 2)
      if (of.key == attributes[0]) of.values.emplace_back(attributes[1]);
  });
  const auto whole = without_tail(text);
  XML_Parse(parser.get(), whole.data(), static_cast<int>(std::min<std::size_t>(whole.size(), 1U << 30U)), 1);
  return std::move(wanted.values);
}

}  // namespace

std::optional<std::vector<std::string>> part_sources(std::string_view text) {
  const auto [is_xml, type] = xml_head(text);
  const bool parallel = type == "PPolyData" || type == "PUnstructuredGrid";
  const bool blocks = type == "vtkMultiBlockDataSet" || type == "vtkPartitionedDataSet" ||
                      type == "vtkPartitionedDataSetCollection";
  if (!is_xml || (!parallel && !blocks)) return {};
  return parallel ? attributes_in(text, "Piece", "Source") : attributes_in(text, "DataSet", "file");
}

std::vector<std::string> named_files(std::string_view text) {
  const auto [is_xml, type] = xml_head(text);
  if (!is_xml) return {};
  if (type.starts_with('P') && type != "PolyData") return attributes_in(text, "Piece", "Source");
  return type.starts_with("vtk") ? attributes_in(text, "DataSet", "file") : std::vector<std::string>();
}

}  // namespace chute::read
