#include "engines/soft/soft_setup.hpp"

#include <algorithm>
#include <numbers>

namespace chute::soft {

template <int D>
std::string why_so_deep(const SoftSetup<D>& setup) {
  constexpr double fewest = 5;  // steps in a contact, as engine.steps_per_contact has it
  const double steps = setup.contact_time / setup.time_step;
  if (steps >= fewest) return "stiffness is too low for these velocities";
  return fmt::format("the time step is {:.2g} of a contact time, which needs {} steps or more", 1 / steps,
                     fewest);
}

template <int D>
double reach_of_ends(const SoftSetup<D>& setup, double smallest_radius) {
  if (setup.ends != ContactEnds::weighted || !(setup.contact_time > 0)) return 0;
  // Of the smallest radius. Faster ones, which press each other deeper, count as touching a little too late; each pair that is looked
  // at for nothing costs as much as a contact.
  constexpr double usual_overlap = 0.05;
  // A linear spring is pressed by v t_n/π at most.
  const double fastest = std::min(usual_overlap, setup.deepest_overlap) * smallest_radius * std::numbers::pi /
                         setup.contact_time;
  return fastest * setup.time_step / 2;
}

namespace {

template <int D>
void know_time_step(LawTable& laws, const SoftSetup<D>& setup, double apart) {
  EndWeights ends;
  if (setup.ends == ContactEnds::weighted)
    ends = EndWeights(setup.time_step, setup.scheme == Scheme::verlet ? setup.time_step / 2 : 0, apart);
  laws.know_time_step(setup.time_step, ends);
}

}  // namespace

template <int D>
LawTable laws_of_grains(const SoftSetup<D>& setup, double apart) {
  auto laws = setup.between.empty() ? LawTable(setup.laws) : LawTable(setup.between);
  know_time_step(laws, setup, apart);
  return laws;
}

template <int D>
std::vector<std::optional<LawTable>> laws_of_walls(const SoftSetup<D>& setup, double apart) {
  auto laws = setup.wall_laws;
  for (auto& own : laws)
    if (own) know_time_step(*own, setup, apart);
  return laws;
}

template std::string why_so_deep(const SoftSetup<2>&);
template std::string why_so_deep(const SoftSetup<3>&);
template double reach_of_ends(const SoftSetup<2>&, double);
template double reach_of_ends(const SoftSetup<3>&, double);
template LawTable laws_of_grains(const SoftSetup<2>&, double);
template LawTable laws_of_grains(const SoftSetup<3>&, double);
template std::vector<std::optional<LawTable>> laws_of_walls(const SoftSetup<2>&, double);
template std::vector<std::optional<LawTable>> laws_of_walls(const SoftSetup<3>&, double);

}  // namespace chute::soft
