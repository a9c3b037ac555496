#include "view/painter.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "common/fields.hpp"
#include "plot/scale.hpp"

namespace chute::view {
namespace {

/// Grains that force chains run through are mixed with so much of the ground: the chains are the subject.
constexpr double faded_by_chains = 0.55;

std::string map_name(const FrameStyle& style, const Survey& survey) {
  return !style.map.empty() ? style.map : survey.diverging ? "rdbu" : "viridis";
}

}  // namespace

Studio::Studio(const FrameStyle& s, const Survey& found)
    : style(s), survey(found), palette(palette_of(s.background)), map(map_name(s, found)) {
  style.check();
  if (style.chains && !survey.field.forces && !is_glassy()) map = map.faded(palette.ground, faded_by_chains);
}

std::size_t end_of_body(const read::GrainFrame& frame, std::size_t first) {
  const auto* body = frame.own ? frame.find(fields::body.name) : nullptr;
  if (!body || body->components != 1) return first + 1;
  std::size_t end = first + 1;
  while (end < frame.size() && body->at(end) == body->at(first)) ++end;
  return end;
}

std::vector<Rgb> Studio::colors(const read::GrainFrame& frame) const {
  const auto values = survey.field.values(frame);
  const auto& kinds = survey.categories;
  std::vector<Rgb> result(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (is_bed(frame, i))
      result[i] = palette.bed;
    else if (survey.field.is_none())
      result[i] = palette.plain;
    else if (!std::isfinite(values[i]))
      result[i] = palette.quiet;
    else if (!kinds.empty())
      result[i] =
          kind_color(std::lower_bound(kinds.begin(), kinds.end(), std::llround(values[i])) - kinds.begin());
    else
      result[i] = map.at(plot::Span{survey.low, survey.high}.fraction(values[i]));
  }
  return result;
}

Rgb Studio::kind_color(std::ptrdiff_t kind) const {
  const auto& colors = kind_colors(style.background);
  const Rgb color = colors[static_cast<std::size_t>(kind) % colors.size()];
  return style.chains && !is_glassy() ? mix(color, palette.ground, faded_by_chains) : color;
}

Rgb Studio::chain_color(double force) const {
  if (!survey.field.forces) return palette.chain;
  return map.at(plot::Span{survey.low, survey.high}.fraction(force));
}

bool Studio::is_cut(const Eigen::Vector3d& place) const {
  return std::any_of(style.cuts.begin(), style.cuts.end(), [&](const Cut& cut) { return cut.hides(place); });
}

Trail trails(const FrameData& data) {
  const auto& frame = data.frame;
  Trail trail;
  trail.paths.resize(frame.size());
  const auto* ids = frame.find(fields::id.name);
  std::vector<std::unordered_map<long long, std::size_t>> places(data.earlier.size());
  for (std::size_t k = 0; k < data.earlier.size(); ++k)
    if (const auto* earlier_ids = data.earlier[k]->find(fields::id.name); ids && earlier_ids)
      for (std::size_t i = 0; i < data.earlier[k]->size(); ++i)
        places[k][std::llround(earlier_ids->at(i))] = i;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (frame.is_fixed(i)) continue;
    Eigen::Vector3d here = frame.centre(i);
    trail.paths[i].push_back(here);
    for (std::size_t back = data.earlier.size(); back-- > 0;) {
      const auto& earlier = *data.earlier[back];
      std::size_t j = i;  // without ids, grains keep their places in the file
      if (ids) {
        const auto found = places[back].find(std::llround(ids->at(i)));
        if (found == places[back].end()) break;
        j = found->second;
      } else if (earlier.size() != frame.size()) {
        break;
      }
      const Eigen::Vector3d there = here + frame.shortest(earlier.centre(j) - here);
      trail.paths[i].push_back(there);
      here = there;
    }
  }
  return trail;
}

}  // namespace chute::view
