#include "engines/monte_carlo/monte_carlo_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/types/array.hpp>
#include <cereal/types/vector.hpp>
#include <numeric>

#include "common/error.hpp"
#include "common/state_archive.hpp"
#include "core/kernel.hpp"
#include "engines/kind/deep_start.hpp"
#include "engines/kind/packing.hpp"

namespace chute::monte_carlo {
namespace {

/// Sweeps after which cells are laid anew, for grains that rose or sank; it changes no result.
constexpr std::int64_t between_fillings = 64;
/// Cells along a block, at least: a grain at its rim cannot leave, so blocks should not be small, and not so large that
/// few of them are left to share out.
constexpr int cells_along_block = 4;

/// What random numbers of a sweep are for: items of Random.
enum : std::uint64_t { for_all = 0, for_giants = 1, for_blocks = 2, first_block = 16 };

/// A displacement drawn evenly from the unit disc (ball). 2⁶⁴ numbers give D coordinates in steps of 2⁻²⁰ or finer.
template <int D>
Vec<D> in_unit_ball(Random& random) {
  constexpr int bits = 64 / D;
  constexpr std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
  constexpr double scale = 2.0 / static_cast<double>(std::uint64_t{1} << bits);
  for (;;) {
    std::uint64_t numbers = random();
    Vec<D> r;
    for (int k = 0; k < D; ++k, numbers >>= bits)
      r[k] = (static_cast<double>(static_cast<std::int64_t>(numbers & mask)) + 0.5) * scale - 1;
    if (dot(r, r) <= 1) return r;
  }
}
std::size_t one_of(std::size_t count, Random& random) {
  return static_cast<std::size_t>((random() >> 32) * count >> 32);
}

template <class Work>
struct WorkKernel {
  const Work& work;
  void operator()() const { work(); }
};
/// Does it with the widest vectors that the processor has.
template <class Work>
void in_best_isa(const Work& work) {
  run_kernel(best_isa(), WorkKernel<Work>{work});
}

}  // namespace

template <int D>
MonteCarloEngine<D>::MonteCarloEngine(Grains<D> grains, const MonteCarloSetup<D>& setup, int threads)
    : setup_(setup),
      grains_(std::move(grains)),
      team_(threads),
      extent_(grains_),
      delta_(setup.step),
      start_place_(grains_.position) {
  for (auto& force : no_force_) force.assign(grains_.size(), 0);
  for (auto& velocity : grains_.velocity) std::fill_n(velocity.begin(), grains_.moving, 0.0);
  for (auto& spin : grains_.spin) std::fill_n(spin.begin(), grains_.moving, 0.0);
  for (int k = 0; k < D; ++k)
    if (delta_ > longest_part * setup_.domain.length[k])
      throw InputError(fmt::format(
          "engine.step: trial moves of {:.6g} are too long for a period of {:.6g}; at most {} of it "
          "is possible",
          delta_, setup_.domain.length[k], longest_part));
  engines::refuse_deep_start<D>(grains_, setup_, engines::deepest_of_soft_grains);
  engines::push_apart<D>(grains_, setup_, 0);
  start_place_ = grains_.position;
  wrap_into(setup_.domain, grains_);
  lay_cells();
  check_overlaps(true);
}

template <int D>
void MonteCarloEngine<D>::lay_cells() {
  extent_ = Extent<D>(grains_);
  slots_.fill(grains_, setup_.domain, extent_);
}

template <int D>
void MonteCarloEngine<D>::check_overlaps(bool at_start) {
  // At the start it is the scene that is wrong, later a move.
  const auto wrong = [&](std::size_t i, const char* what) {
    if (!at_start) leave_physics(i, what);
    throw InputError(fmt::format("grains.start: grain {}: {}; hard grains never do", i, what));
  };
  constexpr double rounding = 1e-12;
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    const auto place = grains_.place(i);
    if (slots_.overlaps(i, place, slots_.cell_of(place))) wrong(i, "it overlaps another");
    for (const auto& wall : setup_.walls)
      if (wall.height(place) < grains_.radius[i] * (1 - rounding)) wrong(i, "it lies in a wall");
  }
}

template <int D>
void MonteCarloEngine<D>::advance(std::int64_t step) {
  for (; step_ < step; ++step_) {
    accepted_ = tried_ = 0;
    if (setup_.shaking)
      shake();
    else
      sweep();
  }
}

template <int D>
double MonteCarloEngine<D>::mean_height() const {
  const auto& z = grains_.position[D - 1];
  return std::accumulate(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(grains_.moving), 0.0) /
         static_cast<double>(grains_.moving);
}

template <int D>
double MonteCarloEngine<D>::potential() const {
  double sum = 0;
  for (std::size_t i = 0; i < grains_.moving; ++i)
    sum -= grains_.mass[i] * dot(setup_.gravity, grains_.place(i));
  return sum;
}

