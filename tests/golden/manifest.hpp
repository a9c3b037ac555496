#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "image/compare.hpp"

namespace chute::golden {

/// What is known about one golden picture.
struct Record {
  std::string made_by;   ///< code and data
  std::string versions;  ///< of the libraries that pixels depend on
  std::string reason;    ///< why it looks as it does now: given with the last update
  std::string sha256;    ///< of the PNG file
  image::Tolerance tolerance;
};

/// golden/manifest.json: name -> record. InputError if the file is not what it should be; a missing file is
/// empty.
std::map<std::string, Record> read_manifest(const std::filesystem::path& path);
void write_manifest(const std::filesystem::path& path, const std::map<std::string, Record>& records);

}  // namespace chute::golden
