#pragma once
#include <filesystem>
#include <string>

#include "engines/contact/solver/assemble.hpp"

namespace chute::contact {

/// A problem as files hold it, before it is laid out by contacts.
struct Parts {
  int dimensions = 0;
  std::size_t contacts = 0;
  std::vector<Entry> matrix;        ///< of W
  std::vector<double> q, friction;  ///< dimensions × contacts; contacts
};

/// More contacts than this are refused: their numbers are kept in 32 bits.
inline constexpr std::size_t most_contacts = 100'000'000;

/// `content`, all of the file's text; `name` is for messages.
Parts read_siconos_text(const std::string& content, const std::string& name);
Parts read_fclib(const std::filesystem::path& path);

}  // namespace chute::contact
