#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "golden.hpp"

namespace chute::golden {

/// A golden that did not come out, and where its pictures were left.
struct Failure {
  std::string name, what;
  std::filesystem::path folder;  ///< expected.png (if there is one), actual.png, difference.png
};

/// Compares pictures with those of a folder. Nothing is ever written there.
class Harness {
 public:
  /// `goldens` holds NAME.png and manifest.json; `report` is made when something fails.
  Harness(std::filesystem::path goldens, std::filesystem::path report);

  /// Draws and compares; true if it is as expected. A golden that is missing, blank, or not the recorded file
  /// fails. What fails leaves expected, actual and difference in the report's folder, and a page, index.html,
  /// that shows them.
  bool check(const Golden& golden);

  const std::vector<Failure>& failures() const { return failures_; }

 private:
  std::filesystem::path goldens_, report_;
  std::vector<Failure> failures_;

  void fail(const Golden& golden, const std::string& what, const image::Image* expected,
            const image::Image& actual);
  void write_page() const;
};

/// Draws goldens anew and records them. InputError if the reason is empty or a name is not one of `known`,
/// before anything is written. Returns one line per golden: what changed.
std::vector<std::string> update(const std::filesystem::path& goldens, const std::vector<Golden>& known,
                                const std::vector<std::string>& names, const std::string& reason);

}  // namespace chute::golden
