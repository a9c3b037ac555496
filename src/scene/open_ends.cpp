#include "scene/open_ends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.hpp"
#include "core/sphere.hpp"
#include "scene/species.hpp"

namespace chute::scene {
namespace {

constexpr std::uint64_t drawing_newcomers =
    2;  // step of their random numbers; 0 are sizes, 1 the order of materials

int material_of_newcomer(const Scene& scene, std::uint64_t item) {
  if (scene.materials.empty()) return 0;
  double left = Random(seed_of(scene), Purpose::sizes, item, drawing_newcomers).uniform();
  const auto shares = shares_of(scene.materials);
  int last = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (shares[k] == 0) continue;
    last = static_cast<int>(k);
    if ((left -= shares[k]) < 0) break;
  }
  return last;
}

template <int D>
Vec<D> vector_of(const std::vector<double>& numbers) {
  Vec<D> v;
  for (int k = 0; k < D; ++k) v[k] = numbers[static_cast<std::size_t>(k)];
  return v;
}

double downhill_speed(const Scene& scene) {
  return scene.inflow->velocity ? scene.inflow->velocity->front() : 0;
}

/// What part of the stream through the lower end of the box is grains, if they leave it as fast as they appear; infinite where
/// they appear at rest.
double filling(const Scene& scene) {
  const auto& in = *scene.inflow;
  double section = 1;
  for (std::size_t k = 1; k < in.from.size(); ++k) section *= in.to[k] - in.from[k];
  const double d = mean_grain(scene)->diameter;
  const double speed = downhill_speed(scene);
  return speed > 0 ? in.rate * filled_by(d / 2, scene.dimensions) / (section * speed)
                   : std::numeric_limits<double>::infinity();
}

std::optional<Refusal> refusal_of_box(const Scene& scene, double widest) {
  const auto& in = *scene.inflow;
  const auto D = static_cast<std::size_t>(scene.dimensions);
  const auto numbers = [&](const char* key, const std::vector<double>& given) -> std::optional<Refusal> {
    if (given.size() == D) return {};
    return Refusal{fmt::format("inflow.{}", key),
                   fmt::format("{} numbers, needed {} in {}D", given.size(), D, D)};
  };
  if (auto wrong = numbers("from", in.from)) return wrong;
  if (auto wrong = numbers("to", in.to)) return wrong;
  if (in.velocity)
    if (auto wrong = numbers("velocity", *in.velocity)) return wrong;
  for (std::size_t k = 0; k < D; ++k)
    if (!(in.to[k] - in.from[k] > widest))
      return Refusal{
          "inflow.to",
          fmt::format("the box is {:.4g} wide along {}: no grain of diameter {:.4g} has room in it",
                      in.to[k] - in.from[k], "xyz"[k], widest)};
  return {};
}

/// Across the flow a box must lie within one period, where there are any.
std::optional<Refusal> refusal_of_box_across(const Scene& scene, double period) {
  const auto& in = *scene.inflow;
  if (scene.dimensions == 2 || period == 0 || (in.from[1] >= 0 && in.to[1] <= period)) return {};
  return Refusal{"inflow.from",
                 fmt::format("the box must lie between 0 and {:.6g} along y, the period there", period)};
}

}  // namespace

Newcomer newcomer_of(const Scene& scene, std::uint64_t count) {
  const auto item = static_cast<std::uint64_t>(scene.grains.count) + count;
  Newcomer grain;
  grain.material = material_of_newcomer(scene, item);
  grain.radius = radius_of(scene, grain.material, item);
  grain.mass = sphere_mass(density_of(scene, grain.material), grain.radius);
  return grain;
}

std::vector<Newcomer> some_newcomers(const Scene& scene) {
  constexpr std::uint64_t some = 1000;
  std::vector<Newcomer> grains;
  const bool known = scene.inflow && !scene.grains.start->brings_grains();
  for (std::uint64_t k = 0; known && k < some; ++k) grains.push_back(newcomer_of(scene, k));
  return grains;
}

