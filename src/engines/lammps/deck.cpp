#include "engines/lammps/deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "core/sphere.hpp"
#include "engines/kind/soft_laws.hpp"

namespace chute::lammps {
namespace {

/// Each size of grain is a type of its own, so that every coefficient is exact, up to so many sizes; beyond, all moving grains are one
/// type where LAMMPS's coefficients scale as chute's do. Coefficients stand in a table of types by types.
constexpr std::size_t most_kinds = 400;
/// A wall takes a fix for each kind of moving grain, and each fix looks at all grains.
constexpr std::size_t most_wall_kinds = 12;
constexpr double skin =
    0.3;  // of a mean grain's diameter: how much farther than contact LAMMPS's neighbour lists look

template <int D>
class DeckMaker {
 public:
  DeckMaker(const World<D>& world, const engines::Setting& setting, double dt)
      : world_(world), setting_(setting), dt_(dt), laws_(setting.contact.laws(setting.reference())) {
    laws::know_time_step(laws_, dt);
    const auto between = engines::laws_between(setting);
    materials_ = between.materials();
    between_ = between.values();
    for (auto& laws : between_) laws::know_time_step(laws, dt);
  }

  DeckOrRefusal<D> make() {
    sort_into_kinds();
    deck_.begin = begin();
    deck_.model = contacts();
    if (!wrong_) deck_.model += surroundings();
    if (!wrong_) deck_.data = data();
    return {std::move(deck_), wrong_};
  }

 private:
  const World<D>& world_;
  const engines::Setting& setting_;
  double dt_;
  laws::ContactLaws laws_;
  std::size_t materials_ = 0;
  std::vector<laws::ContactLaws>
      between_;  // of materials a and b at a · materials_ + b; empty: laws_ for all
  Deck deck_;
  std::optional<Refusal> wrong_;
  std::vector<GrainKind> kinds_;
  std::vector<std::size_t> kind_of_;  // of each grain
  bool apart_ = true;                 // a kind for each size; false: moving ones, then the bed

  std::size_t moving_kinds() const {
    return static_cast<std::size_t>(std::ranges::count_if(kinds_, [](const auto& k) { return !k.fixed; }));
  }

  /// What grains of one kind have in common; fixed ones sort last.
  using KindKey = std::tuple<bool, int, double, double>;
  KindKey key_of(std::size_t i) const {
    const auto& g = world_.grains;
    const int material = between_.empty() ? 0 : g.material[i];
    return apart_ ? KindKey{i >= g.moving, material, g.radius[i], g.mass[i]}
                  : KindKey{i >= g.moving, material, 0, 0};
  }
  void sort_into_kinds() {
    std::map<KindKey, std::size_t> known;
    const auto note_all = [&] {
      known.clear();
      for (std::size_t i = 0; i < world_.grains.size(); ++i) known.emplace(key_of(i), 0);
    };
    note_all();
    apart_ = known.size() <= most_kinds;
    if (!apart_) note_all();
    for (auto& [key, number] : known) {
      number = kinds_.size();
      kinds_.push_back({std::get<2>(key), std::get<3>(key), std::get<0>(key), std::get<1>(key)});
    }
    kind_of_.resize(world_.grains.size());
    for (std::size_t i = 0; i < kind_of_.size(); ++i) kind_of_[i] = known.at(key_of(i));
  }

  std::string begin() const {
    std::string text =
        fmt::format("units {}\natom_style sphere\ndimension {}\nboundary", setting_.si ? "si" : "lj", D);
    for (int k = 0; k < D; ++k) text += world_.domain.periodic(k) ? " p" : " m";
    if (D == 2) text += " p";
    return text + "\nnewton off\ncomm_modify vel yes\n";
  }

  /// The text of a model, or nothing where it is refused.
  std::string accept(const ContactModel& model) {
    if (model.wrong && !wrong_) wrong_ = model.wrong;
    return model.text;
  }

  laws::Pair pair_of(const GrainKind& a, const GrainKind& b) const {
    const double R = a.radius * b.radius / (a.radius + b.radius);
    return {a.fixed ? b.mass : b.fixed ? a.mass : a.mass * b.mass / (a.mass + b.mass), R};
  }

