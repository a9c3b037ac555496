#include "run/flow.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "common/atomic_file.hpp"
#include "common/error.hpp"

namespace chute::run {

nlohmann::ordered_json to_json(const measure::Flow& flow) {
  nlohmann::ordered_json json{{"verdict", measure::name(flow.verdict)}, {"from", flow.from}};
  const auto add = [&](const std::string& key, const Estimate& estimate) {
    json[key] = estimate.mean;  // not a number becomes null
    json[key + "_err"] = estimate.error ? nlohmann::ordered_json(*estimate.error) : nullptr;
  };
  add("v_x", flow.v_x);
  add("omega", flow.omega);
  add("kinetic", flow.kinetic);
  return json;
}

measure::Flow flow_from(const nlohmann::json& json) {
  const auto number = [&](const std::string& key) -> std::optional<double> {
    const auto& value = json.at(key);
    return value.is_null() ? std::nullopt : std::optional(value.get<double>());
  };
  const auto estimate = [&](const std::string& key) {
    return Estimate{number(key).value_or(NAN), number(key + "_err")};
  };
  const auto verdict = measure::verdict_named(json.at("verdict").get<std::string>());
  if (!verdict) throw InputError("its verdict is not known");
  return {*verdict, number("from").value_or(NAN), estimate("v_x"), estimate("omega"), estimate("kinetic")};
}

measure::Flow read_flow(const std::filesystem::path& directory) {
  const auto file = directory / "run.json";
  try {
    return flow_from(nlohmann::json::parse(read_file(file)).at("flow"));
  } catch (const nlohmann::json::exception&) {
    throw InputError(file.string() + ": does not tell what became of the flow; run it again with --force");
  }
}

}  // namespace chute::run
