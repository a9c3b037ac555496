#pragma once
#include <string>
#include <utility>
#include <vector>

namespace chute::app {

/// The numbers in `text`, divided by `separator`; empty places are NaN. InputError that says what `option`
/// expects.
std::vector<double> numbers(const std::string& option, const std::string& text, char separator,
                            const char* expected);

/// InputError that says what `option` expects, unless it holds.
void require(bool holds, const std::string& option, const std::string& text, const char* expected);

/// Which of the words an option names. InputError with the nearest one and all of them.
std::size_t choice(const std::string& option, const std::string& word, const std::vector<std::string>& words);

/// Checks of options: empty where `text` is a finite number above 0, or not below 0; else what it must be.
std::string positive(const std::string& text);
std::string not_negative(const std::string& text);

bool all_given(const std::vector<double>& values);

/// Width and height of `--size WIDTHxHEIGHT`, whole numbers; what is too small or too large is found by whoever draws.
/// `dpi` > 0: may be in mm, too.
std::pair<int, int> read_size(const std::string& text, double dpi = 0);

}  // namespace chute::app