  const laws::ContactLaws& laws_of(const GrainKind& a, const GrainKind& b) const {
    if (between_.empty()) return laws_;
    return between_[static_cast<std::size_t>(a.material) * materials_ + static_cast<std::size_t>(b.material)];
  }

  std::vector<MeetingKinds> kinds_that_meet() const {
    std::vector<std::size_t> grains_of(kinds_.size());
    for (const auto kind : kind_of_) ++grains_of[kind];
    std::vector<MeetingKinds> all;
    for (std::size_t a = 0; a < moving_kinds(); ++a)
      for (std::size_t b = a; b < kinds_.size(); ++b)
        if (a != b || grains_of[a] > 1)
          all.push_back(
              {apart_ ? pair_of(kinds_[a], kinds_[b]) : laws::Pair(1), &laws_of(kinds_[a], kinds_[b])});
    return all;
  }

  std::optional<ClassicModel> classic() const {
    const auto meetings = kinds_that_meet();
    if (apart_) return classic_model(meetings);
    std::vector<const laws::ContactLaws*> laws;
    for (const auto& two : meetings) laws.push_back(two.laws);
    return classic_model_of_all(laws);
  }

  std::string contacts() {
    std::string text;
    if (const auto model = classic()) {
      text = fmt::format("pair_style gran/{} {}\npair_coeff * *\n", model->style, model->arguments);
    } else {
      text = "pair_style granular\n";
      for (std::size_t a = 0; a < kinds_.size() && !wrong_; ++a)
        for (std::size_t b = a; b < kinds_.size() && !wrong_;
             ++b) {  // that of two fixed grains is never used
          const auto& laws = laws_of(kinds_[a], kinds_[b]);
          text += fmt::format(
              "pair_coeff {} {} {}\n", a + 1, b + 1,
              accept(apart_ ? model_of(laws, pair_of(kinds_[a], kinds_[b])) : model_of_all(laws)));
        }
    }
    const auto moving = moving_kinds(), all = kinds_.size();
    text += fmt::format("group grains type {}:{}\n", 1, moving);
    if (all > moving) {
      text += fmt::format("group bed type {}:{}\n", moving + 1, all);
      text += "neigh_modify delay 0 exclude group bed bed\n";
    } else {
      text += "neigh_modify delay 0\n";
    }
    return fmt::format("neighbor {} bin\n", skin * setting_.mean_diameter) + text;
  }

  std::string surroundings() {
    std::string text = fmt::format("timestep {}\n", dt_);
    // Without rotation nothing turns, and spins stay as they are.
    text += fmt::format("fix move grains {}\n", setting_.rotation ? "nve/sphere" : "nve");
    const auto& g = world_.gravity;
    if (norm(g) > 0)
      text += fmt::format("fix gravity grains gravity {} vector {} {} {}\n", norm(g), g[0], g[1],
                          D == 3 ? g[D - 1] : 0.0);
    deck_.wall_fixes.resize(world_.walls.size());
    for (std::size_t w = 0; w < world_.walls.size() && !wrong_; ++w) text += wall(w);
    if (kinds_.size() > moving_kinds()) text += "fix freeze bed freeze\n";  // counts as infinitely heavy
    if (D == 2) text += "fix plane all enforce2d\n";
    return text;
  }

  /// How far a wall has moved along an axis, as a formula of LAMMPS's; nothing where it never does.
  std::string shift(const Wall<D>& wall, int axis) const {
    const double v = wall.motion.velocity[axis], amplitude = wall.motion.amplitude * wall.normal[axis];
    std::string formula;
    if (v != 0) formula = fmt::format("{}*step*{}", v, dt_);
    if (amplitude != 0 && wall.oscillates())
      formula +=
          fmt::format("{}{}*sin({}*step*{})", formula.empty() ? "" : "+", amplitude, wall.motion.rate(), dt_);
    return formula;
  }

