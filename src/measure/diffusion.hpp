#pragma once
#include <span>
#include <vector>

#include "measure/blocks.hpp"

namespace chute::measure {

/// The file of a run that has D_x and D_y.
inline constexpr const char* diffusion_coefficients_file = "diffusion_coefficients.csv";

/// What pieces of one length of the ways of grains add up to. Components: along, and across (2D has none).
struct PieceSums {
  double pieces = 0;
  std::array<double, 2> way{}, square{};
  PieceSums& operator+=(const PieceSums& o) {
    pieces += o.pieces;
    for (std::size_t k = 0; k < 2; ++k) way[k] += o.way[k], square[k] += o.square[k];
    return *this;
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(pieces, way, square);
  }
};

/// How far grains spread: diffusion about the mean drift, thesis (4.65) and (4.66),
///
///     D_x = <(x(t) − x(0) − v̄_x t)²>/2t,   D_y = <(y(t) − y(0))²>/2t   for long t,
///
/// from ways that are cut into pieces, one behind the other, for each of many lengths t. The drift v̄_x is that of all pieces
/// themselves. Nothing is kept of the ways, so a run of any length takes the same memory.
class Diffusion {
 public:
  Diffusion(double every, double longest, const Window& window);

  /// The place of a grain, `every` after the one before.
  void add(std::size_t grain, double time, const std::array<double, 2>& place);

  struct Row {
    double time, pieces;
    std::array<Estimate, 2> square;  ///< mean square of the displacement, along about the drift
  };
  /// What spreads how fast: slopes of the mean squares, over lengths from a sixth of the longest on.
  struct Result {
    Estimate drift;
    std::array<Estimate, 2> D;
    std::array<double, 2>
        diffusive_from;  ///< shortest length from which on <..²>/2t stays within a quarter of D
    double longest;
    std::vector<Row> rows;
  };
  Result result() const;

  template <class Archive>
  void serialize(Archive& a) {
    a(grains_, blocks_);
  }

 private:
  struct Grain {
    std::int64_t looks = 0;
    std::vector<std::array<double, 2>> begin;  ///< of the current piece of each length
    template <class Archive>
    void serialize(Archive& a) {
      a(looks, begin);
    }
  };
  double every_;
  std::vector<std::int64_t> lengths_;  ///< in looks
  std::vector<Grain> grains_;
  Blocks<PieceSums> blocks_;  // a bin a length
};

}  // namespace chute::measure
