#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/number.hpp"
#include "read/text_frames.hpp"
#include "read/text_rows.hpp"

// The format: LAMMPS documentation, commands dump and dump_modify, and its page on triclinic boxes.
namespace chute::read {
namespace {

constexpr std::string_view item = "ITEM:";
constexpr std::size_t none = static_cast<std::size_t>(-1);

/// How a dump tells places: the names of its columns, and what they mean.
struct Places {
  std::array<std::string_view, 3> names;
  bool scaled;     ///< in edges of the box
  bool unwrapped;  ///< as if the grain had gone on beyond the periodic ends
};
constexpr Places places[] = {{{"x", "y", "z"}, false, false},
                             {{"xs", "ys", "zs"}, true, false},
                             {{"xu", "yu", "zu"}, false, true},
                             {{"xsu", "ysu", "zsu"}, true, true}};
constexpr std::array<std::string_view, 3> image_names{"ix", "iy", "iz"};
constexpr std::array<std::string_view, 4> quaternion_names{"quatw", "quati", "quatj", "quatk"};

/// Columns that are numbers, whatever the first row says; others may be words.
bool is_number(std::string_view name) {
  constexpr std::string_view numbers[] = {
      "id",      "mol",     "proc", "procp1", "type", "mass", "radius", "diameter", "q",      "mu",
      "vx",      "vy",      "vz",   "fx",     "fy",   "fz",   "omegax", "omegay",   "omegaz", "angmomx",
      "angmomy", "angmomz", "tqx",  "tqy",    "tqz",  "mux",  "muy",    "muz"};
  return std::find(std::begin(numbers), std::end(numbers), name) != std::end(numbers);
}

/// The head of the box: the words behind BOX BOUNDS and its three lines.
Lattice read_box(TextLines& lines, std::string_view words) {
  std::vector<std::string_view> flags, kinds;
  for (auto word = take_word(words); !word.empty(); word = take_word(words))
    (word.size() == 2 ? (word == "xy" || word == "xz" || word == "yz" ? kinds : flags) : kinds)
        .push_back(word);
  const bool general = !kinds.empty() && kinds[0] == "abc", tilted = !kinds.empty() && kinds[0] == "xy";
  double row[3][4] = {};
  const std::size_t columns = general ? 4 : tilted ? 3 : 2;
  for (auto& values : row) {
    auto line = lines.needed("an edge of the box");
    for (std::size_t c = 0; c < columns; ++c) {
      const auto value = number_in(take_word(line));
      if (!value || !std::isfinite(*value))
        lines.fail(fmt::format("an edge of the box, expected {} numbers", columns));
      values[c] = *value;
    }
    if (!general && values[1] < values[0]) lines.fail("an edge of the box ends before it begins");
  }
  Lattice box;
  for (std::size_t c = 0; c < 3 && c < flags.size(); ++c) box.periodic[c] = flags[c] == "pp";
  if (general) {
    for (int edge = 0; edge < 3; ++edge) {
      box.edges.col(edge) = Eigen::Vector3d(row[edge][0], row[edge][1], row[edge][2]);
      box.origin[edge] = row[edge][3];
    }
    return box;
  }
  // The bounds enclose the tilted box: its corner and edges lie within.
  const double xy = row[0][2], xz = row[1][2], yz = row[2][2];
  const double x0 = row[0][0] - std::min({0.0, xy, xz, xy + xz}),
               x1 = row[0][1] - std::max({0.0, xy, xz, xy + xz});
  const double y0 = row[1][0] - std::min(0.0, yz), y1 = row[1][1] - std::max(0.0, yz);
  box.origin = {x0, y0, row[2][0]};
  // clang-format off
  box.edges << x1 - x0, xy,      xz,
               0,       y1 - y0, yz,
               0,       0,       row[2][1] - row[2][0];
  // clang-format on
  return box;
}

class Columns {
 public:
  Columns(std::vector<PointArray> arrays) : arrays_(std::move(arrays)) {}
  const std::vector<double>* find(std::string_view name) const {
    const auto found =
        std::find_if(arrays_.begin(), arrays_.end(), [&](const auto& a) { return a.name == name; });
    return found == arrays_.end() || found->values.empty() ? nullptr : &found->values;
  }
  std::vector<PointArray>& arrays() { return arrays_; }