  /// Where a plane is: along an axis, or as the border of a region, which can move.
  struct Border {
    std::string commands, style, where;
  };
  Border border(std::size_t w) const {
    const auto& wall = world_.walls[w];
    if (!wall.moves())
      for (int k = 0; k < D; ++k)
        if (std::abs(wall.normal[k]) == 1)
          return {"", "wall/gran",
                  fmt::format("{}plane {}", "xyz"[k],
                              wall.normal[k] > 0 ? fmt::format("{} NULL", wall.point[k])
                                                 : fmt::format("NULL {}", wall.point[k]))};
    std::string variables, moves;
    for (int k = 0; k < 3; ++k) {
      const auto formula = k < D ? shift(wall, k) : std::string();
      const auto name = fmt::format("wall{}{}", w, "xyz"[k]);
      if (!formula.empty()) variables += fmt::format("variable {} equal {}\n", name, formula);
      moves += formula.empty() ? " NULL" : " v_" + name;
    }
    const auto region =
        fmt::format("region wall{} plane {} {} {} {} {} {} side in{}\n", w, wall.point[0], wall.point[1],
                    D == 3 ? wall.point[D - 1] : 0.0, wall.normal[0], wall.normal[1],
                    D == 3 ? wall.normal[D - 1] : 0.0, variables.empty() ? "" : " move" + moves);
    return {variables + region, "wall/gran/region", fmt::format("region wall{}", w)};
  }

  std::string wall(std::size_t w) {
    auto by_grain = engines::laws_of_wall(setting_, world_.walls[w].surface);
    for (auto& laws : by_grain) laws::know_time_step(laws, dt_);
    Border at = border(w);
    const auto add = [&](const std::string& group, const std::string& model) {
      const auto name = fmt::format("wall{}_{}", w, deck_.wall_fixes[w].size());
      at.commands += fmt::format("fix {} {} {} {} {} contacts\n", name, group, at.style, model, at.where);
      deck_.wall_fixes[w].push_back(name);
    };
    const auto text_for = [&](const std::optional<ClassicModel>& classic, const auto& model) {
      return classic ? classic->style + " " + classic->arguments : "granular " + accept(model());
    };
    const bool one_material = by_grain.size() == 1;
    if (one_material && (!apart_ || moving_kinds() > most_wall_kinds)) {
      const auto& laws = by_grain.front();
      add("grains", text_for(classic_model_of_all({&laws}), [&] { return model_of_all(laws); }));
      return at.commands;
    }
    if (moving_kinds() > most_wall_kinds) {
      wrong_ = Refusal{
          "wall",
          fmt::format(
              "with contacts by material LAMMPS looks at all grains once for each size and material: {} "
              "of them are too many, {} can be",
              moving_kinds(), most_wall_kinds)};
      return {};
    }
    for (std::size_t k = 0; k < moving_kinds() && !wrong_; ++k) {
      if (w == 0) at.commands += fmt::format("group kind{} type {}\n", k + 1, k + 1);
      const auto& laws = by_grain[one_material ? 0 : static_cast<std::size_t>(kinds_[k].material)];
      const laws::Pair pair(kinds_[k].mass, kinds_[k].radius);
      const auto group = fmt::format("kind{}", k + 1);
      if (apart_)
        add(group, text_for(classic_model({{pair, &laws}}), [&] { return model_of(laws, pair); }));
      else
        add(group, text_for(classic_model_of_all({&laws}), [&] { return model_of_all(laws); }));
    }
    return at.commands;
  }

