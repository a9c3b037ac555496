#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace chute::report {

/// Text that HTML shows as it is, also inside an attribute's double quotes.
std::string escape(std::string_view text);

/// `data:TYPE;base64,…`: a file inside the page.
std::string data_address(std::string_view type, std::string_view bytes);

/// Puts values in place of `{{name}}`. An unknown name is a broken invariant.
std::string fill(std::string_view form, const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace chute::report