 private:
  std::vector<PointArray> arrays_;
};

/// Brings places into the box.
void place(PointSet& set, const Places& how, const Columns& columns, std::uint64_t count) {
  const std::vector<double>* parts[3];
  const std::vector<double>* images[3];
  for (std::size_t c = 0; c < 3; ++c)
    parts[c] = columns.find(how.names[c]), images[c] = columns.find(image_names[c]);
  std::vector<double>* into[] = {&set.x, &set.y, &set.z};
  if (!how.scaled && !how.unwrapped) {
    for (std::size_t c = 0; c < 3; ++c) *into[c] = parts[c] ? *parts[c] : std::vector<double>(count, 0.0);
    return;
  }
  if (!set.lattice) throw InputError("scaled or unwrapped places, but no box");
  const auto& box = *set.lattice;
  const auto inverse = box.edges.inverse().eval();
  for (auto* values : into) values->resize(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    Eigen::Vector3d at;
    // in the plane a dump may have no z: the middle of the box's thickness
    for (std::size_t c = 0; c < 3; ++c)
      at[static_cast<int>(c)] = parts[c] ? (*parts[c])[i] : how.scaled ? 0.5 : 0;
    Eigen::Vector3d r = how.scaled ? Eigen::Vector3d(box.origin + box.edges * at) : at;
    if (how.unwrapped) {
      const Eigen::Vector3d fraction = how.scaled ? at : Eigen::Vector3d(inverse * (r - box.origin));
      for (std::size_t edge = 0; edge < 3; ++edge) {
        if (!box.periodic[edge]) continue;
        const auto e = static_cast<int>(edge);
        const double turns = images[edge] ? (*images[edge])[i] : std::floor(fraction[e]);
        if (std::isfinite(turns)) r -= turns * box.edges.col(e);
      }
    }
    for (std::size_t c = 0; c < 3; ++c) (*into[c])[i] = r[static_cast<int>(c)];
  }
}

/// LAMMPS's four columns as the array that chute's own files have.
void join_quaternion(PointSet& set, const Columns& columns, std::uint64_t count) {
  const std::vector<double>* parts[4];
  for (std::size_t c = 0; c < 4; ++c)
    if (!(parts[c] = columns.find(quaternion_names[c]))) return;
  PointArray joined{std::string(fields::orientation.name), 4, {}};
  joined.values.reserve(4 * count);
  for (std::uint64_t i = 0; i < count; ++i)
    for (const auto* part : parts) joined.values.push_back((*part)[i]);
  set.point_arrays.push_back(std::move(joined));
}

}  // namespace

PointSet parse_dump(const FileBytes& piece, const std::function<bool(std::string_view)>& wanted) {
  TextLines lines(piece);
  PointSet set;
  set.format = PointSet::Format::dump;
  std::string units = piece.units;
  std::optional<std::uint64_t> count;
  bool has_time = false;
  const auto fact = [&](std::string_view name, std::string_view what) {
    const auto value = number_in(lines.needed(what));
    if (!value) lines.fail(fmt::format("{} is not a number", what));
    set.field_arrays.push_back({std::string(name), 1, {*value}});
  };
  std::string_view line;
  while (lines.next(line)) {
    if (trimmed(line).empty()) continue;
    if (!line.starts_with(item)) lines.fail("expected ITEM: …, the head of a frame");
    auto words = trimmed(line.substr(item.size()));
    if (words == "UNITS") {
      units = trimmed(lines.needed("the unit"));
    } else if (words == "TIMESTEP") {
      fact("timestep", "the time step");
    } else if (words == "TIME") {
      fact(fields::time_value, "the time"), has_time = true;
    } else if (words == "NUMBER OF ATOMS") {
      count = count_in(lines, lines.needed("the number of atoms"), "the number of atoms");
    } else if (words.starts_with("BOX BOUNDS")) {
      words.remove_prefix(std::string_view("BOX BOUNDS").size());
      set.lattice = read_box(lines, words);
    } else if (words.starts_with("NUMBER OF ENTRIES") || words.starts_with("ENTRIES")) {
      lines.fail("entries of a dump local, no grains; chute render GRAINS --contacts FILE draws contacts");
    } else if (take_word(words) == "ATOMS") {
      if (!count) lines.fail("atoms without their number");
      std::vector<RowColumn> columns;
      for (auto name = take_word(words); !name.empty(); name = take_word(words))
        columns.push_back({std::string(name)});
      if (columns.empty())  // LAMMPS before 2009 named none
        for (const char* name : {"id", "type", "xs", "ys", "zs"}) columns.push_back({name});
      const auto has = [&](std::string_view name) {
        return std::any_of(columns.begin(), columns.end(), [&](const auto& c) { return c.name == name; });
      };
      const auto how = std::find_if(std::begin(places), std::end(places),
                                    [&](const Places& p) { return has(p.names[0]) && has(p.names[1]); });
      if (how == std::end(places)) {
        std::string names;
        for (const auto& column : columns) names += (names.empty() ? "" : ", ") + column.name;
        lines.fail(fmt::format(
            "no columns of places (x y z, xs ys zs, xu yu zu or xsu ysu zsu); there are: {}", names));
      }
      const bool turns = wanted(fields::orientation.name);
      std::vector<bool> kept;
      for (auto& column : columns) {
        set.point_names.push_back(column.name);
        kept.push_back(wanted(column.name));
        const auto among = [&](const auto& names) {
          return std::find(names.begin(), names.end(), column.name) != names.end();
        };
        column.wanted = kept.back() || among(how->names) || (how->unwrapped && among(image_names)) ||
                        (turns && among(quaternion_names));
        if (among(how->names) || among(image_names) || among(quaternion_names) || is_number(column.name))
          column.kind = RowColumn::Kind::numbers;
      }
      Columns rows(read_rows(lines, *count, columns));
      try {
        place(set, *how, rows, *count);
      } catch (const InputError& error) {
        lines.fail(error.what());
      }
      if (turns) join_quaternion(set, rows, *count);
      for (std::size_t c = 0; c < columns.size(); ++c)
        if (kept[c]) set.point_arrays.push_back(std::move(rows.arrays()[c]));
    } else {
      lines.fail("no part of a dump of atoms");
    }
  }
  if (!has_time && !set.field_arrays.empty()) {
    set.field_arrays.push_back({std::string(fields::time_value), 1, set.field_arrays[0].values});
    set.field_texts.emplace_back(fields::clock, "steps");
  }
  if (units == "si")
    set.field_texts.emplace_back(fields::units, "SI");
  else if (!units.empty())
    set.field_texts.emplace_back("lammps_units", units);
  return set;
}

}  // namespace chute::read
