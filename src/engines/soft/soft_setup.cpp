#include "engines/soft/soft_setup.hpp"

namespace chute::soft {

template <int D>
std::string why_so_deep(const SoftSetup<D>& setup) {
  constexpr double fewest = 5;  // steps in a contact, as engine.steps_per_contact has it
  const double steps = setup.contact_time / setup.time_step;
  if (steps >= fewest) return "stiffness is too low for these velocities";
  return fmt::format("the time step is {:.2g} of a contact time, which needs {} steps or more", 1 / steps,
                     fewest);
}

namespace {

template <int D>
void know_time_step(LawTable& laws, const SoftSetup<D>& setup) {
  EndWeights ends;
  if (setup.ends == ContactEnds::weighted)
    ends = EndWeights(setup.time_step, setup.scheme == Scheme::verlet ? setup.time_step / 2 : 0);
  laws.know_time_step(setup.time_step, ends);
}

}  // namespace

template <int D>
LawTable laws_of_grains(const SoftSetup<D>& setup) {
  auto laws = setup.between.empty() ? LawTable(setup.laws) : LawTable(setup.between);
  know_time_step(laws, setup);
  return laws;
}

template <int D>
std::vector<std::optional<LawTable>> laws_of_walls(const SoftSetup<D>& setup) {
  auto laws = setup.wall_laws;
  for (auto& own : laws)
    if (own) know_time_step(*own, setup);
  return laws;
}

template std::string why_so_deep(const SoftSetup<2>&);
template std::string why_so_deep(const SoftSetup<3>&);
template LawTable laws_of_grains(const SoftSetup<2>&);
template LawTable laws_of_grains(const SoftSetup<3>&);
template std::vector<std::optional<LawTable>> laws_of_walls(const SoftSetup<2>&);
template std::vector<std::optional<LawTable>> laws_of_walls(const SoftSetup<3>&);

}  // namespace chute::soft
