#include "app/snapshots.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/contact_rows.hpp"
#include "read/grain_frame.hpp"

namespace chute::app {
namespace {

template <std::size_t N>
std::vector<std::array<double, N>> tuples(const read::GrainFrame& frame, std::string_view name) {
  const auto* array = frame.find(name);
  std::vector<std::array<double, N>> values;
  if (!array || array->components != static_cast<int>(N)) return values;
  values.resize(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i)
    for (std::size_t c = 0; c < N; ++c) values[i][c] = array->at(i, static_cast<int>(c));
  return values;
}

const read::PointArray* numbers(const read::GrainFrame& frame, std::string_view name) {
  const auto* array = frame.find(name);
  return array && array->components == 1 && array->words.empty() ? array : nullptr;
}

/// The same, if all are numbers that a grain or a species may have.
const read::PointArray* whole_numbers(const read::GrainFrame& frame, std::string_view name) {
  constexpr double largest = 2e9;
  const auto* array = numbers(frame, name);
  const auto good = [](double v) { return std::abs(v) <= largest && v == std::floor(v); };
  return array && std::ranges::all_of(array->values, good) ? array : nullptr;
}

/// Spins in the plane may be one number a grain.
std::vector<std::array<double, 3>> spins(const read::GrainFrame& frame) {
  if (const auto* flat = numbers(frame, fields::angular_velocity.name)) {
    std::vector<std::array<double, 3>> values;
    for (const double omega : flat->values) values.push_back({0, 0, omega});
    return values;
  }
  return tuples<3>(frame, fields::angular_velocity.name);
}

/// Which grains do not move: those of chute's own bed, and those whose type the user says.
std::vector<std::uint8_t> fixed_of(const read::GrainFrame& frame, const std::vector<std::string>& bed) {
  std::vector<std::uint8_t> fixed(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i) fixed[i] = frame.is_fixed(i);
  if (bed.empty()) return fixed;
  const auto* type = frame.find(fields::type.name);
  if (!type) type = frame.find("species");
  if (!type || type->components != 1)
    throw InputError(fmt::format("{}: no array type, so that --bed says nothing; arrays: {}",
                                 frame.file.string(), fmt::join(frame.names, ", ")));
  std::set<std::string> types;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const double value = type->at(i);
    const auto text =
        type->words.empty() ? fmt::format("{}", value) : type->words[static_cast<std::size_t>(value)];
    fixed[i] |= std::find(bed.begin(), bed.end(), text) != bed.end();
    types.insert(text);
  }
  for (const auto& name : bed)
    if (!types.empty() && !types.contains(name))
      throw InputError(fmt::format("{}: no grain is of type {}, which --bed names; there are: {}",
                                   frame.file.string(), name, fmt::join(types, ", ")));
  return fixed;
}

/// Which species each grain is of: chute's materials by their names, else other programs' species, else their types. Nothing
/// where there are more than a table can tell of: then the array is something else.
void set_species(const read::GrainFrame& frame, replay::Snapshot& shot) {
  constexpr std::size_t most_species = 64;
  const auto* species = frame.find("species");
  if (!species || species->words.empty())
    species = whole_numbers(frame, frame.own ? fields::material.name
                                   : species ? "species"
                                             : fields::type.name);
  if (!species || species->components != 1) return;
  std::map<double, int> number;
  for (const double v : species->values) number[v] = 0;
  if (number.size() > most_species) return;
  for (auto& [value, k] : number) {
    k = static_cast<int>(shot.materials.size());
    auto name =
        species->words.empty() ? fmt::format("{}", value) : species->words[static_cast<std::size_t>(value)];
    std::ranges::replace(name, ',', '_');  // tables have it in the names of columns
    shot.materials.push_back(std::move(name));
  }
  for (const double v : species->values) shot.material.push_back(number[v]);
}

std::vector<Contact> contacts_of(const std::filesystem::path& path) {
  std::vector<Contact> contacts;
  for (const auto& row : read::read_contact_rows(path)) {
    Contact c;
    c.a = row.a, c.b = row.b;
    c.point = row.point, c.normal = row.normal, c.branch = row.branch, c.force = row.force;
    c.overlap = row.overlap, c.normal_force = row.normal_force, c.shear_force = row.shear_force;
    c.state = static_cast<ContactState>(row.state);
    contacts.push_back(c);
  }
  return contacts;
}

}  // namespace

