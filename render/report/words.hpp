#pragma once
#include <string>
#include <vector>

#include "report/run_files.hpp"

namespace chute::report {

/// The scene as a reader would tell it: what lies where, how it starts, what acts, how it is computed. Plain text, a sentence
/// an entry.
std::vector<std::string> scene_in_words(const RunFiles& run);

/// A key of a complete scene with its value, as TOML writes it.
struct Setting {
  std::string key, value;
};
std::vector<Setting> settings_of(const toml::table& scene);

/// The keys in which the runs differ, each with a value per run; empty text where a run has none of it.
struct Difference {
  std::string key;
  std::vector<std::string> values;
};
std::vector<Difference> differences(std::span<const RunFiles> runs);

/// What a verdict means, as a sentence's end.
std::string meaning_of(const std::string& verdict);

/// A number as people write it: 4 significant digits, powers of ten as 1.2 × 10⁻⁵.
std::string number_text(double value);
/// With its error, if that is known.
std::string mean_text(const Mean& mean);

}  // namespace chute::report
