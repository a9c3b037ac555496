#include "engines/contact/solver/nsgs.hpp"

#include <cmath>
#include <limits>

#include "engines/contact/solver/anderson.hpp"

namespace chute::contact {
namespace {

/// Sweeps between two looks at how far it is: what a look costs is about one sweep.
constexpr int sweeps_per_round = 5;
/// Images that Anderson's mixing combines. With more it leaves the piece in which the contacts keep their states,
/// and so the map is smooth, more often, and each look costs more; with 2 it gains half as much.
constexpr int memory = 5;
/// Sweeps without acceleration at first, while many contacts still change their states.
constexpr long first_sweeps = 10;
/// An accelerated place is given up if the step from it is larger than the last by this factor.
constexpr double worse = 2;
/// No progress: the step has not come below this part of its best for so many rounds.
constexpr double progress = 0.9;
constexpr int patience = 6;
/// The first of the strides along a step that does not get smaller, in steps; each that helps doubles it, each that
/// does not divides it by `shorten`.
constexpr double first_stride = 8, shorten = 4;

/// Gauss-Seidel with two ways to be faster, both only ever a proposal for where the next sweeps start, taken back
/// if those do worse:
///
/// - Anderson's mixing, where the steps shrink slowly;
/// - a stride along the step, where they do not shrink at all. That happens where the contacts in their present
///   states admit no solution, as if several hold a body and their directions do not agree quite: impulses then
///   grow by the same amount in each sweep until one of the contacts slides or opens.
template <class System>
class Solver {
 public:
  Solver(System& system, const Goal& goal, Team& team)
      : system_(system),
        goal_(goal),
        team_(team),
        reference_(goal.reference > 0 ? goal.reference : system.reference()),
        anderson_(weights(system), memory),
        check_below_(goal.tolerance) {}

  Convergence run() {
    if (reference_ == 0) start_from(Vector::Zero(impulses().size()));  // nothing approaches, nothing slips
    for (int sweeps = 1;; sweeps = sweeps_per_round) {
      for (int k = 1; k < sweeps; ++k) sweep();
      step_ = impulses();
      sweep();
      image_ = impulses();
      step_ = image_ - step_;
      const double size = step_.norm();
      const bool last = done_ >= goal_.iterations;
      if (last || size <= check_below_ * reference_) {
        const double is = residual();
        const bool reached = is <= goal_.tolerance;
        if (last || reached) return {done_, is, reached};
        check_below_ = 0.9 * size / reference_ * std::min(1.0, goal_.tolerance / is);
      }
      if (done_ >= first_sweeps) accelerate(size);
    }
  }

 private:
  static constexpr int D = System::dimensions;
  using Vector = Eigen::VectorXd;

  System& system_;
  const Goal& goal_;
  Team& team_;
  double reference_;
  Anderson anderson_;
  double check_below_;     // step, in units of the reference, below which the residual is worth its price
  long done_ = 0;          // sweeps
  Vector step_, image_;    // of the last sweep
  Vector safe_;            // the last image that sweeps came to without loss
  bool proposed_ = false;  // the last round began at a proposal
  double stride_ = 0;      // 0: mixing
  double last_size_ = std::numeric_limits<double>::infinity(), best_size_ = last_size_;
  int idle_ = 0;

  /// √W: with it the sum of squares of impulses is one of energies, so that light and heavy grains count alike.
  static Vector weights(const System& system) {
    Vector w(static_cast<Eigen::Index>(D * system.order().size()));
    for (Eigen::Index k = 0; k < w.size(); ++k)
      w[k] = 1 / std::sqrt(system.contact(static_cast<std::size_t>(k / D)).rho());
    return w;
  }

  Eigen::Map<Vector> impulses() {
    return {system_.impulses().data()->c.data(), static_cast<Eigen::Index>(D * system_.impulses().size())};
  }
  void start_from(const Vector& r) {
    impulses() = r;
    system_.refresh(team_);
  }

  void sweep() {
    system_.order().visit(team_, [this](std::size_t place) {
      system_.set(place, system_.contact(place).solve(system_.without(place), system_.impulses()[place]));
    });
    ++done_;
  }

  double residual() const {
    double sum = 0;
    for (std::size_t place = 0; place < system_.order().size(); ++place) {
      const auto& contact = system_.contact(place);
      const auto& r = system_.impulses()[place];
      const auto u = system_.without(place) + contact.w() * r;
      const auto off = natural_map<D>(r, u, contact.friction(), contact.rho());
      sum += dot(off, off);
    }
    return sum == 0 ? 0 : std::sqrt(sum) / reference_;
  }

  void accelerate(double size) {
    if (proposed_ && !(size <= worse * last_size_)) return take_back();
    if (proposed_ && stride_ > 0) {
      const bool left_the_drift = size < last_size_ / 2;
      stride_ = left_the_drift ? 0 : 2 * stride_;
      if (left_the_drift) anderson_.forget();
    }
    watch(size);
    last_size_ = size;
    safe_ = image_;
    if (stride_ > 0) {
      image_ += stride_ * step_;
      proposed_ = true;
    } else {
      proposed_ = anderson_.mix(image_, step_);
    }
    if (proposed_) start_from(image_);
  }
  void take_back() {
    start_from(safe_);
    anderson_.forget();
    proposed_ = false;
    stride_ = stride_ > 0 ? stride_ / shorten : first_stride;
    if (stride_ < 1) stride_ = 0;
  }
  void watch(double size) {
    if (size < progress * best_size_) {
      best_size_ = size;
      idle_ = 0;
    } else if (++idle_ >= patience && stride_ == 0) {
      stride_ = first_stride;
      best_size_ = size;
      idle_ = 0;
    }
  }
};

}  // namespace

template <class System>
Convergence nsgs(System& system, const Goal& goal, Team& team) {
  if (system.order().size() == 0) return {0, 0, true};
  return Solver<System>(system, goal, team).run();
}

template Convergence nsgs(AssembledSystem<2>&, const Goal&, Team&);
template Convergence nsgs(AssembledSystem<3>&, const Goal&, Team&);
template Convergence nsgs(BodySystem<2>&, const Goal&, Team&);
template Convergence nsgs(BodySystem<3>&, const Goal&, Team&);

}  // namespace chute::contact