std::optional<Refusal> refusal_of_open_ends(const Scene& scene, const Offers& offers,
                                            const OpenEndsPlace& at) {
  if (!scene.open()) return {};
  const char* table = scene.inflow ? "inflow" : "outflow";
  const auto refuse = [](std::string key, std::string what) {
    return std::optional<Refusal>({std::move(key), std::move(what)});
  };
  if (!offers.open)
    return refuse(table, fmt::format("engine.method = \"{}\" lets no grains in or out", scene.engine.word()));
  if (!scene.grains.shapes.empty()) return refuse(table, "only round grains come in and leave");
  if (scene.grains.independent)
    return refuse(table, "grains that do not feel each other are there from the beginning to the end");
  if (at.period[0] > 0)
    return refuse(table, fmt::format("the domain repeats along x: give domain.periodic = {}",
                                     scene.dimensions == 2 ? "[]" : "[\"y\"] or []"));
  for (const auto& output : scene.output) {
    const auto needs = output->needs();
    if (output->wanted() && (needs.same_grains || needs.impacts))
      return refuse(fmt::format("output.{}", output.word()),
                    fmt::format("follows single grains, and with [{}] they come and go", table));
  }
  if (!scene.inflow) return {};
  if (scene.grains.start->brings_grains())
    return refuse(
        "inflow",
        "grains.start brings its grains with their sizes, so that nothing says those of the others");
  if (auto wrong = refusal_of_box(scene, at.widest)) return wrong;
  if (auto wrong = refusal_of_box_across(scene, at.period[1])) return wrong;
  if (!scene.outflow) return {};
  const double end = scene.outflow->beyond;
  if (!(end > scene.inflow->to[0]))
    return refuse("outflow.beyond",
                  fmt::format("{:.6g} lies above the lower end of the box of [inflow], {:.6g}: grains "
                              "would leave where they come in",
                              end, scene.inflow->to[0]));
  if (scene.outflow->below && !(*scene.outflow->below < scene.inflow->from.back()))
    return refuse("outflow.below",
                  fmt::format("{:.6g} is not below the box of [inflow], which begins at {:.6g}",
                              *scene.outflow->below, scene.inflow->from.back()));
  return {};
}

template <int D>
void open_ends(const Scene& scene, World<D>& world) {
  if (const auto& in = scene.inflow) {
    Inflow<D>& inflow = world.inflow.emplace();
    inflow.low = vector_of<D>(in->from), inflow.high = vector_of<D>(in->to);
    if (in->velocity) inflow.velocity = vector_of<D>(*in->velocity);
    inflow.spread = in->spread, inflow.rate = in->rate, inflow.every = in->every.value();
    inflow.seed = seed_of(scene), inflow.rotation = scene.grains.rotation;
    inflow.next = [scene](std::uint64_t count) { return newcomer_of(scene, count); };
  }
  if (const auto& out = scene.outflow) {
    Outflow& outflow = world.outflow.emplace();
    outflow.beyond = out->beyond, outflow.every = out->every.value();
    if (out->below) outflow.below = *out->below;
  }
}
template void open_ends(const Scene&, World<2>&);
template void open_ends(const Scene&, World<3>&);

double grains_on_the_way(const Scene& scene) {
  if (!scene.inflow) return 0;
  double time = scene.duration;
  if (scene.outflow) {
    const double slow = std::sqrt(scene.incline.gravity * scene.bed->diameter);
    const double speed = std::max(downhill_speed(scene), slow);
    if (speed > 0) time = std::min(time, (scene.outflow->beyond - scene.inflow->from[0]) / speed);
  }
  return scene.inflow->rate * time;
}

std::vector<Fact> facts_of_open_ends(const Scene& scene) {
  if (!scene.inflow) return {};
  const bool si = scene.si();
  const double rate = scene.inflow->rate;
  std::vector<Fact> list{
      {"mass in", rate * mean_grain(scene)->mass, si ? "kg/s" : "m sqrt(g/d)", "mass that comes in per time"},
      {"entering", std::floor(rate * scene.duration), "", "grains that come in, if there is room for all"},
      {"on the way", grains_on_the_way(scene), "", "grains at a time, roughly, if none stays behind"}};
  if (const double part = filling(scene); std::isfinite(part))
    list.push_back({"phi in", part, "", "part of the stream out of the box of [inflow] that is grains"});
  return list;
}

std::vector<std::string> warnings_of_open_ends(const Scene& scene) {
  if (!scene.inflow) return {};
  std::vector<std::string> told;
  // Random sequential addition: discs that are put at random where they touch no other cover 0.547, spheres 0.384.
  const double fullest = scene.dimensions == 2 ? 0.547 : 0.384;
  if (const double part = filling(scene); std::isfinite(part) && part > fullest)
    told.push_back(fmt::format(
        "inflow.rate: grains would fill {:.2g} of the stream out of their box, and put at random they fill {} at most: "
        "some will wait unless gravity carries them off; give a larger box or velocity",
        part, fullest));
  return told;
}

}  // namespace chute::scene
