#include <algorithm>
#include <set>

#include "plot/marks.hpp"

namespace chute::plot {
namespace {

bool ends_with_fit(const std::string& name) { return name.size() > 4 && name.ends_with(" fit"); }

}  // namespace

bool has_common_legend(const Figure& figure) {
  if (figure.legend != Legend::automatic) return figure.legend == Legend::common;
  if (figure.panels.size() < 2) return false;
  std::set<std::string> first;
  for (const auto& s : figure.panels[0].series) first.insert(s.name);
  if (first.size() < 2) return false;
  return std::all_of(figure.panels.begin(), figure.panels.end(), [&](const Panel& p) {
    std::size_t shared = 0;
    for (const auto& s : p.series) shared += first.count(s.name);
    return 2 * shared >= std::max(p.series.size(), first.size()) && p.legend == Place::automatic;
  });
}

std::map<std::string, SeriesLook> assign_looks(const Figure& figure, const Look& look) {
  // groups of series that must be told apart: those of a panel with its own legend, or all
  const bool apart = figure.legend != Legend::off && !has_common_legend(figure);
  std::vector<std::vector<const Series*>> groups(1);
  for (const auto& panel : figure.panels) {
    if (apart && !groups.back().empty()) groups.emplace_back();
    for (const auto& s : panel.series) groups.back().push_back(&s);
    for (const auto& inset : panel.insets)
      for (const auto& s : inset.plot.series) groups.back().push_back(&s);
  }
  struct Pick {
    int index = 0, dash = 0;
    bool dashed = false;
  };
  std::map<std::string, Pick> picks;
  /// The smallest number that no series beside `name` has, in any group.
  const auto smallest = [&](const std::string& name, auto number_of) {
    std::set<int> taken;
    for (const auto& group : groups) {
      if (std::none_of(group.begin(), group.end(), [&](const Series* s) { return s->name == name; }))
        continue;
      for (const auto* s : group)
        if (picks.count(s->name)) taken.insert(number_of(picks[s->name]));
    }
    int free = 0;
    while (taken.count(free)) ++free;
    return free;
  };
  std::map<std::string, SeriesLook> looks;
  for (const auto& group : groups)
    for (const auto* s : group) {
      if (picks.count(s->name)) continue;
      Pick pick;
      const auto base =
          ends_with_fit(s->name) ? picks.find(s->name.substr(0, s->name.size() - 4)) : picks.end();
      pick.dashed = s->kind == Kind::line || s->kind == Kind::band || s->kind == Kind::steps;
      pick.index = s->color              ? *s->color
                   : base != picks.end() ? base->second.index
                                         : smallest(s->name, [](const Pick& p) { return p.index; });
      if (pick.dashed)
        pick.dash = s->dash.value_or(smallest(s->name, [](const Pick& p) { return p.dashed ? p.dash : -1; }));
      picks[s->name] = pick;
      looks[s->name] = {
          s->ink.value_or(look.colors[static_cast<std::size_t>(pick.index) % look.colors.size()]),
          s->marker.value_or(pick.index), pick.dash, s->width, s->size};
    }
  return looks;
}

}  // namespace chute::plot
