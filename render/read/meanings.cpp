#include "read/meanings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/fields.hpp"

namespace chute::read {

std::vector<Meanings::Said> Meanings::said() const {
  const Said all[] = {{fields::radius.name, &radius_array, {1}},
                      {"diameter", &diameter_array, {1}},
                      {fields::velocity.name, &velocity, {3, 2}},
                      {fields::angular_velocity.name, &spin, {3, 1}},
                      // an angle in the plane, a quaternion in space
                      {fields::orientation.name, &orientation, {4, 1}},
                      {fields::type.name, &type, {1}},
                      {fields::id.name, &id, {1}}};
  std::vector<Said> found;
  for (const Said& one : all)
    if (!one.array->empty()) found.push_back(one);
  return found;
}

std::string Meanings::describe() const {
  std::string text = fmt::format("radius {}", radius.value_or(0));
  for (const auto& one : said()) text += fmt::format(" {}={}", one.what, *one.array);
  for (const auto* names : {&force, &ends}) text += fmt::format(" {}", fmt::join(*names, ","));
  return text;
}

}  // namespace chute::read
