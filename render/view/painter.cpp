#include "view/painter.hpp"

#include <cmath>
#include <unordered_map>

#include "common/fields.hpp"

namespace chute::view {
namespace {

std::string map_name(const FrameStyle& style, const Survey& survey) {
  return !style.map.empty() ? style.map : survey.diverging ? "rdbu" : "viridis";
}

}  // namespace

Studio::Studio(const FrameStyle& s, const Survey& found)
    : style(s), survey(found), palette(palette_of(s.background)), map(map_name(s, found)) {
  style.check();
  if (style.chains) map = map.faded(palette.ground, 0.55);  // the chains are the subject
}

std::vector<Rgb> Studio::colors(const read::GrainFrame& frame) const {
  const auto values = survey.field.values(frame);
  std::vector<Rgb> result(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (is_bed(frame, i))
      result[i] = palette.bed;
    else if (survey.field.is_none())
      result[i] = palette.plain;
    else if (!std::isfinite(values[i]))
      result[i] = palette.quiet;
    else
      result[i] = map.at((values[i] - survey.low) / (survey.high - survey.low));
  }
  return result;
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
    std::array<double, 3> here{frame.x[i], frame.y[i], frame.z[i]};
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
      std::array<double, 3> there{earlier.x[j], earlier.y[j], earlier.z[j]};
      for (int c = 0; c < 3; ++c)
        if (const double period = frame.period(c); period > 0) {
          auto& p = there[static_cast<std::size_t>(c)];
          p += period * std::round((here[static_cast<std::size_t>(c)] - p) / period);
        }
      trail.paths[i].push_back(there);
      here = there;
    }
  }
  return trail;
}

}  // namespace chute::view
