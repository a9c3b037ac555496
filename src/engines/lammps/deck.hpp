#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/world.hpp"
#include "engines/kind/method.hpp"
#include "engines/lammps/contact_model.hpp"

namespace chute::lammps {

/// Grains of one radius, mass, material and mobility: a type of LAMMPS's atoms. Fixed ones come last.
struct GrainKind {
  double radius = 0, mass = 0;
  bool fixed = false;
  int material = 0;
};

/// A scene in the words of LAMMPS.
struct Deck {
  std::string data;   ///< for read_data: the grains as they begin; ids are chute's, plus 1
  std::string begin;  ///< commands before read_data
  std::string model;  ///< commands behind it: laws, walls, gravity, integration
  std::vector<std::vector<std::string>>
      wall_fixes;  ///< for each wall the names of its fixes: their arrays tell its contacts
};

/// The deck of a world; `dt` is the step. Refused are laws and walls that LAMMPS does not have, and mixtures of more sizes than
/// it can be given.
template <int D>
struct DeckOrRefusal {
  Deck deck;
  std::optional<Refusal> wrong;
};
template <int D>
DeckOrRefusal<D> make_deck(const World<D>& world, const engines::Setting& setting, double dt);

/// What of the contact laws and walls LAMMPS does not have, whatever the grains.
std::optional<Refusal> refusal_of_laws(const engines::Setting& setting);

/// The whole input of LAMMPS for a run of so many steps, with dumps every so many: dumps/grains.STEP and contacts/contacts.STEP.
std::string input_script(const Deck& deck, std::int64_t steps, std::int64_t every);

/// Names of the columns that a dump must have, in this order, for DumpFrame to read it.
std::string dump_columns();
/// Commands that define what a dump of contacts (`local`) needs, and its columns.
std::string contact_computes();
std::string contact_columns();
/// Further columns of a dump: the contacts of each wall.
std::string wall_columns(const Deck& deck);

}  // namespace chute::lammps
