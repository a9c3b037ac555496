#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/domain.hpp"
#include "core/grains.hpp"

namespace chute::restructuring {

/// A grain that lies already, or one of its periodic images.
template <int D>
struct Placed {
  Vec<D> place{};
  double radius = 0;
  std::int32_t id = 0;
};

/// A grain on its way passes another that is nearer than the sum of their radii by less than this part; one that does not
/// pass stops where they touch exactly. Without it rounding decides whether a grain fits into a hole of just its own
/// width, and leaves it hanging there by the root of an ulp.
constexpr double yielding = 1e-10;

/// A ball that somebody looks into.
template <int D>
struct Ball {
  Vec<D> centre{};
  double radius = 0;
};

/// The grains that lie already, for whoever asks what lies near a place. They stand in upright columns about one mean
/// diameter wide, ordered by height within each. A grain that is laid touches those near the surface, so a look begins
/// at the top of a column and ends at the first grain that lies too deep: the depth of a packing costs nothing.
template <int D>
class Columns {
 public:
  /// Makes columns for these grains, and lays none yet. The lateral place is all coordinates but the last.
  Columns(const Grains<D>& grains, const Domain<D>& domain);

  void clear();
  void lay(const Placed<D>& grain);
  /// Takes up a grain that lies at this place.
  void take(const Placed<D>& grain);

  /// visit(Placed) for all that touch a grain of radius `own` whose centre is in the ball, and some that do not.
  template <class Visit>
  void near(const Ball<D>& ball, double own, const Visit& visit) const {
    const double reach = ball.radius + own + largest_ordinary_, lowest = ball.centre[D - 1] - reach;
    for_columns(ball.centre, reach, [&](const Column& column, const Vec<D>& shift) {
      for (std::size_t k = column.size(); k-- > 0 && column[k].place[D - 1] > lowest;)
        visit(shifted(column[k], shift));
    });
    for_giants(ball.centre, visit);
  }
  /// Height at which a grain of radius `own` that falls at this lateral place, from `from`, touches the first of those
  /// that `counts` allows, and which that is; −infinity if it touches nothing.
  template <class Counts>
  double highest_contact(const Vec<D>& place, double own, double from, const Counts& counts,
                         Placed<D>& hit) const {
    double best = -std::numeric_limits<double>::infinity();
    const auto look = [&](const Placed<D>& grain) {
      const double D_k = own + grain.radius, narrow = (1 - yielding) * D_k;
      double aside = 0;
      for (int k = 0; k + 1 < D; ++k) aside += (place[k] - grain.place[k]) * (place[k] - grain.place[k]);
      if (!(narrow * narrow > aside)) return;
      const double height = grain.place[D - 1] + std::sqrt(D_k * D_k - aside);
      if (height > best && height <= from && counts(grain)) best = height, hit = grain;
    };
    const double reach = own + largest_ordinary_;
    for_columns(place, reach, [&](const Column& column, const Vec<D>& shift) {
      for (std::size_t k = column.size(); k-- > 0 && column[k].place[D - 1] + reach > best;)
        look(shifted(column[k], shift));
    });
    for_giants(place, look);
    return best;
  }

 private:
  using Column = std::vector<Placed<D>>;
  /// So many grains more than twice the usual size are kept in a list of their own that every look goes through, because
  /// one intruder would otherwise make every look as wide as itself. With more of them the looks are that wide.
  static constexpr std::size_t most_giants = 16;
  static constexpr double giant = 2;  // in mean radii

  Domain<D> domain_;
  Vec<D> lower_{};
  double width_[D - 1] = {};
  int count_[D - 1] = {};
  double largest_ordinary_ = 0, giant_from_ = std::numeric_limits<double>::infinity();
  std::vector<Column> columns_;
  std::vector<Placed<D>> giants_;

  static Placed<D> shifted(Placed<D> grain, const Vec<D>& shift) {
    for (int k = 0; k + 1 < D; ++k) grain.place[k] += shift[k];
    return grain;
  }
  std::size_t column_at(const Vec<D>& place) const {
    std::size_t at = 0;
    for (int k = 0; k + 1 < D; ++k)
      at = at * static_cast<std::size_t>(count_[k]) +
           static_cast<std::size_t>(std::clamp(index(k, place[k]), 0, count_[k] - 1));
    return at;
  }
  int index(int k, double x) const { return static_cast<int>(std::floor((x - lower_[k]) / width_[k])); }
  /// visit(column, shift of its grains) for the columns that reach into a box around the place.
  template <class Visit>
  void for_columns(const Vec<D>& place, double reach, const Visit& visit) const {
    Vec<D> shift{};
    const auto along = [&](int k, const auto& inside) {
      int first = index(k, place[k] - reach), last = index(k, place[k] + reach);
      if (!domain_.periodic(k))
        first = std::clamp(first, 0, count_[k] - 1), last = std::clamp(last, 0, count_[k] - 1);
      int lap = first >= 0 ? first / count_[k] : -((count_[k] - 1 - first) / count_[k]);
      for (int at = first - lap * count_[k], n = last - first; n >= 0; --n, ++at) {
        if (at == count_[k]) at = 0, ++lap;
        shift[k] = lap == 0 ? 0 : lap * domain_.length[k];
        inside(at);
      }
    };
    if constexpr (D == 2)
      along(0, [&](int x) { visit(columns_[static_cast<std::size_t>(x)], shift); });
    else
      along(0, [&](int x) {
        along(1, [&](int y) { visit(columns_[static_cast<std::size_t>(x * count_[1] + y)], shift); });
      });
  }
  /// visit(Placed) for the images of all giants that are nearest to the place, and those beside them.
  template <class Visit>
  void for_giants(const Vec<D>& place, const Visit& visit) const {
    for (Placed<D> grain : giants_) {
      for (int k = 0; k + 1 < D; ++k)
        if (domain_.periodic(k))
          grain.place[k] += domain_.length[k] * std::round((place[k] - grain.place[k]) / domain_.length[k]);
      const auto turn = [&](int k, const auto& inside) {
        for (int lap = domain_.periodic(k) ? -1 : 0; lap <= (domain_.periodic(k) ? 1 : 0); ++lap) {
          Placed<D> image = grain;
          if (lap != 0) image.place[k] += lap * domain_.length[k];
          inside(image);
        }
      };
      if constexpr (D == 2)
        turn(0, visit);
      else
        turn(0, [&](const Placed<D>& one) {
          for (int lap = domain_.periodic(1) ? -1 : 0; lap <= (domain_.periodic(1) ? 1 : 0); ++lap) {
            Placed<D> image = one;
            if (lap != 0) image.place[1] += lap * domain_.length[1];
            visit(image);
          }
        });
    }
  }
};

}  // namespace chute::restructuring
