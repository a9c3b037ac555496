#pragma once
#include "core/fact.hpp"
#include "core/offers.hpp"
#include "core/world.hpp"
#include "scene/scene.hpp"

/// What follows from [inflow] and [outflow].
namespace chute::scene {

/// Who comes in when so many have come before, of the sizes and materials that the scene draws its grains from.
Newcomer newcomer_of(const Scene& scene, std::uint64_t count);
/// Some of them, to know how small and how light they are.
std::vector<Newcomer> some_newcomers(const Scene& scene);

/// Where they are: the periods of the domain (0: none), and the diameter of the widest grain.
struct OpenEndsPlace {
  std::array<double, 3> period{};
  double widest = 0;
};
/// What of the two tables cannot be.
std::optional<Refusal> refusal_of_open_ends(const Scene& scene, const Offers& offers,
                                            const OpenEndsPlace& at);

/// The ends of a world, of a scene that has no such refusal.
template <int D>
void open_ends(const Scene& scene, World<D>& world);

/// About how many grains will be there at a time, where none stays behind.
double grains_on_the_way(const Scene& scene);
/// For `chute check`.
std::vector<Fact> facts_of_open_ends(const Scene& scene);
std::vector<std::string> warnings_of_open_ends(const Scene& scene);

}  // namespace chute::scene
