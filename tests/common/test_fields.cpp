#include <catch2/catch.hpp>
#include <set>

#include "common/fields.hpp"

using namespace chute;

// Files outlive programs: these names are a contract with every file ever written.
TEST_CASE("the arrays have the names of the design page") {
  std::set<std::string_view> grains, impacts;
  for (const auto& field : fields::grain_fields) grains.insert(field.name);
  for (const auto& field : fields::impact_fields) impacts.insert(field.name);
  for (const char* name : {"id", "type", "radius", "mass", "velocity", "angular_velocity", "force"}) {
    INFO(name);
    CHECK(grains.count(name) == 1);
  }
  CHECK(impacts == std::set<std::string_view>{"time", "gamma", "phi", "v_n", "v_t", "flight", "gamma_before",
                                              "rolling", "bead", "grain"});
}