template <int D>
void MonteCarloEngine<D>::raise() {
  auto& z = grains_.position[D - 1];
  for (std::size_t i = 0; i < grains_.moving; ++i)
    z[i] += setup_.shaking->lift + setup_.shaking->expand * z[i];
  lay_cells();
  check_overlaps(false);
}

template <int D>
void MonteCarloEngine<D>::shake() {
  raise();
  double height = mean_height();
  for (std::int64_t done = 1; done <= setup_.shaking->sweeps; ++done) {
    sweep();
    if (done % Shaking::settled_sweeps != 0) continue;
    const double now = mean_height();
    if (height - now < setup_.shaking->settled) return;
    height = now;
  }
}

template <int D>
void MonteCarloEngine<D>::sweep() {
  if (sweeps_ % between_fillings == 0) lay_cells();
  const auto before = accepted_;
  if (setup_.serial)
    sweep_serially();
  else
    sweep_blocks();
  tried_ += static_cast<std::int64_t>(grains_.moving);
  if (sweeps_ < setup_.equilibrate)
    adapt(static_cast<double>(accepted_ - before) / static_cast<double>(grains_.moving));
  ++sweeps_;
}

/// Longer moves if too many are accepted, shorter if too few.
template <int D>
void MonteCarloEngine<D>::adapt(double acceptance) {
  constexpr double
      aim = 0.4,
      fastest = 1.2,
      longest =
          5;  // the last in the largest radii: in a gas so thin that more would be accepted, it makes no difference
  double most = longest * *std::max_element(grains_.radius.begin(), grains_.radius.end());
  for (int k = 0; k < D; ++k) most = std::min(most, setup_.domain.length[k] / 4);
  delta_ = std::min(most, delta_ * std::clamp(acceptance / aim, 1 / fastest, fastest));
}

template <int D>
void MonteCarloEngine<D>::sweep_serially() {
  in_best_isa([&] {
    Random random(setup_.seed, Purpose::engine, for_all, static_cast<std::uint64_t>(sweeps_));
    std::int64_t accepted = 0;
    for (std::size_t t = 0; t < grains_.moving; ++t)
      accepted += try_move(one_of(grains_.moving, random), random, nullptr);
    accepted_ += accepted;
  });
}

template <int D>
typename MonteCarloEngine<D>::Block MonteCarloEngine<D>::block_at(std::size_t number,
                                                                  const std::array<int, D>& shift) const {
  Block block;
  for (std::size_t k = D; k-- > 0;) {
    const int n = slots_.count(static_cast<int>(k)),
              at = static_cast<int>(number % static_cast<std::size_t>(blocks_[k]));
    number /= static_cast<std::size_t>(blocks_[k]);
    const int first = at * n / blocks_[k];
    block.many[k] = (at + 1) * n / blocks_[k] - first;
    block.first[k] = (first + shift[k]) % n;
  }
  return block;
}

template <int D>
bool MonteCarloEngine<D>::in_block(const Block& block, const typename Slots<D>::Cell& cell) const {
  for (std::size_t k = 0; k < D; ++k) {
    int from = cell[k] - block.first[k];
    if (from < 0) from += slots_.count(static_cast<int>(k));
    if (from >= block.many[k]) return false;
  }
  return true;
}

template <int D>
void MonteCarloEngine<D>::sweep_blocks() {
  Random random(setup_.seed, Purpose::engine, for_blocks, static_cast<std::uint64_t>(sweeps_));
  std::array<int, D> shift;
  std::size_t total = 1;
  for (std::size_t k = 0; k < D; ++k) {
    const int n = slots_.count(static_cast<int>(k));
    blocks_[k] = n == 1 ? 1 : 2 * std::max(1, n / (2 * cells_along_block));
    shift[k] = static_cast<int>(one_of(static_cast<std::size_t>(n), random));
    total *= static_cast<std::size_t>(blocks_[k]);
  }
  constexpr std::size_t colours = std::size_t{1} << D;
  std::array<std::vector<std::size_t>, colours> of_colour;
  for (std::size_t b = 0; b < total; ++b) {
    std::size_t colour = 0, rest = b;
    for (std::size_t k = D; k-- > 0; rest /= static_cast<std::size_t>(blocks_[k]))
      colour = 2 * colour + rest % static_cast<std::size_t>(blocks_[k]) % 2;
    of_colour[colour].push_back(b);
  }
  std::array<std::size_t, colours> order;
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = colours; k-- > 1;) std::swap(order[k], order[one_of(k + 1, random)]);
  struct Mine {
    alignas(64) std::int64_t accepted = 0;
    std::vector<std::int32_t> ids;
  };
  std::vector<Mine> mine(team_.size());
  for (const auto colour : order) {
    const auto& list = of_colour[colour];
    team_.run([&](std::size_t member) {
      in_best_isa([&] {
        for (std::size_t at = list.size() * member / team_.size();
             at < list.size() * (member + 1) / team_.size(); ++at)
          mine[member].accepted +=
              work_on(block_at(list[at], shift), first_block + list[at], mine[member].ids);
      });
    });
  }
  for (const auto& m : mine) accepted_ += m.accepted;
  // Giants reach over many blocks: they move when nobody else does.
  Random for_them(setup_.seed, Purpose::engine, for_giants, static_cast<std::uint64_t>(sweeps_));
  for (std::size_t k = 0; k < slots_.giants(); ++k)
    if (slots_.giant(k) < grains_.moving) accepted_ += try_move(slots_.giant(k), for_them, nullptr);
}