  std::string data() const {
    const auto& g = world_.grains;
    std::string text = fmt::format("grains of chute\n\n{} atoms\n{} atom types\n\n", g.size(), kinds_.size());
    double thickest = 0;
    for (std::size_t i = 0; i < g.size(); ++i) thickest = std::max(thickest, g.radius[i]);
    for (int k = 0; k < 3; ++k) {
      double low = -thickest, high = thickest;
      if (k < D) {
        low = world_.domain.lower[k], high = low + world_.domain.length[k];
        if (!world_.domain.periodic(k)) {
          const auto [least, most] = std::minmax_element(g.position[static_cast<std::size_t>(k)].begin(),
                                                         g.position[static_cast<std::size_t>(k)].end());
          low = *least - thickest, high = *most + thickest;
        }
      }
      text += fmt::format("{} {} {}lo {}hi\n", low, high, "xyz"[k], "xyz"[k]);
    }
    text += "\nAtoms # sphere\n\n";
    for (std::size_t i = 0; i < g.size(); ++i) {
      const auto r = g.place(i);
      const double R = g.radius[i], density = g.mass[i] / sphere_mass(1, R);
      text += fmt::format("{} {} {} {} {} {} {}\n", i + 1, kind_of_[i] + 1, 2 * R, density, r[0], r[1],
                          D == 3 ? r[D - 1] : 0.0);
    }
    text += "\nVelocities\n\n";
    for (std::size_t i = 0; i < g.size(); ++i) {
      const auto v = i < g.moving ? g.speed(i) : Vec<D>{};
      const auto spin = i < g.moving ? g.turning(i) : Vec<turns<D>>{};
      text += fmt::format("{} {} {} {}", i + 1, v[0], v[1], D == 3 ? v[D - 1] : 0.0);
      if constexpr (D == 2)
        text += fmt::format(" 0 0 {}\n", spin[0]);
      else
        text += fmt::format(" {} {} {}\n", spin[0], spin[1], spin[2]);
    }
    return text;
  }
};

}  // namespace

template <int D>
DeckOrRefusal<D> make_deck(const World<D>& world, const engines::Setting& setting, double dt) {
  return DeckMaker<D>(world, setting, dt).make();
}
template DeckOrRefusal<2> make_deck(const World<2>&, const engines::Setting&, double);
template DeckOrRefusal<3> make_deck(const World<3>&, const engines::Setting&, double);

std::optional<Refusal> refusal_of_laws(const engines::Setting& setting) {
  const auto pair = setting.reference();
  if (auto model = model_of(setting.contact.laws(pair), {pair.m_eff, setting.mean_diameter / 4}); model.wrong)
    return model.wrong;
  return engines::refusal_of_own_laws(setting);
}

std::string input_script(const Deck& deck, std::int64_t steps, std::int64_t every) {
  constexpr std::int64_t restarts = 10;
  constexpr int digits = 12;  // of a step in a file's name
  std::string text = "# written by chute export; run it with: mpirun -n RANKS lmp -in in.lammps\n" +
                     deck.begin + "read_data grains.data\n" + deck.model + contact_computes();
  text += fmt::format("shell mkdir dumps contacts\ndump grains all custom {} dumps/grains.* {}{}\n", every,
                      dump_columns(), wall_columns(deck));
  text += fmt::format("dump_modify grains sort id format float %.17g pad {}\n", digits);
  text += fmt::format(
      "dump contacts all local {} contacts/contacts.* {}\ndump_modify contacts format float %.17g pad {}\n",
      every, contact_columns(), digits);
  text += fmt::format("thermo {}\nthermo_modify lost error\n", std::max<std::int64_t>(1, steps / 100));
  text += fmt::format("restart {} grains.restart.1 grains.restart.2\n",
                      std::max<std::int64_t>(1, steps / restarts));
  return text + fmt::format("run {}\n", steps);
}

std::string dump_columns() {
  return "id type x y z ix iy iz radius mass vx vy vz omegax omegay omegaz fx fy fz";
}
std::string contact_computes() {
  return "compute pairs all property/local patom1 patom2 cutoff radius\n"
         "compute forces all pair/local fx fy fz p1 p2 p3 cutoff radius\n";
}
std::string contact_columns() {
  return "c_pairs[1] c_pairs[2] c_forces[1] c_forces[2] c_forces[3] c_forces[4] c_forces[5] c_forces[6]";
}
std::string wall_columns(const Deck& deck) {
  std::string text;
  for (const auto& fixes : deck.wall_fixes)
    for (const auto& fix : fixes)
      for (int c = 1; c <= 7; ++c) text += fmt::format(" f_{}[{}]", fix, c);
  return text;
}

}  // namespace chute::lammps
