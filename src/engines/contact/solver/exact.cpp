#include "engines/contact/solver/exact.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "common/error.hpp"
#include "engines/contact/solver/natural_residual.hpp"
#include "engines/contact/solver/one_contact.hpp"

namespace chute::contact {
namespace {

enum class State : char { open, sticks, slides, slides_back };  // the last in the plane only

template <int D>
class StateIteration {
 public:
  explicit StateIteration(const Problem<D>& problem) : problem_(problem), m_(problem.size()) {
    for (std::size_t i = 0; i < m_; ++i)
      rho_.push_back(OneContact<D>(problem.blocks[problem.diagonal(i)], 0).rho());
    for (std::size_t i = 0; i < m_; ++i) reference_ += std::pow(rho_[i], 2) * dot(problem.q[i], problem.q[i]);
    reference_ = std::sqrt(reference_);
    states_.assign(m_, State::open);
    directions_.assign(m_, {});
    for (std::size_t i = 0; i < m_; ++i)
      if (problem.q[i][0] <= 0) touch(i, problem.q[i]);
  }

  ExactSolution<D> run(const Goal& goal) {
    std::set<std::vector<State>> met{states_};
    for (long solved = 1;; ++solved) {
      solve();
      auto offenders = find_offenders();
      if (offenders.empty()) return finish(solved, goal);
      if (solved >= goal.iterations) {
        auto solution = finish(solved, {.tolerance = std::numeric_limits<double>::infinity()});
        solution.convergence.reached = false;
        return solution;
      }
      std::ranges::stable_sort(offenders, std::greater{}, &Offender::by);
      const bool changed = std::ranges::any_of(offenders, [&](const Offender& offender) {
        const auto before = states_[offender.contact];
        const auto direction = directions_[offender.contact];
        change(offender);
        if (met.insert(states_).second) return true;
        states_[offender.contact] = before;
        directions_[offender.contact] = direction;
        return false;
      });
      if (!changed)
        throw WorkError(
            fmt::format("the states of the contacts came back after {} solutions of (2.33): no set of "
                        "states was found that agrees with Coulomb's law",
                        solved));
    }
  }

 private:
  using Tangential = Vec<D - 1>;
  struct Offender {
    double by;  // impulse by which it breaks the law
    std::size_t contact;
    State to;
  };
  const Problem<D>& problem_;
  std::size_t m_;
  std::vector<double> rho_;
  double reference_ = 0;
  std::vector<State> states_;
  std::vector<Tangential> directions_;  // of a sliding contact's shear impulse, of unit length
  std::vector<Vec<D>> r_, u_;

  static Tangential shear(const Vec<D>& x) {
    Tangential t;
    for (int k = 0; k < D - 1; ++k) t[k] = x[k + 1];
    return t;
  }

  /// A contact that touches with this velocity: it slides against v_s, or sticks if there is none (2.32).
  void touch(std::size_t i, const Vec<D>& velocity) { slide(i, shear(velocity), -1); }
  void slide(std::size_t i, const Tangential& along, double sign) {
    const double size = norm(along);
    directions_[i] = {};
    if (problem_.friction[i] == 0 || size == 0) {
      states_[i] = problem_.friction[i] == 0 ? State::slides : State::sticks;
      return;
    }
    directions_[i] = sign / size * along;
    states_[i] = D == 2 && directions_[i][0] < 0 ? State::slides_back : State::slides;
  }
  void change(const Offender& offender) {
    const auto i = offender.contact;
    if (offender.to == State::open || offender.to == State::sticks)
      states_[i] = offender.to;
    else if (states_[i] == State::sticks && norm(shear(r_[i])) > problem_.friction[i] * r_[i][0])
      slide(i, shear(r_[i]), 1);
    else
      touch(i, u_[i]);
  }

