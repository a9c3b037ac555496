#pragma once
#include <fmt/format.h>

#include <string_view>
#include <utility>

/// What the program says. Results go to standard output, and not being able to write them is a failure; what is said
/// beside the work goes to standard error, and a good run does not fail because nobody can read it.
namespace chute::app {

/// Says `text` on standard error, if that can be.
void say(std::string_view text) noexcept;

template <class... Arguments>
void tell(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
  say(fmt::format(text, std::forward<Arguments>(arguments)...));
}

/// If a standard stream was closed, the next file that is opened would take its place, and get what is said there: its
/// number is taken before anything else is opened.
void keep_standard_streams();

/// Results are out: WorkError if standard output took them not (a full disk, a closed stream). Ends as other programs do
/// when the reader has gone (`chute info … | head`).
void finish_output();

}  // namespace chute::app
