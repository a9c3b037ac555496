#include "scene/world.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "common/error.hpp"
#include "core/random.hpp"
#include "core/sphere.hpp"
#include "scene/forms.hpp"
#include "scene/intervals.hpp"
#include "scene/open_ends.hpp"
#include "scene/species.hpp"
#include "scene/watching.hpp"
#include "starts/launch_keys.hpp"

namespace chute::scene {
namespace {

beds::Site site_of(const Scene& scene) { return {scene.dimensions, seed_of(scene)}; }

/// Where the domain repeats: [k] for the k-th coordinate, 0 where it does not.
struct Periods {
  std::array<double, 3> length{};
  std::optional<Refusal> wrong;
};

Periods periods_of(const Scene& scene, const beds::Ground& ground) {
  Periods periods;
  const auto dimensions = static_cast<std::size_t>(scene.dimensions);
  const bool flat = dimensions == 2;
  const auto names = scene.domain.periodic.value_or(flat ? std::vector<std::string>{"x"}
                                                         : std::vector<std::string>{"x", "y"});
  const auto refuse = [&](const char* key, const std::string& message) {
    periods.wrong = Refusal{key, message};
  };
  for (const auto& name : names) {
    const auto k = name.size() == 1 ? static_cast<std::size_t>(name[0] - 'x') : dimensions;
    if (k >= dimensions) {
      refuse("domain.periodic",
             fmt::format("\"{}\" is no direction, allowed: {}", name, flat ? "x, y" : "x, y, z"));
      return periods;
    }
    const auto& size = scene.domain.size;
    const std::optional<double> given = size && k < size->size() ? std::optional((*size)[k]) : std::nullopt;
    std::optional<double> of_bed;
    if (k == 0) of_bed = ground.length;
    if (k == 1 && !flat) of_bed = ground.width;
    if (given && of_bed && std::abs(*given / *of_bed - 1) > 1e-9)
      refuse("domain.size",
             fmt::format("{:.6g} along {} is not the bed's own length, {:.6g}", *given, name, *of_bed));
    if (!given && !of_bed)
      refuse(
          "domain.size",
          fmt::format("missing: how long is a period along {}? Neither the bed nor domain.size says", name));
    periods.length[k] = of_bed.value_or(given.value_or(0));
  }
  return periods;
}

/// A start lays grains that are not round as if they were as round as they are long.
starts::Opening opening_of(const Scene& scene, const beds::Ground& ground, const Periods& periods) {
  const auto forms = sizes_of_forms(scene);
  const bool flat = scene.dimensions == 2;
  const auto room = [&](std::size_t k) {
    const auto& size = scene.domain.size;
    return periods.length[k] > 0 ? periods.length[k] : size && k < size->size() ? (*size)[k] : 0;
  };
  const auto mean = mean_grain(scene);
  starts::Opening opening{scene.dimensions,
                          seed_of(scene),
                          room(0),
                          flat ? 0 : room(1),
                          ground,
                          scene.bed->diameter,
                          widest_reach(forms) * (mean ? mean->diameter : scene.bed->diameter),
                          scene.grains.independent,
                          {}};
  if (scene.grains.start->brings_grains()) return opening;
  opening.radii = radii_of(scene);
  if (forms.empty()) return opening;
  const auto materials = materials_of(scene);
  for (std::size_t i = 0; i < opening.radii.size(); ++i)
    opening.radii[i] *= forms[form_of(scene, i, materials[i])].reach;
  return opening;
}

/// The grains as they begin. The scene's own have their species by what is drawn; a start may bring them, or name that of an
/// intruder.
std::vector<starts::Launch> launches_of(const Scene& scene, const starts::Opening& opening) {
  auto launches = scene.grains.start->begin(opening);
  const auto materials = scene.materials.empty() || scene.grains.start->brings_grains() ? std::vector<int>{}
                                                                                        : materials_of(scene);
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (launches[i].material == 0) launches[i].material = materials[i];
  for (std::size_t i = 0; i < launches.size(); ++i) check_material(scene, i, launches[i].material);
  for (auto& launch : launches)
    if (!launch.mass) launch.mass = sphere_mass(density_of(scene, launch.material), launch.radius);
  return launches;
}

/// Sizes of the grains, whoever says them.
struct Sizes {
  double mean_diameter = 1, mean_mass = 1, smallest = 0, largest = 0;  // radii
  double fastest = 0, lightest = 0;
  std::int64_t count = 1;
  std::vector<engines::Material> materials;
};

/// Adds a grain to what is known of its species, of which there are `count` so far.
void add_to(engines::Material& material, double radius, double mass, std::int64_t& count) {
  const auto n = static_cast<double>(++count);
  material.radius += (radius - material.radius) / n, material.mass += (mass - material.mass) / n;
  if (!material.grains || mass < material.smallest_mass)
    material.smallest_mass = mass, material.smallest_radius = radius;
  material.grains = true;
}

/// Of the materials of the grains, whose numbers, radii and masses these are, of the bed and of walls.
std::vector<engines::Material> species_of(const Scene& scene, const std::vector<int>& of,
                                          const std::vector<double>& radii,
                                          const std::vector<double>& masses) {
  std::vector<engines::Material> all;
  for (const auto& material : scene.materials) all.push_back({material.name});
  std::vector<std::int64_t> counts(all.size());
  for (std::size_t i = 0; i < of.size() && !all.empty(); ++i) {
    const auto k = static_cast<std::size_t>(of[i]);
    add_to(all[k], radii[i], masses[i], counts[k]);
  }
  const auto ground = scene.bed->lay(site_of(scene));
  if (all.empty() || ground.beads.empty()) return all;
  auto& bed = all[static_cast<std::size_t>(material_of(scene, scene.bed_material))];
  if (!bed.grains) bed.radius = bed.smallest_radius = scene.bed->diameter / 2;
  return all;
}

/// Contacts see no more than the tips of the grains that have such forms.
void sharpen(engines::Material& material, const std::vector<FormSizes>& forms,
             const std::vector<std::size_t>& own) {
  if (!material.grains) return;
  double lightest = 1, smallest = 1;
  for (const auto k : own)
    lightest = std::min(lightest, forms[k].lightest), smallest = std::min(smallest, forms[k].smallest);
  material.smallest_mass *= lightest, material.smallest_radius *= smallest;
}

Sizes sizes_of(const Scene& scene) {
  Sizes sizes;
  if (scene.engine->brings_grains()) {
    sizes.smallest = sizes.largest = 0.5;
    return sizes;
  }
  std::vector<double> radii, masses;
  std::vector<int> materials;
  if (scene.grains.start->brings_grains()) {
    const auto ground = scene.bed->lay(site_of(scene));
    for (const auto& launch : launches_of(scene, opening_of(scene, ground, periods_of(scene, ground)))) {
      radii.push_back(launch.radius);
      const auto& v = launch.velocity;
      sizes.fastest = std::max(sizes.fastest, std::hypot(v[0], v[1], v[2]));
      masses.push_back(*launch.mass);
      materials.push_back(launch.material);
    }
    sizes.mean_diameter = 2 * estimate_of(radii).mean;
    sizes.mean_mass = estimate_of(masses).mean;
  } else {
    radii = radii_of(scene);
    materials = materials_of(scene);
    const auto mean = mean_grain(scene).value();
    sizes.mean_diameter = mean.diameter, sizes.mean_mass = mean.mass;
    for (std::size_t i = 0; i < radii.size(); ++i)
      masses.push_back(sphere_mass(density_of(scene, materials[i]), radii[i]));
  }
  sizes.count = static_cast<std::int64_t>(radii.size());
  for (const auto& grain : some_newcomers(scene)) {
    radii.push_back(grain.radius), masses.push_back(grain.mass), materials.push_back(grain.material);
  }
  sizes.materials = species_of(scene, materials, radii, masses);
  const auto [low, high] = std::minmax_element(radii.begin(), radii.end());
  sizes.smallest = *low, sizes.largest = *high;
  sizes.lightest = *std::min_element(masses.begin(), masses.end());
  return sizes;
}

}  // namespace

engines::Setting setting_of(const Scene& scene) {
  const Sizes sizes = sizes_of(scene);
  engines::Setting s;
  s.si = scene.si();
  s.seed = seed_of(scene);
  s.dimensions = scene.dimensions;
  s.theta = scene.incline.theta();
  s.gravity = scene.incline.gravity;
  s.duration = scene.duration;
  const auto ground = scene.bed->lay(site_of(scene));
  const auto periods = periods_of(scene, ground);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& size = scene.domain.size;
    s.size[k] = periods.length[k] > 0 ? periods.length[k] : size && k < size->size() ? (*size)[k] : 0;
  }
  s.between_outputs = interval_of_all_outputs(scene);
  s.contact = scene.contact;
  s.materials = sizes.materials;
  s.mean_diameter = sizes.mean_diameter;
  s.mean_mass = sizes.mean_mass;
  s.bead_diameter = scene.bed->diameter;
  s.bead_spacing = ground.spacing;
  s.widest_spacing = ground.widest_spacing;
  s.grains = sizes.count;
  s.independent = scene.grains.independent;
  s.rotation = scene.grains.rotation;
  for (const auto& wall : scene.walls) {
    s.wall_surfaces.push_back(wall.surface);
    s.wall_surfaces.back().material = material_of(scene, wall.material);
    s.drum = std::max(s.drum, wall.radius.value_or(0));
  }
  s.fastest = sizes.fastest;
  if (const auto* start = scene.grains.start.as<starts::MadeStart>()) {
    constexpr double farthest = 3.5;  // standard deviations; one component in two thousand is faster
    s.launch_velocity = start->velocity;
    s.spread = start->spread;
    s.fastest = std::hypot(start->velocity, start->velocity_up) + farthest * start->spread;
  }