/// As many trials as the block has grains, each of one drawn at random. How many were accepted.
template <int D>
std::int64_t MonteCarloEngine<D>::work_on(const Block& block, std::uint64_t item,
                                          std::vector<std::int32_t>& ids) {
  ids.clear();
  std::array<int, D> at{};
  const auto gather = [&](auto&& self, std::size_t k, std::size_t cell) -> void {
    if (k == D) {
      for (const auto* id = slots_.begin(cell); id != slots_.end(cell); ++id)
        if (static_cast<std::size_t>(*id) < grains_.moving) ids.push_back(*id);
      return;
    }
    const int n = slots_.count(static_cast<int>(k));
    for (at[k] = 0; at[k] < block.many[k]; ++at[k])
      self(self, k + 1,
           cell * static_cast<std::size_t>(n) + static_cast<std::size_t>((block.first[k] + at[k]) % n));
  };
  gather(gather, 0, 0);
  std::sort(ids.begin(),
            ids.end());  // the order in a cell tells of the past, which a run that goes on does not know
  Random random(setup_.seed, Purpose::engine, item, static_cast<std::uint64_t>(sweeps_));
  std::int64_t accepted = 0;
  for (std::size_t t = 0; t < ids.size(); ++t)
    accepted += try_move(static_cast<std::size_t>(ids[one_of(ids.size(), random)]), random, &block);
  return accepted;
}

template <int D>
bool MonteCarloEngine<D>::try_move(std::size_t i, Random& random, const Block* block) {
  const Vec<D> way = delta_ * in_unit_ball<D>(random);
  // What gravity does on the way; against it a move needs luck, or a temperature.
  const double work = grains_.mass[i] * dot(setup_.gravity, way);
  if (work < 0 && !(setup_.temperature > 0 && random.uniform() < std::exp(work / setup_.temperature)))
    return false;
  Vec<D> place = grains_.place(i) + way;
  for (const auto& wall : setup_.walls)
    if (wall.height(place) < grains_.radius[i]) return false;
  std::array<int, D> laps{};
  for (int k = 0; k < D; ++k) {
    if (!setup_.domain.periodic(k)) continue;
    const double period = setup_.domain.length[k], from = place[k] - setup_.domain.lower[k];
    int& lap = laps[static_cast<std::size_t>(k)];
    if (from < 0) place[k] += period, lap = -1;
    if (from >= period) place[k] -= period, lap = 1;
  }
  const auto cell = slots_.cell_of(place);
  if (block && !in_block(*block, cell)) return false;
  if (slots_.overlaps(i, place, cell) || !slots_.move(i, place, cell)) return false;
  for (std::size_t k = 0; k < D; ++k) {
    grains_.position[k][i] = place[static_cast<int>(k)];
    if (laps[k] != 0) grains_.wraps[k][i] += laps[k];
  }
  return true;
}

template <int D>
EnergyAccount MonteCarloEngine<D>::energy() const {
  EnergyAccount e;
  e.add_motion(grains(), setup_.gravity, start_place_);
  e.normal_loss =
      e.gravity_work;  // there is no energy of motion: what gravity does goes to whoever shakes, or the bath
  return e;
}

template <int D>
std::vector<std::pair<std::string, double>> MonteCarloEngine<D>::tells() const {
  const auto packing = engines::packing_of(grains_, setup_.domain, setup_.frame);
  return {{"packing_fraction", packing.fraction},
          {"mean_height", packing.mean_height},
          {"tracer", packing.tracer},
          {"sweeps_made", static_cast<double>(sweeps_)},
          {"acceptance", acceptance()},
          {"trial_length", delta_}};
}

template <int D>
void MonteCarloEngine<D>::save(std::ostream& out) const {
  StateOutput archive(out);
  archive(step_, sweeps_, accepted_, tried_, delta_, grains_, extent_);
}

template <int D>
void MonteCarloEngine<D>::restore(std::istream& in) {
  StateInput archive(in);
  archive(step_, sweeps_, accepted_, tried_, delta_, kept(grains_), extent_);
  slots_.fill(grains_, setup_.domain, extent_);
}

template class MonteCarloEngine<2>;
template class MonteCarloEngine<3>;

}  // namespace chute::monte_carlo
