#include "engines/lammps/lammps_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/types/string.hpp>
#include <cmath>
#include <limits>

#include "common/atomic_file.hpp"
#include "common/state_archive.hpp"
#include "core/pair_contact.hpp"
#include "engines/lammps/dump_frame.hpp"

namespace chute::lammps {
namespace fs = std::filesystem;
namespace {

/// A dump between two runs wants its computes to be of that step: they are where the thermodynamic output asks for them.
constexpr const char* start_of_runs =
    "compute used all reduce sum c_pairs[1] c_forces[1]\n"
    "thermo 0\nthermo_style custom step c_used[1] c_used[2]\nthermo_modify lost error\nrun 0 post no\n";

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Where the columns of dump_columns() are.
enum Column : std::size_t {
  id,
  type,
  x,
  image = x + 3,
  radius = image + 3,
  mass,
  v,
  omega = v + 3,
  f = omega + 3,
  walls = f + 3
};
/// And those of contact_columns().
enum ContactColumn : std::size_t {
  first,
  second,
  normal,
  shear = normal + 3,
  contact_columns_count = shear + 3
};
/// Of each fix of a wall: touched, force on the grain, where.
constexpr std::size_t wall_numbers = 7;

}  // namespace

template <int D>
LammpsEngine<D>::LammpsEngine(World<D> world, LammpsSetup setup)
    : around_(world.surroundings()), setup_(std::move(setup)), grains_(std::move(world.grains)) {
  for (auto& column : force_) column.assign(grains_.size(), 0.0);
  start_ = unwrapped_places<D>(view_of<D>(grains_, force_, around_.domain, 0));
  if (!setup_.dumps.empty()) {
    steps_ = steps_in(setup_.dumps, "grains");
    if (steps_.empty())
      throw InputError(setup_.dumps.string() +
                       ": no dumps grains.STEP: has LAMMPS run there (lmp -in in.lammps)?");
    if (steps_.front() != 0) throw InputError(setup_.dumps.string() + ": the dump of step 0 is missing");
  } else {
    process_ = std::make_unique<LammpsProcess>(setup_.ranks);
  }
}

/// Gives LAMMPS the deck, once, and lets it find the forces of the start.
template <int D>
void LammpsEngine<D>::begin() const {
  if (began_) return;
  began_ = true;
  std::string start = setup_.deck.begin + "read_data grains.data\n";
  if (restart_.empty()) {
    write_atomically(process_->folder() / "grains.data", setup_.deck.data, Flush::later);
  } else {
    // Units, box and grains come with the restart file; newton must be said before it.
    write_atomically(process_->folder() / "grains.restart", restart_, Flush::later);
    start = "newton off\nread_restart grains.restart\ncomm_modify vel yes\n";
  }
  process_->command(start + setup_.deck.model + contact_computes() + start_of_runs);
}

template <int D>
void LammpsEngine<D>::advance(std::int64_t step) {
  if (step == step_) return;
  if (process_) {
    begin();
    // What follows a run goes on with its forces, as one long run would.
    process_->command(fmt::format("run {} pre no post no\n", step - step_));
    known_ = -1;
  }
  step_ = step;
}

template <int D>
std::string LammpsEngine<D>::frame_file(const char* stem) const {
  // Who looks between two dumps sees the one before: importing lets nobody.
  const auto at = std::ranges::upper_bound(steps_, step_);
  return fmt::format("{}.{:012}", stem, *std::prev(at));
}

template <int D>
void LammpsEngine<D>::know() const {
  if (known_ == step_) return;
  if (process_) {
    begin();
    process_->command(
        fmt::format("write_dump all custom grains.frame {}{} modify sort id format float %.17g\n"
                    "write_dump all local contacts.frame {} modify format float %.17g\n",
                    dump_columns(), wall_columns(setup_.deck), contact_columns()));
    take_grains(process_->folder() / "grains.frame");
    take_contacts(process_->folder() / "contacts.frame");
  } else {
    take_grains(setup_.dumps / frame_file("grains"));
    // beside, for a folder of frames holds nothing else
    const auto contacts = setup_.dumps.parent_path() / "contacts" / frame_file("contacts");
    if (fs::exists(contacts)) take_contacts(contacts);
  }
  known_ = step_;
}

template <int D>
void LammpsEngine<D>::take_grains(const fs::path& file) const {
  const auto frame = read_dump_frame(file);
  const auto walls_there = around_.walls.size();
  std::size_t columns = walls;
  for (std::size_t w = 0; w < walls_there; ++w) columns += wall_numbers * setup_.deck.wall_fixes[w].size();
  if (frame.rows() != grains_.size() || frame.names.size() != columns)
    throw InputError(fmt::format("{}: has {} grains of {} columns, the scene {} of {}", file.string(),
                                 frame.rows(), frame.names.size(), grains_.size(), columns));
  contacts_.clear();
  for (std::size_t row = 0; row < frame.rows(); ++row) {
    const double number = frame.at(row, Column::id) - 1;
    if (!(number >= 0 && number < static_cast<double>(grains_.size())))
      throw InputError(fmt::format("{}: no grain of the scene has the id {}", file.string(), number + 1));
    const auto i = static_cast<std::size_t>(number);
    for (std::size_t k = 0; k < static_cast<std::size_t>(D); ++k) {
      grains_.position[k][i] = frame.at(row, Column::x + k);
      force_[k][i] = i < grains_.moving ? frame.at(row, Column::f + k) : 0;
      if (i >= grains_.moving) continue;
      grains_.velocity[k][i] = frame.at(row, Column::v + k);
      grains_.wraps[k][i] = static_cast<int>(frame.at(row, Column::image + k));
    }
    if (i < grains_.moving)
      for (std::size_t k = 0; k < static_cast<std::size_t>(turns<D>); ++k)
        grains_.spin[k][i] = frame.at(row, Column::omega + (D == 2 ? 2 : k));
    // contacts with walls, told by the grain
    std::size_t at = walls;
    for (std::size_t w = 0; w < walls_there; ++w)
      for (std::size_t fix = 0; fix < setup_.deck.wall_fixes[w].size(); ++fix, at += wall_numbers) {
        if (frame.at(row, at) == 0) continue;
        Contact contact;
        contact.a = static_cast<std::int64_t>(i), contact.b = wall_id(w);
        const auto touch = around_.walls[w].nearest(grains_.place(i), time(), around_.domain);
        const Vec<D> n = -1.0 * touch.normal;
        Vec<D> force;
        for (int k = 0; k < D; ++k) force[k] = -frame.at(row, at + 1 + static_cast<std::size_t>(k));
        set_force<D>(contact, n, force);
        contact.branch = as_file_vector(touch.height * n);
        contact.overlap = grains_.radius[i] - touch.height;
        contact.point = as_file_vector(grains_.place(i) + (touch.height + 0.5 * contact.overlap) * n);
        contacts_.push_back(contact);
      }
  }
  wrap_into(around_.domain, grains_);  // between two neighbour lists LAMMPS leaves grains beyond the ends
}

template <int D>
void LammpsEngine<D>::take_contacts(const fs::path& file) const {
  const auto frame = read_dump_frame(file);
  if (frame.rows() > 0 && frame.names.size() != contact_columns_count)
    throw InputError(fmt::format("{}: has {} columns, expected {}", file.string(), frame.names.size(),
                                 static_cast<int>(contact_columns_count)));
  const auto of_walls = std::exchange(contacts_, {});
  for (std::size_t row = 0; row < frame.rows(); ++row) {
    auto i = static_cast<std::int64_t>(frame.at(row, first)) - 1,
         j = static_cast<std::int64_t>(frame.at(row, second)) - 1;
    const auto count = static_cast<std::int64_t>(grains_.size());
    if (i < 0 || j < 0 || i >= count || j >= count)
      throw InputError(fmt::format("{}: a contact of grains that are not there", file.string()));
    Vec<D> force;  // on the first
    for (int k = 0; k < D; ++k)
      force[k] = frame.at(row, normal + static_cast<std::size_t>(k)) +
                 frame.at(row, shear + static_cast<std::size_t>(k));
    if (i < j) force = -1.0 * force;  // on the later one
    const auto [a, b] = std::minmax(i, j);
    const auto u = static_cast<std::size_t>(a), w = static_cast<std::size_t>(b);
    if (u >= grains_.moving) continue;
    Contact contact = pair_contact(grains_, around_.domain, u, w);
    if (!(contact.overlap > 0)) continue;
    Vec<D> n;
    for (int k = 0; k < D; ++k) n[k] = contact.normal[static_cast<std::size_t>(k)];
    set_force<D>(contact, n, force);
    contacts_.push_back(contact);
  }
  contacts_.insert(contacts_.end(), of_walls.begin(), of_walls.end());
  std::ranges::sort(contacts_, {}, [](const Contact& c) { return std::pair(c.a, c.b); });
}

template <int D>
GrainsView LammpsEngine<D>::grains() const {
  know();
  return view_of<D>(grains_, force_, around_.domain, time());
}
template <int D>
std::vector<Contact> LammpsEngine<D>::contacts() const {
  know();
  return contacts_;
}
template <int D>
EnergyAccount LammpsEngine<D>::energy() const {
  EnergyAccount account;
  account.add_motion<D>(grains(), around_.gravity, start_);
  account.elastic = account.normal_loss = account.shear_loss = account.start = unknown;
  if (std::ranges::any_of(around_.walls, [](const auto& wall) { return wall.moves(); }))
    account.wall_work = unknown;
  return account;
}

template <int D>
void LammpsEngine<D>::save(std::ostream& out) const {
  StateOutput archive(out);
  std::string restart;
  if (process_ && began_) {
    process_->command("write_restart grains.restart\n");
    restart = read_file(process_->folder() / "grains.restart");
  }
  archive(step_, restart);
}
template <int D>
void LammpsEngine<D>::restore(std::istream& in) {
  StateInput archive(in);
  std::string restart;
  archive(step_, restart);
  known_ = -1;
  if (!process_) return;
  if (began_) process_ = std::make_unique<LammpsProcess>(setup_.ranks);
  began_ = false;
  restart_ = std::move(restart);
}

template class LammpsEngine<2>;
template class LammpsEngine<3>;

}  // namespace chute::lammps