  if (scene.inflow) {
    double square = 0;
    for (const double v : scene.inflow->velocity.value_or(std::vector<double>{})) square += v * v;
    s.fastest = std::max(s.fastest, std::sqrt(square) + 3.5 * scene.inflow->spread);
    s.grains = std::max(s.grains, static_cast<std::int64_t>(grains_on_the_way(scene)));
  }
  const bool many = (sizes.count > 1 || scene.inflow) && !s.independent, beads = !ground.beads.empty();
  const double r = s.bead_diameter / 2;
  const auto with_bed = [&](double R, double mass) {
    return ground.smooth ? laws::Pair(mass, R) : laws::Pair(mass, R * r / (R + r));
  };
  const auto add = [&](const char* suffix, const char* name, laws::Pair pair, double reach) {
    s.pairs.push_back({suffix, name, pair, reach});
  };
  const double R = s.mean_diameter / 2, m = s.mean_mass;
  if (many) add("", "two mean grains", {m / 2, R / 2}, 2 * R);
  if (beads || ground.smooth)
    add(many ? " bed" : "", many ? "a mean grain with the bed" : "the grain with the bed", with_bed(R, m),
        R + (ground.smooth ? 0 : r));
  if (s.pairs.empty())
    add("", "the grain with another", many ? laws::Pair(m / 2, R / 2) : with_bed(R, m), R + r);
  // Masses that contacts see go down to those of the tips of grains that are not round.
  const FormSizes* light = nullptr;
  const auto forms = sizes_of_forms(scene);
  for (const auto& form : forms)
    if (form.lightest < (light ? light->lightest : 1)) light = &form;
  if (!forms.empty()) {  // what there is to do: their spheres
    s.grains = 0;
    const auto materials = materials_of(scene);
    for (std::size_t i = 0; i < materials.size(); ++i)
      s.grains += forms[form_of(scene, i, materials[i])].spheres;
    for (std::size_t k = 0; k < s.materials.size(); ++k)
      sharpen(s.materials[k], forms, forms_for(scene, static_cast<int>(k)));
  }
  if (light) {
    const double lightest =
        scene.materials.empty() ? sphere_mass(scene.grains.density, sizes.smallest) : sizes.lightest;
    const double m_tip = light->lightest * lightest, R_tip = light->smallest * sizes.smallest;
    if (many)
      s.stiffest = {"", "the tips of two grains", {m_tip / 2, R_tip / 2}, 2 * R_tip};
    else
      s.stiffest = {"", "the tip of a grain with the bed", with_bed(R_tip, m_tip),
                    R_tip + (ground.smooth ? 0 : r)};
  } else if (many && sizes.smallest < sizes.largest) {
    const double least =
        scene.materials.empty() ? sphere_mass(scene.grains.density, sizes.smallest) : sizes.lightest;
    s.stiffest = {"", "the two smallest grains", {least / 2, sizes.smallest / 2}, 2 * sizes.smallest};
  }
  return s;
}

