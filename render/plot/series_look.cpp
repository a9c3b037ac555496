#include <algorithm>
#include <array>
#include <set>

#include "plot/factors.hpp"
#include "plot/marks.hpp"

namespace chute::plot {
namespace {

/// Shapes that can be filled in different ways, in the order in which they are told apart best.
constexpr std::array shapes{0, 6, 2, 8, 4};  // circle, block, up, gem, down (style.cpp)
constexpr int cross = 9;

bool is_dashed(const Series& s) {
  return s.kind == Kind::line || s.kind == Kind::band || s.kind == Kind::steps;
}

/// Series that must be told apart: those of a panel with its own legend, or all.
std::vector<std::vector<const Series*>> groups_of(const Figure& figure) {
  const bool apart = figure.legend != Legend::off && !has_common_legend(figure);
  std::vector<std::vector<const Series*>> groups(1);
  for (const auto& panel : figure.panels) {
    if (apart && !groups.back().empty()) groups.emplace_back();
    for (const auto& s : panel.series) groups.back().push_back(&s);
    for (const auto& inset : panel.insets)
      for (const auto& s : inset.plot.series) groups.back().push_back(&s);
  }
  return groups;
}

/// The looks of a table of series: one factor by colour and shape, one by fill and dash.
class ByFactors {
 public:
  ByFactors(const Factors& factors, const std::vector<const Series*>& group, const Look& look)
      : factors_(factors), look_(look) {
    // hollow means doubtful where there are such series
    doubtful_ = std::any_of(group.begin(), group.end(),
                            [](const Series* s) { return s->hollow || is_doubtful(s->name); });
    for (const auto* s : group)
      if (const auto at = factors.of.find(s->name); at != factors.of.end()) {
        auto& order = is_dashed(*s) ? dashes_ : fills_;
        if (std::find(order.begin(), order.end(), at->second.style) == order.end())
          order.push_back(at->second.style);
      }
  }

  SeriesLook of(const Factors::Place& place) const {
    SeriesLook ink;
    const auto color = static_cast<std::size_t>(place.color);
    ink.color = look_.colors[color % look_.colors.size()];
    ink.marker = look_.markers.empty() ? shapes[color % shapes.size()] : look_.marker(place.color);
    ink.fill = fill(place.style), ink.dash = look_.dash(index(dashes_, place.style));
    return ink;
  }
  /// For what stands outside the table.
  SeriesLook alone() const {
    SeriesLook ink;
    ink.color = look_.colors[factors_.colors.size() % look_.colors.size()];
    ink.marker = cross;
    return ink;
  }

 private:
  const Factors& factors_;
  const Look& look_;
  bool doubtful_ = false;
  std::vector<int> fills_, dashes_;  // styles, in order of appearance

  static int index(const std::vector<int>& order, int style) {
    const auto at = std::find(order.begin(), order.end(), style);
    return at == order.end() ? 0 : static_cast<int>(at - order.begin());
  }
  Fill fill(int style) const {
    constexpr std::array usual{Fill::filled, Fill::hollow, Fill::half, Fill::dotted},
        beside_doubtful{Fill::filled, Fill::half, Fill::dotted, Fill::hollow};
    const auto k = static_cast<std::size_t>(index(fills_, style)) % usual.size();
    return doubtful_ ? beside_doubtful[k] : usual[k];
  }
};

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

std::optional<Factors> factors_in(const Figure& figure, int panel) {
  if (figure.legend == Legend::off) return {};
  std::vector<const Series*> group;
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    if (panel < 0 || panel == static_cast<int>(i))
      for (const auto& s : figure.panels[i].series) group.push_back(&s);
  return factors_of(group);
}

std::map<std::string, SeriesLook> assign_looks(const Figure& figure, const Look& look) {
  const auto groups = groups_of(figure);
  struct Pick {
    int index = 0, dash = 0;
    bool dashed = false;
  };
  std::map<std::string, Pick> picks;
  /// The smallest number that no series beside `name` has in any group, nor one that shows the same quantity at another value.
  const auto smallest = [&](const std::string& name, auto number_of) {
    std::set<int> taken;
    const auto keys = keys_of(name);
    for (const auto& group : groups) {
      const bool here = std::any_of(group.begin(), group.end(),
                                    [&](const Series* s) { return base_name(s->name) == name; });
      for (const auto* s : group) {
        const auto base = base_name(s->name);
        if (picks.count(base) && (here || (!keys.empty() && keys_of(base) == keys)))
          taken.insert(number_of(picks[base]));
      }
    }
    int free = 0;
    while (taken.count(free)) ++free;
    return free;
  };
  std::map<std::string, SeriesLook> looks;
  for (const auto& group : groups) {
    if (const auto factors = figure.legend == Legend::off ? std::nullopt : factors_of(group)) {
      const ByFactors by(*factors, group, look);
      for (const auto* s : group) {
        const auto place = factors->of.find(base_name(s->name));
        auto ink = place == factors->of.end() ? by.alone() : by.of(place->second);
        ink.hollow = s->hollow || is_doubtful(s->name);
        if (s->ink) ink.color = *s->ink;
        ink.width = s->width, ink.size = s->size;
        looks.try_emplace(s->name, ink);
      }
      continue;
    }
    const bool doubt = std::any_of(group.begin(), group.end(),
                                   [](const Series* s) { return s->hollow || is_doubtful(s->name); });
    for (const auto* s : group) {
      if (looks.count(s->name)) continue;
      const auto base = base_name(s->name);
      // of a doubtful part everything is as of the whole, of a fit the colour
      const bool same = picks.count(base) && is_doubtful(s->name);
      Pick pick;
      pick.dashed = is_dashed(*s);
      pick.index = s->color            ? *s->color
                   : picks.count(base) ? picks[base].index
                                       : smallest(base, [](const Pick& p) { return p.index; });
      if (pick.dashed)
        pick.dash =
            same ? picks[base].dash
                 : s->dash.value_or(smallest(base, [](const Pick& p) { return p.dashed ? p.dash : -1; }));
      SeriesLook ink{s->ink.value_or(look.colors[static_cast<std::size_t>(pick.index) % look.colors.size()]),
                     s->marker.value_or(look.marker(pick.index)), s->dash.value_or(look.dash(pick.dash))};
      ink.width = s->width, ink.size = s->size;
      if (same && !s->marker) ink.marker = looks.count(base) ? looks[base].marker : ink.marker;
      ink.hollow = s->hollow || is_doubtful(s->name);
      if (doubt && !s->marker) ink.fill = Fill::filled;  // hollow means doubtful there
      looks[s->name] = ink;
      if (!same) picks[is_doubtful(s->name) ? base : s->name] = pick;
    }
  }
  return looks;
}

}  // namespace chute::plot