  /// r and u of the present states; in space also of the directions of slip, followed to where they stay.
  void solve() {
    constexpr int most = 500;
    constexpr double still = 1e-13;  // of a unit vector
    for (int k = 0; k < most; ++k) {
      solve_linear();
      if (D == 2) return;
      double turned = 0;
      for (std::size_t i = 0; i < m_; ++i) {
        if (states_[i] != State::slides || problem_.friction[i] == 0) continue;
        // where r_t − ρ u_t points; r_t itself once it is opposite to the slip
        const auto to = shear(r_[i]) - rho_[i] * shear(u_[i]);
        const double size = norm(to);
        if (size == 0 || r_[i][0] <= 0) continue;
        const auto now = 1 / size * to;
        if (dot(now, directions_[i]) < 0)
          continue;  // a reversal: pushed along its slip, it will stick (2.35)
        turned = std::max(turned, norm(now - directions_[i]));
        directions_[i] = now;
      }
      if (turned < still) return;
    }
  }

  /// (2.33) for the contacts that touch: u_n = 0, and u_t = 0 or r_t = μ r_n d.
  void solve_linear() {
    std::vector<std::size_t> touching;
    std::vector<Eigen::Index> at(m_, -1);
    for (std::size_t i = 0; i < m_; ++i)
      if (states_[i] != State::open) {
        at[i] = static_cast<Eigen::Index>(D * touching.size());
        touching.push_back(i);
      }
    const auto n = static_cast<Eigen::Index>(D * touching.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    for (const auto i : touching) {
      const auto row = at[i];
      const int equations = states_[i] == State::sticks ? D : 1;  // of velocities; the rest is of impulses
      for (int k = 0; k < equations; ++k) right[row + k] = -rho_[i] * problem_.q[i][k];
      for (auto b = problem_.row_starts[i]; b < problem_.row_starts[i + 1]; ++b) {
        const auto column = at[problem_.columns[b]];
        if (column < 0) continue;
        for (int k = 0; k < equations; ++k)
          for (int l = 0; l < D; ++l) matrix(row + k, column + l) = rho_[i] * problem_.blocks[b](k, l);
      }
      for (int k = equations; k < D; ++k) {
        matrix(row + k, row + k) = 1;
        matrix(row + k, row) = -problem_.friction[i] * directions_[i][k - 1];
      }
    }
    const Eigen::VectorXd x =
        n > 0 ? Eigen::VectorXd(matrix.completeOrthogonalDecomposition().solve(right)) : right;
    r_.assign(m_, {});
    for (const auto i : touching)
      for (int k = 0; k < D; ++k) r_[i][k] = x[at[i] + k];
    u_ = problem_.velocities(r_);
  }

  std::vector<Offender> find_offenders() const {
    constexpr double rounding = 1e-11;  // of the reference: what a dense solution may be off by
    const double least = rounding * reference_;
    std::vector<Offender> offenders;
    for (std::size_t i = 0; i < m_; ++i) {
      const auto offend = [&](double by, State to) {
        if (by > least) offenders.push_back({by, i, to});
      };
      const double n = r_[i][0], opening = rho_[i] * u_[i][0];
      const auto t = shear(r_[i]), slip = rho_[i] * shear(u_[i]);
      switch (states_[i]) {
        case State::open:
          offend(-opening, State::slides);
          break;
        case State::sticks:
          offend(norm(t) - problem_.friction[i] * std::max(n, 0.0), State::slides);  // (2.34)
          offend(norm(slip), State::slides);  // of a singular system: the others do not let it stick
          break;
        default:
          if (problem_.friction[i] > 0) offend(dot(slip, directions_[i]), State::sticks);  // (2.35)
      }
      if (states_[i] != State::open) offend(std::max(-n, opening), State::open);
    }
    return offenders;
  }

  ExactSolution<D> finish(long solved, const Goal& goal) {
    const double reference = goal.reference > 0 ? goal.reference : reference_;
    const double residual = natural_residual<D>(problem_, r_, reference);
    if (!(residual <= goal.tolerance))
      throw WorkError(
          fmt::format("the states of the contacts agree with Coulomb's law but the equations have no "
                      "solution: the residual is {:.1e}",
                      residual));
    return {r_, {solved, residual, true}};
  }
};

}  // namespace

template <int D>
ExactSolution<D> exact(const Problem<D>& problem, const Goal& goal) {
  if (problem.size() > most_exact)
    throw InputError(
        fmt::format("the exact solver takes at most {} contacts, not {}", most_exact, problem.size()));
  return StateIteration<D>(problem).run(goal);
}

template ExactSolution<2> exact(const Problem<2>&, const Goal&);
template ExactSolution<3> exact(const Problem<3>&, const Goal&);

}  // namespace chute::contact