TimedFrames timed_frames(const std::vector<std::string>& sources, const read::Meanings& meanings) {
  struct Timed {
    read::FrameFile frame;
    std::optional<double> time;
  };
  std::vector<Timed> all;
  for (const auto& source : sources)
    for (auto& frame : read::find_frames(source)) {
      auto time = frame.time;
      if (!time)
        time = read::parse_frame(read::read_files(frame), meanings, {std::string(fields::id.name)}).time;
      all.push_back({std::move(frame), time});
    }
  const auto told = std::ranges::count_if(all, [](const Timed& t) { return t.time.has_value(); });
  if (told == 0) {
    for (std::size_t k = 0; k < all.size(); ++k) all[k].time = static_cast<double>(k);
  } else if (told < std::ssize(all)) {
    const auto without = std::ranges::find_if(all, [](const Timed& t) { return !t.time; });
    throw InputError(
        fmt::format("{}: tells no time, but others of these frames do", without->frame.path.string()));
  }
  // A shell gives dump.10 before dump.2.
  std::ranges::stable_sort(all, {}, [](const Timed& t) { return *t.time; });
  TimedFrames sorted;
  for (auto& [frame, time] : all) {
    sorted.frames.push_back(std::move(frame));
    sorted.times.push_back(*time);
  }
  return sorted;
}

replay::Snapshot snapshot_of(const read::FrameFile& file, const FileSays& says) {
  const auto frame = read::parse_frame(read::read_files(file), says.meanings);
  if (frame.own && frame.find(fields::body.name))
    throw InputError(
        fmt::format("{}: its grains are not round: let the run measure them, by [output] of its scene",
                    file.path.string()));
  replay::Snapshot shot;
  shot.name = file.path.string();
  shot.time = frame.time ? frame.time : file.time;
  shot.dimensions = frame.dimensions;
  shot.units = frame.units, shot.clock = frame.clock;
  for (std::size_t k = 0; k < static_cast<std::size_t>(frame.dimensions); ++k) {
    shot.domain[2 * k] = frame.domain.min()[static_cast<int>(k)];
    shot.domain[2 * k + 1] = frame.domain.max()[static_cast<int>(k)];
  }
  for (std::size_t k = 0; k < 3; ++k) shot.gravity[k] = frame.gravity[static_cast<int>(k)];
  for (std::size_t i = 0; i < frame.size(); ++i) shot.place.push_back({frame.x[i], frame.y[i], frame.z[i]});
  shot.fixed = fixed_of(frame, says.bed);
  shot.radius = frame.radius;
  if (const auto* id = whole_numbers(frame, fields::id.name))
    for (const double v : id->values) shot.id.push_back(static_cast<std::int64_t>(v));
  if (const auto* mass = numbers(frame, fields::mass.name)) shot.mass = mass->values;
  set_species(frame, shot);
  shot.velocity = tuples<3>(frame, fields::velocity.name);
  shot.spin = spins(frame);
  shot.force = tuples<3>(frame, fields::force.name);
  if (const auto* angle = numbers(frame, fields::angle.name))
    for (const double v : angle->values) shot.orientation.push_back({v, 0, 0, 0});
  else
    shot.orientation = tuples<4>(frame, fields::orientation.name);
  if (!file.contacts.empty()) shot.contacts = contacts_of(file.contacts);
  return shot;
}

}  // namespace chute::app
