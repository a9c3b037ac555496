#include "engines/contact/solver/assembled_system.hpp"

namespace chute::contact {

template <int D>
AssembledSystem<D>::AssembledSystem(const Problem<D>& problem, std::span<const Vec<D>> r) {
  const auto m = problem.size();
  order_ = m < few_contacts ? natural_order(m) : coloured_by_rows(problem.row_starts, problem.columns);
  const auto place_of = order_.places();
  starts_.reserve(m + 1);
  starts_.push_back(0);
  for (const auto i : order_.contacts) {
    for (auto k = problem.row_starts[i]; k < problem.row_starts[i + 1]; ++k) {
      const auto j = problem.columns[k];
      if (j == i) {
        contacts_.emplace_back(problem.blocks[k], problem.friction[i]);
      } else {
        columns_.push_back(place_of[j]);
        blocks_.push_back(problem.blocks[k]);
      }
    }
    starts_.push_back(blocks_.size());
    q_.push_back(problem.q[i]);
    r_.push_back(r.empty() ? Vec<D>{} : project_on_cone(r[i], problem.friction[i]));
  }
}

template <int D>
void AssembledSystem<D>::set_friction(std::span<const double> friction) {
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    contacts_[k] = OneContact<D>(contacts_[k].w(), friction[order_.contacts[k]]);
}

template <int D>
double AssembledSystem<D>::reference() const {
  double sum = 0;
  for (std::size_t k = 0; k < q_.size(); ++k) sum += std::pow(contacts_[k].rho(), 2) * dot(q_[k], q_[k]);
  return std::sqrt(sum);
}

template <int D>
std::vector<Vec<D>> AssembledSystem<D>::result() const {
  std::vector<Vec<D>> r(r_.size());
  for (std::size_t k = 0; k < r.size(); ++k) r[order_.contacts[k]] = r_[k];
  return r;
}

template class AssembledSystem<2>;
template class AssembledSystem<3>;

}  // namespace chute::contact