namespace {

/// Of the grains that come in.
double widest_of(const Scene& scene) {
  if (!scene.inflow || scene.grains.start->brings_grains()) return 0;
  double widest = 0;
  for (const auto& grain : some_newcomers(scene)) widest = std::max(widest, 2 * grain.radius);
  return widest;
}

/// What of [[wall]] cannot be.
std::optional<Refusal> refusal_of_walls(const Scene& scene, const Offers& offers, const Periods& periods,
                                        const beds::Ground& ground, double widest) {
  for (std::size_t w = 0; w < scene.walls.size(); ++w) {
    const WallSpec& wall = scene.walls[w];
    const auto path = fmt::format("wall[{}]", w);
    if (auto wrong = misfit(wall, path, scene.dimensions)) return wrong;
    const auto lacks = [&](bool has, const char* key, bool asked,
                           const char* what) -> std::optional<Refusal> {
      if (has || !asked) return {};
      return Refusal{path + key, fmt::format("engine.method = \"{}\" {}", scene.engine.word(), what)};
    };
    const auto& own = wall.surface;
    const bool drum = offers.drum && wall.radius && scene.dimensions == 2;
    if (drum && (scene.walls.size() > 1 || ground.smooth || !ground.beads.empty()))
      return Refusal{path, fmt::format("engine.method = \"{}\" takes a drum alone, with bed.kind = \"none\"",
                                       scene.engine.word())};
    for (const auto& wrong :
         {lacks(offers.walls, "", true, "knows no walls"),
          lacks(offers.wall_shapes || drum, "", !wall.is_plane(),
                offers.drum ? "knows no walls but a level floor, or in 2D a drum" : "knows only planes"),
          lacks(offers.wall_motion, "", wall.moves(), "knows only walls that stand still"),
          lacks(!offers.only_floor || drum, ".normal", !wall.is_level(), "knows no walls but a level floor"),
          lacks(offers.wall_surfaces || drum, ".friction", own.friction.has_value(),
                "gives walls no friction of their own"),
          lacks(offers.wall_surfaces, ".restitution", own.restitution.has_value(),
                "gives walls no restitution of their own"),
          lacks(offers.wall_sticking, ".tangential_restitution", own.tangential_restitution.has_value(),
                "knows no tangential restitution"),
          lacks(offers.wall_temperatures, ".temperature", own.temperature.has_value(),
                "gives walls no temperature"),
          lacks(offers.static_friction, ".static_friction", own.static_friction.has_value(),
                "knows one friction only, at rest and sliding")})
      if (wrong) return wrong;
    constexpr double clear = 1.5;  // of a grain: with less it would touch two images of the wall at once
    const double size = [&] {
      const auto extent = [](const auto& made) { return made.bounded() ? 2 * made.bounded()->extent() : 0; };
      return scene.dimensions == 2 ? extent(make_wall<2>(wall)) : extent(make_wall<3>(wall));
    }();
    for (const double period : periods.length)
      if (period > 0 && size > 0 && size + clear * widest > period)
        return Refusal{
            path,
            fmt::format("is {:.4g} long: with a grain it does not fit into the period of {:.4g}; a plane "
                        "goes on for ever",
                        size, period)};
  }
  return {};
}

}  // namespace

