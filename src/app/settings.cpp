#include "app/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace chute::app {
namespace {
bool is_setting(std::string_view text) {
  return !text.starts_with('-') && text.find('=') != std::string_view::npos;
}
}  // namespace

void add_settings(CLI::App& verb, const char* option, const char* shape, std::vector<std::string>& into,
                  const std::string& what) {
  verb.add_option(option, into, fmt::format("{}; again for another key", what))
      ->type_name(shape)
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
}

std::string stray_setting(int argc, const char* const* argv) {
  const std::string_view takes_settings[] = {"--set", "--add"};
  for (int i = 2; i + 1 < argc; ++i)
    if (std::ranges::count(takes_settings, argv[i - 1]) > 0 && is_setting(argv[i]) && is_setting(argv[i + 1]))
      return fmt::format("{0}: each key needs its own {1}: {1} {2} {1} {0}", argv[i + 1], argv[i - 1],
                         argv[i]);
  return "";
}

}  // namespace chute::app
