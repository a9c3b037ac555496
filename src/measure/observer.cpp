#include "measure/observer.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/column_texts.hpp"
#include "common/not_settled.hpp"

namespace chute::measure {

std::vector<std::string> RunContext::comments(std::string what) const {
  return {std::move(what), title + "; " + made_by};
}

std::array<double, 3> RunContext::gravity_at(double time) const {
  if (!tilt) return facts.gravity;
  const double angle = tilt->angle(time), g = tilt->gravity;
  return frame.dimensions == 2 ? as_file_vector(gravity_on_incline<2>(g, angle))
                               : as_file_vector(gravity_on_incline<3>(g, angle));
}

std::string RunContext::moment(double time) const {
  return fmt::format("{} = {:.6g}", offers.clock == "time" ? "t" : offers.clock, time);
}

std::vector<std::string> RunContext::average_note(const std::optional<double>& from, const Flow& flow) const {
  if (from || !std::isfinite(flow.from)) return {};
  const bool settled = flow.verdict == Verdict::steady || flow.verdict == Verdict::stopped;
  if (settled)
    return {fmt::format("averages from {} on, when the flow was {}", moment(flow.from), name(flow.verdict))};
  return {fmt::format("{} (the flow is {}): averages from {} on all the same", not_settled,
                      name(flow.verdict), moment(flow.from))};
}

void RunContext::write(const std::string& name, const std::string& bytes) const {
  if (files) files->write(name, with_column_comments(name, bytes, facts.units == "SI"));
}
void RunContext::write_once(const std::string& name, const std::string& bytes) const {
  if (files) files->write_once(name, bytes);
}

}  // namespace chute::measure