std::optional<Refusal> refusal_of_bed(const Scene& scene) { return scene.bed->misfit(site_of(scene)); }

std::optional<Refusal> refusal_of(const Scene& scene) {
  const auto ground = scene.bed->lay(site_of(scene));
  const auto periods = periods_of(scene, ground);
  if (periods.wrong) return periods.wrong;
  const bool brings_grains = scene.engine->brings_grains();
  if (auto wrong = refusal_of_shapes(scene)) return wrong;
  if (!brings_grains)
    if (auto wrong = scene.grains.start->misfit(opening_of(scene, ground, periods))) return wrong;

  const auto setting = setting_of(scene);
  const auto materials_offered = scene.engine->offers().materials;
  for (std::size_t k = 0; k < scene.contact.between.size(); ++k) {
    const auto& own = scene.contact.between[k];
    const auto& known = scene.engine->offers();
    const auto refuse = [&](const char* key, const char* what) {
      return Refusal{fmt::format("contact.between[{}].{}", k, key),
                     fmt::format("engine.method = \"{}\" {}", scene.engine.word(), what)};
    };
    if (own.static_friction && !known.static_friction && materials_offered)
      return refuse("static_friction", "knows one friction only, at rest and sliding");
    if (own.tangential_restitution && !known.wall_sticking && materials_offered)
      return refuse("tangential_restitution", "knows no tangential restitution");
  }
  if (!scene.materials.empty() && !materials_offered)
    return Refusal{"material",
                   fmt::format("engine.method = \"{}\" knows one material only", scene.engine.word())};
  constexpr double clear =
      1.7;  // of the widest contact: with a period shorter than two of them grains touch their images
  const double needed = 2 * std::max(setting.mean_diameter, beds::widest(ground)) * clear;
  for (std::size_t k = 0; k < 3; ++k)
    if (!brings_grains && periods.length[k] > 0 && periods.length[k] < needed)
      return Refusal{
          k == 0 && ground.length ? scene.bed->length_key() : "domain.size",
          fmt::format("a periodic {} of length {:.4g} is too short for grains of diameter {:.4g}: a grain "
                      "would touch its own image; needed {:.4g}",
                      scene.dimensions == 2 ? "line" : "domain", periods.length[k], setting.mean_diameter,
                      needed)};
  const double longest = 2 * setting.mean_diameter / 2 * widest_reach(sizes_of_forms(scene));
  for (std::size_t k = 0; k < 3; ++k)
    if (!brings_grains && !scene.grains.shapes.empty() && periods.length[k] > 0 &&
        periods.length[k] < clear * longest)
      return Refusal{
          k == 0 && ground.length ? scene.bed->length_key() : "domain.size",
          fmt::format("a period of {:.4g} is too short for grains that reach over {:.4g}; needed {:.4g}",
                      periods.length[k], longest, clear * longest)};

  const auto& method = *scene.engine;
  const auto offers = method.offers();
  const auto lacks = [&](bool has, const char* what, const std::string& key,
                         bool asked) -> std::optional<Refusal> {
    if (has || !asked) return {};
    return Refusal{key, fmt::format("engine.method = \"{}\" {}", scene.engine.word(), what)};
  };
  if (auto r =
          lacks(scene.dimensions == 2 ? offers.in_2d : offers.in_3d,
                scene.dimensions == 2 ? "knows no plane" : "knows no third dimension", "dimensions", true))
    return r;
  if (auto r = lacks(offers.independent, "lets all grains feel each other", "grains.independent",
                     scene.grains.independent))
    return r;
  if (auto r = lacks(offers.clumps, "knows only round grains", "grains.shape", !scene.grains.shapes.empty()))
    return r;
  if (auto r = lacks(offers.tilting, "keeps the incline where it is, give one angle", "incline.angle",
                     scene.incline.tilting.has_value()))
    return r;
  if (auto r = lacks(offers.walls, "knows no walls", "bed.kind", ground.smooth)) return r;
  if (auto r = refusal_of_walls(scene, offers, periods, ground, setting.mean_diameter)) return r;
  if (auto r = refusal_of_open_ends(scene, offers, {periods.length, widest_of(scene)})) return r;
  const int repeating = static_cast<int>(
      std::ranges::count_if(std::span(periods.length).first(static_cast<std::size_t>(scene.dimensions)),
                            [](double length) { return length > 0; }));
  if (auto r = refusal_of_outputs(scene, offers, {repeating, ground.beads.size()})) return r;
  return method.refusal(setting);
}

