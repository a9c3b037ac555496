#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "read/meanings.hpp"

namespace chute::app {

/// The options that say what the arrays of a file are where their names do not tell: --radius, --velocity …, for all verbs that read frames.
struct FileMeanings {
  std::string radius, diameter, velocity, spin, orientation, type, id;

  /// This must stay where it is as long as the verb.
  void add_options(CLI::App& verb);
  /// InputError for a radius that is none.
  read::Meanings read() const;
};

}  // namespace chute::app