template <int D>
World<D> make_world(const Scene& scene) {
  const auto ground = scene.bed->lay(site_of(scene));
  const auto periods = periods_of(scene, ground);
  if (periods.wrong) throw InputError(periods.wrong->key + ": " + periods.wrong->message);
  World<D> world;
  auto& grains = world.grains;
  double mean = 0;
  const auto launches = scene.engine->brings_grains()
                            ? std::vector<starts::Launch>{}
                            : launches_of(scene, opening_of(scene, ground, periods));
  grains.reserve(launches.size() + ground.beads.size());
  world.clumps.forms = forms_of<D>(scene);
  for (const auto& launch : launches) {
    Vec<D> place;
    for (int k = 0; k < D; ++k) place[k] = launch.place[static_cast<std::size_t>(k)];
    if (world.clumps.any())
      add_clump(scene, place, launch.radius, launch.material, world);
    else
      grains.add(place, launch.radius, *launch.mass, sphere_inertia(*launch.mass, launch.radius), true);
    for (int k = 0; k < D; ++k) grains.velocity[k].back() = launch.velocity[static_cast<std::size_t>(k)];
    for (int k = 0; k < turns<D>; ++k)
      grains.spin[k].back() = launch.spin[static_cast<std::size_t>(D == 2 ? 2 : k)];
    if (launch.orientation)
      for (int k = 0; k < orientation_numbers<D>; ++k)
        grains.orientation[k].back() = (*launch.orientation)[static_cast<std::size_t>(k)];
    grains.material.back() = launch.material;
    mean += 2 * launch.radius / static_cast<double>(launches.size());
  }
  grains.independent = scene.grains.independent;
  if (!scene.grains.rotation) std::fill(grains.inverse_inertia.begin(), grains.inverse_inertia.end(), 0.0);
  const int bed_material = material_of(scene, scene.bed_material);
  for (const auto& bead : ground.beads) {
    Vec<D> place;
    place[0] = bead.along;
    if constexpr (D == 3) place[1] = bead.across;
    place[D - 1] = bead.above;
    const double mass = sphere_mass(density_of(scene, bed_material), bead.radius);
    grains.add(place, bead.radius, mass, sphere_inertia(mass, bead.radius), false);
    grains.material.back() = bed_material;
  }
  for (int k = 0; k < D; ++k)
    if (const double length = periods.length[static_cast<std::size_t>(k)]; length > 0)
      world.domain.length[k] = length;
  wrap_into(world.domain, grains);  // a start beyond the end of a period is the place in it
  world.gravity = gravity_on_incline<D>(scene.incline.gravity, scene.incline.theta());
  if (scene.incline.tilting) world.tilt = scene.incline.tilting->tilt(scene.incline.gravity);
  const auto given = mean_grain(scene);
  const double d = given ? given->diameter : mean;
  if (ground.smooth) {
    Wall<D> wall;
    wall.normal[D - 1] = 1;
    wall.surface.material = bed_material;
    world.walls.push_back(wall);
  }
  for (const auto& wall : scene.walls) {
    world.walls.push_back(make_wall<D>(wall));
    world.walls.back().surface.material = material_of(scene, wall.material);
  }
  open_ends(scene, world);
  // Over the sides of a bed that ends there grains may fall as far as they like.
  const bool endless = std::all_of(periods.length.begin(), periods.length.begin() + (D - 1),
                                   [](double length) { return length > 0; });
  if (endless && (ground.smooth || !ground.beads.empty())) world.floor = -(scene.bed->diameter + d);
  world.frame.dimensions = D;
  world.frame.bead_spacing = ground.spacing > 0 ? ground.spacing : d;
  world.frame.footprint = 1;
  for (std::size_t k = 0; k + 1 < D; ++k) {
    const auto& size = scene.domain.size;
    const double given = size && k < size->size() ? (*size)[k] : 1;
    world.frame.footprint *= periods.length[k] > 0 ? periods.length[k] : given;
  }
  return world;
}

template World<2> make_world(const Scene&);
template World<3> make_world(const Scene&);

}  // namespace chute::scene
